#include "dynamics/plastic_return.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <variant>

#include "core/multiversion.hpp"
#include "dynamics/damage/nonlocal_damage.hpp"
#include "dynamics/failed_matter.hpp"
#include "dynamics/primitives.hpp"
#include "kernels/row_kernels.hpp"
#include "material/highest_temperature.hpp"
#include "material/radial_return.hpp"
#include "state/places.hpp"

namespace recoil {

namespace {

// What is nearer to its bounds is not counted: plastic strain, heating [K], distension.
constexpr double least_strain = 1e-4, least_heat = 0.1, least_distension = 1e-6;

/// A strength model with what is molten of a state.
template <class Model>
const Model& as_molten(const Model& model, const Melt& /*melt*/) {
  return model;
}
template <class Model>
PartlyMolten<Model> as_molten(const PartlyMolten<Model>& model, const Melt& melt) {
  return {model, 1 - melt.molten, melt.at};
}

/// A strength model with the shear modulus that it has in a state.
template <class StrengthModel>
decltype(auto) in_state(const StrengthModel& model, const YieldState& state) {
  if constexpr (requires { model.modulus(state); }) {
    StrengthModel changed = model;
    changed.shear_modulus = model.modulus(state);
    return changed;
  } else {
    return (model);
  }
}

/// plastic_increment() of matter that bears only a part of its yield stress: q - 3 G x = part Y(x) is
/// q/part - 3 G/part x = Y(x).
template <class StrengthModel>
double weakened_increment(const StrengthModel& strength, double trial, double part, const YieldState& before,
                          double dt) {
  if constexpr (requires(StrengthModel & m) { m.shear_modulus = 1; }) {
    if (part < 1) {
      if (!(part > 0)) return trial / (3 * strength.shear_modulus);
      StrengthModel weaker = strength;
      weaker.shear_modulus /= part;
      return plastic_increment(weaker, trial / part, before, dt);
    }
  }
  return plastic_increment(strength, trial, before, dt);
}

/// One cell: contents q (distance n between components) of a fragment of volume v.
/// @returns by how much the plastic strain grows.
template <int Dim, class StrengthModel>
double return_cell(const StrengthModel& at_rest, const Body<Dim>& body, double* q, std::size_t n, double v,
                   double dt) {
  using C = Components<Dim>;
  const double mass = q[C::rho * n], rho = mass / v;
  if (!(rho > 0)) return 0;
  const double trial2 = equivalent_stress_squared<Dim>(q + C::s * n, n) / (mass * mass);
  if (trial2 == 0) return 0;
  const double ep = q[C::ep * n] / mass > 0 ? q[C::ep * n] / mass : 0.0;
  double kinetic = 0;
  for (std::size_t d = 0; d < Dim; ++d) kinetic += q[(C::u + d) * n] * q[(C::u + d) * n];
  const double internal = (q[C::energy * n] - 0.5 * kinetic / mass) / mass;
  [[maybe_unused]] const double e = internal - distortion_energy(trial2, at_rest.shear_modulus, rho);
  YieldState before{.ep = ep};
  Melt melt;
  if constexpr (temperature_dependent<StrengthModel>()) {
    melt = body.temperature.melt(rho, e, q[C::temperature_rise * n] / mass);
    before.temperature = melt.temperature;
  }
  if constexpr (pressure_dependent<StrengthModel>()) {
    double crushed = q[C::crushed * n] / mass;
    if (const auto* porous = std::get_if<Porous>(&body.material.eos))
      crushed = porous->crush(rho, internal, crushed);  // as crush_pores() will find it
    before.pressure = pressure(body.material.eos, rho, internal, crushed);
    before.compression = rho / rest_density(body.material.eos, crushed);
  }
  if constexpr (damage_dependent<StrengthModel>()) before.damage = q[C::damage * n] / mass;
  const auto& solid = as_molten(at_rest, melt);
  const auto& strength = in_state(solid, before);
  const double trial = std::sqrt(trial2);
  const double part = strength_left(body.material.damage, q[C::damage * n] / mass);
  const double increment = weakened_increment(strength, trial, part, before, dt);
  if (!(increment > 0)) return 0;
  const double left = 1 - 3 * strength.shear_modulus * increment / trial;
  const double scale = left > 0 ? left : 0.0;
  for (std::size_t c = C::s; c < C::ep; ++c) q[c * n] *= scale;
  q[C::ep * n] = mass * (ep + increment);
  if (!body.temperature.has_pores())
    q[C::temperature_rise * n] +=
        mass * plastic_heating(body.temperature.thermal(), scale * trial, increment, rho);
  return increment;
}

/// Fragments of a row of cells, the first one's at `contents` (components n apart) and `volume`.
struct FragmentRow {
  const double *contents, *volume;
  std::size_t n;
};

/// What find_elastic() knows without a power: a temperature that matter is not above, the density [kg/m3]
/// from which on it melts at no less than PartlyMolten::melts_at, and what damage leaves at least.
struct Bounds {
  HighestTemperature highest;
  double least_density = 0;
  double least_part = 1;  // of its yield stress that damage leaves
};

/// Says of a row of cells which are surely inside the yield surface: return_cell() leaves these as they are.
/// All but the marks are copies, so that the compiler knows that they stay as they are; the marks are as wide
/// as the numbers, so that it takes four cells at a time and not 32.
template <int Dim, class StrengthModel>
RECOIL_MULTIVERSION [[gnu::flatten]] void find_elastic(StrengthModel strength, Bounds bounds, FragmentRow row,
                                                       int count, std::int64_t* elastic) {
  using C = Components<Dim>;
  [[maybe_unused]] const double per_modulus = distortion_energy(1, strength.shear_modulus, 1);
#pragma GCC ivdep
  for (int c = 0; c < count; ++c) {
    const double *q = row.contents + c, per_mass = 1 / q[0], rho = q[0] / row.volume[c];
    const double trial2 = equivalent_stress_squared<Dim>(q + C::s * row.n, row.n) * (per_mass * per_mass);
    const double strain = q[C::ep * row.n] * per_mass, ep = strain > 0 ? strain : 0.0;
    double temperature = 0;
    if constexpr (temperature_dependent<StrengthModel>()) {
      double kinetic = 0;
      for (std::size_t d = 0; d < Dim; ++d) kinetic += q[(C::u + d) * row.n] * q[(C::u + d) * row.n];
      const double e =
          (q[C::energy * row.n] - 0.5 * kinetic * per_mass) * per_mass - trial2 * per_modulus / rho;
      temperature = bounds.highest(rho, e, q[C::temperature_rise * row.n] * per_mass);
      if constexpr (ModelBelow<StrengthModel>::melts)
        if (rho < bounds.least_density) temperature = infinite;
    }
    const double least = bounds.least_part * least_yield(strength, ep, temperature);
    elastic[c] = trial2 < least * least ? 1 : 0;
  }
}

/// Calls f(model) with a body's strength model, within PartlyMolten where it melts, at the temperature that
/// matter does not melt below.
template <int Dim, class F>
void with_strength(const Body<Dim>& body, const F& f) {
  std::visit(
      [&]<class Model>(const Model& model) {
        if (body.temperature.melts())
          f(PartlyMolten<Model>(model, 1, body.temperature.least_melting()));
        else
          f(model);
      },
      body.material.strength);
}

/// What is counted of a fragment that can fail.
struct Failing {
  bool fails_now = false;
  int clamped_damage = 0;
};

/// return_cell() of matter that can fail. @param elastic it does not yield.
template <int Dim, class StrengthModel>
Failing return_failing(const StrengthModel& strength, const Body<Dim>& body, double* q, std::size_t n,
                       double v, double dt, double most_damage, bool elastic, bool may_have_failed = false) {
  FailingCell<Dim> cell(body, q, n, v);
  if (cell.relieve(may_have_failed)) return {};
  const bool failed = cell.has_failed();
  const double growth = elastic ? 0 : return_cell<Dim>(strength, body, q, n, v, dt);
  const int clamped = cell.grow(dt, growth, most_damage);
  return {!failed && cell.has_failed(), clamped};
}

/// return_failing() of matter whose damage grows by a mean: leaves the damage and notes what it grows by.
template <int Dim, class StrengthModel>
void return_noting(const StrengthModel& strength, const Body<Dim>& body, double* q, std::size_t n, double v,
                   double dt, bool elastic, bool may_have_failed, double full, double* drive) {
  FailingCell<Dim> cell(body, q, n, v);
  const double growth =
      cell.relieve(may_have_failed) || elastic ? 0 : return_cell<Dim>(strength, body, q, n, v, dt);
  cell.note(full, growth, drive);
}

/// Brings one fragment of porous matter back to its crush curve. @returns whether its distension was out of
/// bounds.
template <int Dim>
bool crush_cell(const Porous& eos, double* q, std::size_t n, double volume) {
  using C = Components<Dim>;
  const auto at = [&](int c) -> double& { return q[static_cast<std::size_t>(c) * n]; };
  const double mass = at(C::rho), most = eos.alpha0 - 1;
  if (!(mass > 0 && volume > 0)) return false;
  double momentum2 = 0;
  for (int d = 0; d < Dim; ++d) momentum2 += at(C::u + d) * at(C::u + d);
  const double e = (at(C::energy) - 0.5 * momentum2 / mass) / mass, before = at(C::crushed) / mass;
  const double now = eos.crush(mass / volume, e, std::clamp(before, 0.0, most));
  if (now != before) at(C::crushed) = mass * now;
  return before < -least_distension || before > most + least_distension;
}

}  // namespace

template <int Dim>
void return_fragment(const Body<Dim>& body, Contents<Dim>& contents, double volume, double dt) {
  const Strength& strength = body.material.strength;
  const bool fails = can_fail(body.material.damage);
  if (has_strength(strength) || fails)
    with_strength(body, [&](const auto& model) {
      if (fails)
        return_failing<Dim>(model, body, contents.data(), 1, volume, dt, 1, false);
      else
        return_cell<Dim>(model, body, contents.data(), 1, volume, dt);
    });
  if (fails_at_once(body.material.damage)) FailingCell<Dim>(body, contents.data(), 1, volume).fail_at_once();
  if (const auto* eos = std::get_if<Porous>(&body.material.eos))
    crush_cell<Dim>(*eos, contents.data(), 1, volume);
}

template <int Dim>
void return_to_yield(const State<Dim>& state, Body<Dim>& body, int slot, double dt, BlockLedger<Dim>& ledger,
                     double most_damage) {
  const bool fails = can_fail(body.material.damage);
  if (!has_strength(body.material.strength) && !fails) return;
  BodyBlock<Dim>& b = body.at(slot);
  const auto number = static_cast<std::size_t>(&body - state.bodies.data());
  const Box<Dim> cells = state.mesh.block(slot).cells, layout = state.grid(slot).layout();
  const auto n = static_cast<std::size_t>(layout.size());
  const bool by_mean = averages_damage(body.material) && !fails_at_once(body.material.damage);
  if (by_mean) clear_damage_drive(b);
  const Bounds bounds{{body.temperature.thermal(), body.material.eos},
                      TemperatureLaw::least_melting_part * solid_density(body.material),
                      strength_left(body.material.damage, 1)};
  const auto return_one = [&](const auto& strength, const Index<Dim>& i, std::size_t k, bool elastic) {
    double* const q = b.contents.data() + k;
    const double v = b.volume[k];
    if (!fails) {
      if (!elastic) return_cell<Dim>(strength, body, q, n, v, dt);
    } else if (by_mean) {
      return_noting<Dim>(strength, body, q, n, v, dt, elastic, may_have_failed(b, k),
                         state.grid(slot).full_volume(i), b.damage_drive.data() + k);
    } else {
      const Failing after =
          return_failing<Dim>(strength, body, q, n, v, dt, most_damage, elastic, may_have_failed(b, k));
      ledger.counters.clamped_damage += after.clamped_damage;
      if (after.fails_now) ledger.failures[number].note(state.time, state.mesh.finest_index(slot, i));
    }
  };
  Box<Dim> rows = b.matter;
  const int width = rows.extent(0);
  rows.hi[0] = std::min(rows.hi[0], rows.lo[0] + 1);
  std::array<std::int64_t, Window<Dim>::longest> elastic{};  // none, where the model does not say
  with_strength(body, [&]<class Model>(const Model& strength) {
    for_each(rows, [&](Index<Dim> i) {
      const auto first = static_cast<std::size_t>(layout.at(i - cells.lo));
      if constexpr (has_least_yield<Model>())
        find_elastic<Dim>(strength, bounds, {b.contents.data() + first, b.volume.data() + first, n}, width,
                          elastic.data());
      for (std::size_t c = 0; c < static_cast<std::size_t>(width); ++c, ++i[0])
        if (b.volume[first + c] != 0) return_one(strength, i, first + c, elastic[c] != 0);
    });
  });
}

template <int Dim>
void bound_damage(const State<Dim>& state, Body<Dim>& body, int slot) {
  BodyBlock<Dim>& b = body.at(slot);
  const Box<Dim> cells = state.mesh.block(slot).cells, layout = state.grid(slot).layout();
  const auto n = static_cast<std::size_t>(layout.size());
  for_each(b.matter, [&](const Index<Dim>& i) {
    const auto k = static_cast<std::size_t>(layout.at(i - cells.lo));
    double& damage = b.contents[Components<Dim>::damage * n + k];
    if (b.contents[k] > 0 && damage > b.contents[k]) damage = b.contents[k];
  });
}

template <int Dim>
void fail_at_once(const State<Dim>& state, Body<Dim>& body, int slot, BlockLedger<Dim>& ledger) {
  if (!fails_at_once(body.material.damage)) return;
  BodyBlock<Dim>& b = body.at(slot);
  const auto number = static_cast<std::size_t>(&body - state.bodies.data());
  const Box<Dim> cells = state.mesh.block(slot).cells, layout = state.grid(slot).layout();
  const auto n = static_cast<std::size_t>(layout.size());
  for_each(b.matter, [&](const Index<Dim>& i) {
    const auto k = static_cast<std::size_t>(layout.at(i - cells.lo));
    if (FailingCell<Dim>(body, b.contents.data() + k, n, b.volume[k]).fail_at_once())
      ledger.failures[number].note(state.time, state.mesh.finest_index(slot, i));
  });
}

template <int Dim>
void fail_what_moved(const State<Dim>& state, Body<Dim>& body, int slot, BlockLedger<Dim>& ledger) {
  if (!can_fail(body.material.damage)) return;
  BodyBlock<Dim>& b = body.at(slot);
  const bool at_once = fails_at_once(body.material.damage) && !averages_damage(body.material);
  const auto number = static_cast<std::size_t>(&body - state.bodies.data());
  for_each_place(state, slot, [&](const Index<Dim>& i, std::size_t k) {
    FailingCell<Dim> cell(body, b.contents.data() + k, b.volume.size(), b.volume[k]);
    if (may_have_failed(b, k) && cell.relieve(true)) return;
    if (at_once && (b.role[k] & regular) != 0 && cell.fail_at_once())
      ledger.failures[number].note(state.time, state.mesh.finest_index(slot, i));
  });
}

template <int Dim>
void crush_pores(const State<Dim>& state, Body<Dim>& body, int slot, Counters& counters) {
  const auto* eos = std::get_if<Porous>(&body.material.eos);
  if (!eos) return;
  BodyBlock<Dim>& b = body.at(slot);
  const Box<Dim> cells = state.mesh.block(slot).cells, layout = state.grid(slot).layout();
  const auto n = static_cast<std::size_t>(layout.size());
  for_each(b.reach, [&](const Index<Dim>& i) {
    const auto k = static_cast<std::size_t>(layout.at(i - cells.lo));
    if (crush_cell<Dim>(*eos, b.contents.data() + k, n, b.volume[k])) ++counters.clamped_distensions;
  });
}

template <int Dim>
std::int64_t clear_negative_strain(const State<Dim>& state, Body<Dim>& body, int slot) {
  using C = Components<Dim>;
  BodyBlock<Dim>& b = body.at(slot);
  const Box<Dim> layout = state.grid(slot).layout();
  const auto n = static_cast<std::size_t>(layout.size());
  Box<Dim> rows = b.reach;
  const int width = rows.extent(0);
  rows.hi[0] = std::min(rows.hi[0], rows.lo[0] + 1);
  const double least = body.temperature.has_pores() ? least_distension : least_heat;
  std::int64_t count = 0;
  for_each(rows, [&](const Index<Dim>& i) {
    const auto first = static_cast<std::size_t>(layout.at(i - state.mesh.block(slot).cells.lo));
    double* const mass = b.contents.data() + C::rho * n + first;
    double *const strain = b.contents.data() + C::ep * n + first, *const heat = b.contents.data() +
                                                                                C::temperature_rise * n +
                                                                                first;
    int any = 0;
#pragma omp simd reduction(| : any)
    for (int k = 0; k < width; ++k) any |= ((strain[k] * mass[k] < 0) | (heat[k] * mass[k] < 0)) ? 1 : 0;
    for (int k = 0; any != 0 && k < width; ++k) {
      const double square = mass[k] * mass[k], s = strain[k] * mass[k], h = heat[k] * mass[k];
      if (s < -least_strain * square || h < -least * square) ++count;
      if (s < 0) strain[k] = 0;
      if (h < 0) heat[k] = 0;
    }
  });
  return count;
}

template <int Dim>
void combine_with_old(const State<Dim>& state, Body<Dim>& body, int slot, double old_weight) {
  BodyBlock<Dim>& b = body.at(slot);
  const Box<Dim> layout = state.grid(slot).layout();
  const auto n = static_cast<std::size_t>(layout.size());
  Box<Dim> rows = b.reach;
  const int width = rows.extent(0);
  rows.hi[0] = std::min(rows.hi[0], rows.lo[0] + 1);
  for_each(rows, [&](const Index<Dim>& i) {
    const auto first = static_cast<std::size_t>(layout.at(i - state.mesh.block(slot).cells.lo));
    for (std::size_t c = 0; c < Components<Dim>::contents; ++c)
      detail::mix(width, old_weight, b.contents_old.data() + c * n + first,
                  b.contents.data() + c * n + first);
    detail::mix(width, old_weight, b.volume_old.data() + first, b.volume.data() + first);
  });
}

#define RECOIL_INSTANTIATE(Dim)                                                                              \
  template void return_fragment<Dim>(const Body<Dim>&, Contents<Dim>&, double, double);                      \
  template void return_to_yield<Dim>(const State<Dim>&, Body<Dim>&, int, double, BlockLedger<Dim>&, double); \
  template void bound_damage<Dim>(const State<Dim>&, Body<Dim>&, int);                                       \
  template void fail_at_once<Dim>(const State<Dim>&, Body<Dim>&, int, BlockLedger<Dim>&);                    \
  template void fail_what_moved<Dim>(const State<Dim>&, Body<Dim>&, int, BlockLedger<Dim>&);                 \
  template void crush_pores<Dim>(const State<Dim>&, Body<Dim>&, int, Counters&);                             \
  template std::int64_t clear_negative_strain<Dim>(const State<Dim>&, Body<Dim>&, int);                      \
  template void combine_with_old<Dim>(const State<Dim>&, Body<Dim>&, int, double);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
