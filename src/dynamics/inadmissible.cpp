#include "dynamics/inadmissible.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <variant>

#include "core/multiversion.hpp"
#include "cutcell/moves_view.hpp"

namespace recoil {

namespace {

constexpr double least_judged = 0.02;      // part of a cell below which a state is not judged
constexpr double whole = 0.98;             // ... and from which on it is whole
constexpr double admissible_sound = 0.02;  // least c^2 of a solid, of c0^2 ...
constexpr double sound_of_vapour = 1e-6;   // ... and of what evaporates
constexpr double error_of_motion = 0.2;    // of u^2, by which -c^2 of a gas may be larger

/// Of failed matter only the density is judged, and only from above: the rest of its cell is a void.
/// @param fails whether the matter can fail: if not, its damage does not count.
/// @param densest its largest_density() [kg/m3]
template <int Dim, class EosModel>
[[gnu::always_inline]] inline bool beyond_equations(const EosModel& eos, const Contents<Dim>& q,
                                                    double volume, bool fails, double densest) {
  using C = Components<Dim>;
  const double rho = q[C::rho] / volume;
  const auto& matter = frozen(eos, q[C::crushed] / q[C::rho]);
  const DensityRange range = density_range(matter);
  const bool failed = fails & (q[C::damage] > 0) & (q[C::damage] >= failed_damage * q[C::rho]);
  const bool not_too_dense = (rho < range.most * matter.rho0) & (rho < densest);
  double momentum2 = 0;
  for (std::size_t d = 0; d < Dim; ++d) momentum2 += q[C::u + d] * q[C::u + d];
  const double p = matter.pressure(rho, (q[C::energy] - 0.5 * momentum2 / q[C::rho]) / q[C::rho]);
  const double c0 = bulk_sound_speed(matter), c2 = matter.sound_speed_squared(rho, p);
  const double least = evaporates(eos) ? sound_of_vapour : admissible_sound;
  // What is left of a gas at the edge of a void is cold, thin and fast, and the error of its kinetic energy
  // may be larger than its heat.
  const double u2 = momentum2 / (q[C::rho] * q[C::rho]);
  const double least_c2 =
      is_fluid<EosModel>() ? -admissible_sound * c0 * c0 - error_of_motion * u2 : least * c0 * c0;
  const bool good = not_too_dense & (rho > range.least * matter.rho0) & (c2 >= least_c2) & std::isfinite(c2),
             dust = failed & (rho > 0) & not_too_dense;
  return !(good | dust);  // true for NaN
}

/// Fragments of a row of cells, the first one's at `contents` (components n apart), `volume` and `least`.
template <int Dim>
struct JudgedRow {
  const double *contents, *volume;
  std::size_t n;
  const double* least;  // volumes from which on they are judged
  bool fails;
  double densest;  // kg/m3
};

template <int Dim, class EosModel>
[[gnu::always_inline]] inline bool is_inadmissible(const EosModel& eos, const JudgedRow<Dim>& row, int c) {
  using C = Components<Dim>;
  const double* from = row.contents + c;
  Contents<Dim> q;  // what is judged: mass, momentum, energy, pores, damage
  for (std::size_t j = 0; j <= C::energy; ++j) q[j] = from[j * row.n];
  if constexpr (has_pores<EosModel>()) q[C::crushed] = from[C::crushed * row.n];
  q[C::damage] = from[C::damage * row.n];
  // A fragment may be too dense by the error of its volume. A whole cell is so where matter is too fast for
  // its equation of state: that stops the run (choose_roles()).
  const double densest = row.volume[c] < whole / least_judged * row.least[c] ? row.densest : infinite;
  return (row.volume[c] > row.least[c]) & beyond_equations<Dim>(eos, q, row.volume[c], row.fails, densest);
}

/// The row is a copy: of one that is somewhere else the compiler does not know that it stays as it is, and
/// takes cell by cell.
template <int Dim, class EosModel>
RECOIL_MULTIVERSION [[gnu::flatten]] bool any_inadmissible(const EosModel& eos, JudgedRow<Dim> row,
                                                           int count) {
  int any = 0;
#pragma omp simd reduction(| : any)
  for (int c = 0; c < count; ++c) any |= is_inadmissible(eos, row, c) ? 1 : 0;
  return any != 0;
}

/// Matter that can fail has failed where its equation of state ends in expansion: torn where the pressure is
/// below zero, else about to boil. Its damage becomes `most_damage`. @returns whether it is so.
template <int Dim, class EosModel>
bool tear(const EosModel& eos, BodyBlock<Dim>& b, std::size_t k, double most_damage) {
  using C = Components<Dim>;
  const std::size_t n = b.volume.size();
  const double mass = b.contents[k], rho = mass / b.volume[k];
  double& damage = b.contents[C::damage * n + k];
  const auto& matter = frozen(eos, b.contents[C::crushed * n + k] / mass);
  if (!(mass > 0 && rho > 0 && rho < matter.rho0) || damage >= failed_damage * mass) return false;
  if (!std::isfinite(b.contents[C::energy * n + k])) return false;
  damage = most_damage * mass;
  return true;
}

/// mark_inadmissible() for one kind of matter.
template <int Dim, class EosModel>
std::int64_t mark_rows(const EosModel& eos, const State<Dim>& state, BodyBlock<Dim>& b, int slot,
                       Counters& counters, bool fails, double most_damage) {
  std::int64_t count = 0;
  const Grid<Dim>& grid = state.grid(slot);
  const Index<Dim> lo = state.mesh.block(slot).cells.lo;
  Box<Dim> rows = b.matter;
  const int width = rows.extent(0);
  const double densest = eos.largest_density();
  rows.hi[0] = std::min(rows.hi[0], rows.lo[0] + 1);
  std::array<double, Window<Dim>::longest> least;  // by column
  Index<Dim> column = rows.lo;
  for (int c = 0; c < width; ++c, ++column[0])
    least[static_cast<std::size_t>(c)] = least_judged * grid.full_volume(column);
  for_each(rows, [&](const Index<Dim>& i) {
    const auto k = static_cast<std::size_t>(grid.layout().at(i - lo));
    std::uint8_t* role = b.role.data() + k;
    for (int c = 0; c < width; ++c) role[c] &= static_cast<std::uint8_t>(~has_bad_contents);
    const JudgedRow<Dim> row{
        b.contents.data() + k, b.volume.data() + k, b.volume.size(), least.data(), fails, densest};
    if (!any_inadmissible(eos, row, width)) return;
    for (int c = 0; c < width; ++c) {
      if (!is_inadmissible(eos, row, c)) continue;
      if (fails && tear(eos, b, k + static_cast<std::size_t>(c), most_damage)) {
        ++counters.torn_states;
        continue;
      }
      role[c] |= has_bad_contents;
      ++count;
    }
  });
  return count;
}

}  // namespace

template <int Dim>
bool inadmissible(const Material& material, const Contents<Dim>& contents, double volume) {
  return std::visit(
      [&](const auto& eos) {
        return beyond_equations<Dim>(eos, contents, volume, true, eos.largest_density());
      },
      material.eos);
}

template <int Dim>
std::int64_t mark_inadmissible(const State<Dim>& state, Body<Dim>& body, int slot, Counters& counters,
                               double most_damage) {
  BodyBlock<Dim>& b = body.at(slot);
  return std::visit(
      [&](const auto& eos) {
        return mark_rows(eos, state, b, slot, counters, can_fail(body.material.damage), most_damage);
      },
      body.material.eos);
}

template <int Dim>
void clear_inadmissible(BodyBlock<Dim>& b) {
  for (std::uint8_t& r : b.role) r &= static_cast<std::uint8_t>(~has_bad_contents);
}

/// Takes what stands in for cells of another size out of a window: it belongs to other cells. Whether a cell
/// is real is the same for all blocks that see it, so what is shared out is all there is.
template <int Dim>
void keep_real_cells(const Mesh<Dim>& mesh, int slot, MovesView<Dim>& p) {
  if (mesh.is_among_equals(slot)) return;
  for_each(p.window.box(), [&](const Index<Dim>& i) {
    const int from = p.window.source_inside(i).slot;
    if (from >= 0 && mesh.is_stand_in(from)) p.volume[p.window.at(i)] = 0;
  });
}

template <int Dim>
void average_inadmissible(const State<Dim>& state, Body<Dim>& body, int slot, int width, Scratch& scratch) {
  BodyBlock<Dim>& b = body.at(slot);
  b.updates.clear();
  if (b.reach.size() == 0) return;  // nothing is here
  MovesView<Dim> p(state, body, slot, 3 * width, scratch);
  keep_real_cells(state.mesh, slot, p);
  auto* role = scratch.take<std::uint8_t>(p.window.size());
  p.window.gather([&](int s) { return body.present(s) ? body.at(s).role.data() : nullptr; }, std::uint8_t{0},
                  Beyond::nothing, role);
  const auto holds = [&](const Index<Dim>& i) { return p.volume[p.window.at(i)] != 0; };
  const auto around = [&](const Index<Dim>& i) {
    Box<Dim> box{i, i};
    for (int d = 0; d < Dim; ++d) box.lo[d] -= width, box.hi[d] += width + 1;
    return box;
  };
  const auto windows_of = [&](const Index<Dim>& i) {
    int count = 0;
    for_each(around(i),
             [&](const Index<Dim>& j) { count += (role[p.window.at(j)] & has_bad_contents) != 0; });
    return count;
  };
  const Box<Dim> inner = p.window.inner();
  for_each(inner, [&](const Index<Dim>& i) {
    if (!holds(i)) return;
    const int count = windows_of(i);
    if (count == 0) return;
    Update<Dim> u{p.window.cell(i), p.volume[p.window.at(i)], {}};
    for_each(around(i), [&](const Index<Dim>& s) {
      if ((role[p.window.at(s)] & has_bad_contents) == 0) return;
      double volume = 0;
      Contents<Dim> mean{};
      for_each(around(s), [&](const Index<Dim>& j) {
        if (!holds(j)) return;
        const double share = 1.0 / windows_of(j);
        volume += share * p.volume[p.window.at(j)];
        add_scaled<Dim>(mean, p.contents(j), share);
      });
      add_scaled<Dim>(u.contents, mean, u.volume / (count * volume));
    });
    b.updates.push_back(u);
  });
}

#define RECOIL_INSTANTIATE(Dim)                                                                        \
  template bool inadmissible<Dim>(const Material&, const Contents<Dim>&, double);                      \
  template std::int64_t mark_inadmissible<Dim>(const State<Dim>&, Body<Dim>&, int, Counters&, double); \
  template void clear_inadmissible<Dim>(BodyBlock<Dim>&);                                              \
  template void average_inadmissible<Dim>(const State<Dim>&, Body<Dim>&, int, int, Scratch&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
