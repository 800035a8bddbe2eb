#include "dynamics/primitives.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

#include "core/error.hpp"

namespace recoil {

namespace {

constexpr double least_judged = 0.02;  // part of a cell below which a state is not judged
// A donor is averaged where it fills more than this part of a cell and its density lies between these
// multiples of rho0 (of the stages of a step only: at its start the donor's fill has been judged).
constexpr double least_averaged = 0.1, thinnest_averaged = 0.2, densest_averaged = 3;
constexpr double thinnest_used = 0.2;  // of rho0: a fragment below it is of no use to fits and stencils

template <int Dim>
std::string place_of(const State<Dim>& state, int slot, const Index<Dim>& local) {
  const Vec<Dim> x = state.grid().centre(state.mesh.block(slot).cells.lo + local);
  std::string text;
  for (int d = 0; d < Dim; ++d) text += fmt::format("{}{:.6g}", d ? ", " : "", x[d] * 1e3);
  return "(" + text + ") mm";
}

template <int Dim, class F>
void for_each_cell(const State<Dim>& state, int slot, F&& f) {
  const Box<Dim> cells = state.mesh.block(slot).cells, layout = state.grid().layout();
  for_each(cells, [&](const Index<Dim>& i) { f(i, static_cast<std::size_t>(layout.at(i - cells.lo))); });
}

/// One row of cells, all of them donors: the loop that interior blocks run.
template <int Dim, class EosModel>
void row_primitives(const EosModel& eos, std::size_t first, std::size_t count, std::size_t n, const double* q,
                    const double* volume, double* w) {
  using C = Components<Dim>;
#pragma omp simd
  for (std::size_t k = first; k < first + count; ++k) {
    const double mass = q[k], per_mass = 1 / mass, rho = mass / volume[k];
    double kinetic = 0;
    for (std::size_t d = 0; d < Dim; ++d) {
      const double u = q[(C::u + d) * n + k] * per_mass;
      w[(C::u + d) * n + k] = u;
      kinetic += 0.5 * u * u;
    }
    const double e = q[C::energy * n + k] * per_mass - kinetic;
    const double p = eos.pressure(rho, e);
    w[C::rho * n + k] = rho;
    w[C::p * n + k] = p;
    for (std::size_t c = C::s; c < C::contents; ++c) w[c * n + k] = q[c * n + k] * per_mass;
    if constexpr (EosModel::barotropic) w[C::extra * n + k] = e - eos.energy(rho, p);
  }
}

template <int Dim, class EosModel>
[[gnu::always_inline]] inline bool beyond_equations(const EosModel& eos, const Contents<Dim>& q,
                                                    double volume) {
  using C = Components<Dim>;
  const double rho = q[C::rho] / volume;
  const bool possible = (rho > least_density * eos.rho0) & (rho < largest_density * eos.rho0);
  double momentum2 = 0;
  for (std::size_t d = 0; d < Dim; ++d) momentum2 += q[C::u + d] * q[C::u + d];
  const double p = eos.pressure(rho, (q[C::energy] - 0.5 * momentum2 / q[C::rho]) / q[C::rho]);
  const double c0 = bulk_sound_speed(eos);
  return !(possible & (eos.sound_speed_squared(rho, p) >= admissible_sound * c0 * c0));  // true for NaN
}

template <int Dim, class EosModel>
void average_block(const State<Dim>& state, const EosModel& eos, Body<Dim>& body, int slot,
                   Counters& counters) {
  BodyBlock<Dim>& b = body.at(slot);
  const Box<Dim> cells = state.mesh.block(slot).cells, layout = state.grid().layout();
  const auto n = static_cast<std::size_t>(layout.size());
  if (!b.near_surface) {
    Box<Dim> rows = cells;
    rows.hi[0] = rows.lo[0] + 1;
    for_each(rows, [&](const Index<Dim>& i) {
      row_primitives<Dim>(eos, static_cast<std::size_t>(layout.at(i - cells.lo)),
                          static_cast<std::size_t>(cells.extent(0)), n, b.contents.data(), b.volume.data(),
                          b.average.data());
    });
  } else {
    // Runs of good donors go through the same loop as whole rows.
    std::size_t first = 0, count = 0;
    const auto flush = [&] {
      if (count > 0)
        row_primitives<Dim>(eos, first, count, n, b.contents.data(), b.volume.data(), b.average.data());
      count = 0;
    };
    for_each_cell(state, slot, [&](const Index<Dim>& i, std::size_t k) {
      const double volume = b.volume[k], rho = b.contents[k] / volume;
      const bool donor = (b.role[k] & donates) != 0;
      if (donor && volume > least_averaged * state.grid().full_volume(i) &&
          rho > thinnest_averaged * eos.rho0 && rho < densest_averaged * eos.rho0) {
        if (count > 0 && k != first + count) flush();
        if (count == 0) first = k;
        ++count;
        return;
      }
      flush();
      if (!donor) return;
      if (!std::isfinite(rho))
        throw PhysicsError("the density of " + body.name + " is not a number at " +
                           place_of(state, slot, i - cells.lo));
      ++counters.averages_kept;  // of the stage before
    });
    flush();
  }
}

}  // namespace

template <int Dim>
void choose_roles(const State<Dim>& state, Body<Dim>& body, int slot, Counters& counters) {
  BodyBlock<Dim>& b = body.at(slot);
  const double rho0 = density(body.material);
  for_each_cell(state, slot, [&](const Index<Dim>& i, std::size_t k) {
    const double fill = b.volume[k] / state.grid().full_volume(i);
    std::uint8_t role = 0;
    if (fill > donor_fill) role |= donates;
    if (fill >= regular_fill) role |= regular | valued;
    if (role != 0 && !(b.contents[k] / b.volume[k] > thinnest_used * rho0)) {
      ++counters.fragments_too_thin;
      role = 0;
    }
    b.role[k] = role;
  });
}

template <int Dim>
void average_primitives(const State<Dim>& state, Body<Dim>& body, int slot, Counters& counters) {
  BodyBlock<Dim>& b = body.at(slot);
  if (b.average.empty()) b.average.swap(b.stencil);  // which are over: they share their memory
  std::visit([&](const auto& eos) { average_block(state, eos, body, slot, counters); }, body.material.eos);
}

template <int Dim>
double fastest_signal(const State<Dim>& state, const Body<Dim>& body, int slot, Counters& counters) {
  using C = Components<Dim>;
  const BodyBlock<Dim>& b = body.at(slot);
  const auto n = static_cast<std::size_t>(state.grid().layout().size());
  const double g = shear_modulus(body.material);
  double fastest = 0;
  std::visit(
      [&](const auto& eos) {
        const double c0 = bulk_sound_speed(eos), least = least_sound * c0 * c0;
        for_each_cell(state, slot, [&](const Index<Dim>& i, std::size_t k) {
          if ((b.role[k] & regular) == 0) return;
          const double rho = b.average[k], p = b.average[C::p * n + k];
          const double c2 = eos.sound_speed_squared(rho, p);
          double sum = 0;
          for (std::size_t d = 0; d < Dim; ++d) sum += std::abs(b.average[(C::u + d) * n + k]);
          if (!std::isfinite(sum + c2) || !(rho > 0) || !eos.admissible(rho))
            throw PhysicsError(fmt::format(
                "{} has no admissible state at {}: density {:.6g} kg/m3, pressure {:.6g} GPa", body.name,
                place_of(state, slot, i - state.mesh.block(slot).cells.lo), rho, p * 1e-9));
          if (c2 < least) ++counters.floored_sound_speeds;
          sum += Dim * std::sqrt((c2 > least ? c2 : least) + 4 * g / (3 * rho));
          fastest = sum > fastest ? sum : fastest;
        });
      },
      body.material.eos);
  return fastest / state.grid().dx;
}

template <int Dim>
bool inadmissible(const Material& material, const Contents<Dim>& q, double volume) {
  return std::visit([&](const auto& eos) { return beyond_equations<Dim>(eos, q, volume); }, material.eos);
}

template <int Dim>
std::int64_t mark_inadmissible(const State<Dim>& state, Body<Dim>& body, int slot) {
  BodyBlock<Dim>& b = body.at(slot);
  std::int64_t count = 0;
  const Grid<Dim>& grid = state.grid();
  const Index<Dim> lo = state.mesh.block(slot).cells.lo;
  const std::size_t n = b.volume.size();
  Box<Dim> rows = b.matter;
  const int width = rows.extent(0);
  rows.hi[0] = std::min(rows.hi[0], rows.lo[0] + 1);
  std::visit(
      [&](const auto& eos) {
        const auto is_bad = [&](Index<Dim> i, std::size_t k, int c) {
          i[0] += c;
          const std::size_t at = k + static_cast<std::size_t>(c);
          Contents<Dim> q;  // what is judged: mass, momentum, energy
          for (std::size_t j = 0; j <= Components<Dim>::energy; ++j) q[j] = b.contents[j * n + at];
          return (b.volume[at] > least_judged * grid.full_volume(i)) &
                 beyond_equations<Dim>(eos, q, b.volume[at]);
        };
        for_each(rows, [&](const Index<Dim>& i) {
          const auto k = static_cast<std::size_t>(grid.layout().at(i - lo));
          std::uint8_t* role = b.role.data() + k;
          int any = 0;
#pragma omp simd reduction(| : any)
          for (int c = 0; c < width; ++c) {
            role[c] &= static_cast<std::uint8_t>(~has_bad_contents);
            any |= is_bad(i, k, c) ? 1 : 0;
          }
          for (int c = 0; any != 0 && c < width; ++c) {
            if (!is_bad(i, k, c)) continue;
            role[c] |= has_bad_contents;
            ++count;
          }
        });
      },
      body.material.eos);
  return count;
}

template <int Dim>
bool has_inadmissible(const BodyBlock<Dim>& b) {
  for (const std::uint8_t r : b.role)
    if ((r & has_bad_contents) != 0) return true;
  return false;
}

template <int Dim>
void clear_inadmissible(BodyBlock<Dim>& b) {
  for (std::uint8_t& r : b.role) r &= static_cast<std::uint8_t>(~has_bad_contents);
}

#define RECOIL_INSTANTIATE(Dim)                                                             \
  template void choose_roles<Dim>(const State<Dim>&, Body<Dim>&, int, Counters&);           \
  template void average_primitives<Dim>(const State<Dim>&, Body<Dim>&, int, Counters&);     \
  template double fastest_signal<Dim>(const State<Dim>&, const Body<Dim>&, int, Counters&); \
  template std::int64_t mark_inadmissible<Dim>(const State<Dim>&, Body<Dim>&, int);         \
  template bool has_inadmissible<Dim>(const BodyBlock<Dim>&);                               \
  template void clear_inadmissible<Dim>(BodyBlock<Dim>&);                                   \
  template bool inadmissible<Dim>(const Material&, const Contents<Dim>&, double);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
