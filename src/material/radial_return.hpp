#pragma once

#include <algorithm>
#include <cmath>
#include <variant>

#include "core/series.hpp"
#include "material/strength/partly_molten.hpp"
#include "material/strength/strength.hpp"

namespace recoil {

/// The increment dep >= 0 of equivalent plastic strain that puts a trial stress back on the yield
/// surface (Wilkins 1964), with the rate of the same increment:
///   q_trial - 3 G dep = yield(ep + dep, dep/dt, ...).
/// q_trial: equivalent stress of the trial [Pa]; `before`: the state with the plastic strain before, its rate
/// is not used; dt [s] > 0.
/// 0 inside the surface. The stress deviator is to be scaled by 1 - 3 G dep/q_trial. The equation
/// holds to 1e-12 q_trial. A melted material (yield 0) gives q_trial/(3 G).
/// One overload per kind of yield: constant or linear in ep; of Johnson and Cook's form; any other.
template <class Model>
requires(!Model::rate_dependent) double plastic_increment(const Model& s, double q_trial, YieldState before,
                                                          double /*dt*/) {
  before.rate = 0;
  const double excess = q_trial - s.yield(before);
  if (!(excess > 0) || !(s.shear_modulus > 0)) return 0;
  return excess / (3 * s.shear_modulus + constant_hardening(s));
}

/// Whether least_yield() says anything of a model.
template <class Model>
constexpr bool has_least_yield() {
  if constexpr (ModelBelow<Model>::melts)
    return has_least_yield<typename ModelBelow<Model>::type>();
  else if constexpr (requires(const Model& s) { s.a, s.m, s.melting_temperature; })
    return true;
  else
    return !Model::rate_dependent && !temperature_dependent<Model>() && !pressure_dependent<Model>() &&
           !damage_dependent<Model>();
}

/// A stress [Pa] that the yield stress does not fall below, without a power: of Johnson and Cook's form
/// hardening and rate only raise the surface, and T*^m <= T* where m >= 1. 0: nothing is known.
/// @param temperature or one above it. Matter that melts has it below its melting temperature, or one below
/// that.
template <class Model>
[[gnu::always_inline]] inline double least_yield(const Model& s, [[maybe_unused]] double ep,
                                                 [[maybe_unused]] double temperature) {
  constexpr double rounding = 1e-9;
  using Below = typename ModelBelow<Model>::type;
  if constexpr (ModelBelow<Model>::melts)
    return s.solid > 0 && temperature < s.melts_at ? s.solid * least_yield<Below>(s, ep, temperature) : 0.0;
  else if constexpr (requires { s.a, s.m, s.melting_temperature; }) {
    const double t =
        (temperature - s.reference_temperature) / (s.melting_temperature - s.reference_temperature);
    const double left = 1 - (t < 0 ? 0.0 : t) - rounding;  // not a number stays so
    const double cold = s.m >= 1 ? s.a : 0.0;
    return left > 0 ? cold * left : 0.0;
  } else if constexpr (has_least_yield<Model>()) {
    return s.yield({.ep = ep}) * (1 - rounding);
  } else {
    return 0;
  }
}

/// Yield stress and slopes at a plastic strain of ep and a growing increment, before softening
/// (Model::expand).
template <class Model>
auto expansion_from(const Model& s, double ep) {
  if constexpr (requires { s.hardened(ep); })
    return [&s, start = s.hardened(ep)](double more, double log_rate) {
      return s.expand(start, more, log_rate);
    };
  else
    return [&s, ep](double more, double log_rate) { return s.expand(ep + more, log_rate); };
}

/// Newton's method in y = ln(dep/(dt reference_rate)). Its residual falls with y and is concave (see
/// Model::expand), so that steps from the right of the root approach it without overshoot: no
/// bracket is needed, a few steps suffice, and the same input gives the same bits.
template <class Model>
requires(Model::rate_dependent&& requires(const Model& m) {
  m.expand(1.0, 1.0);
}) double plastic_increment(const Model& s, double q_trial, const YieldState& before, double dt) {
  if (q_trial < least_yield(s, before.ep, before.temperature)) return 0;
  const double ep = before.ep, soft = s.softening(before.temperature);
  const auto expand = expansion_from(s, ep);
  const double static_yield = soft * expand(0, 0).yield;
  const double excess = q_trial - static_yield;
  if (!(excess > 0)) return 0;
  const double stiffness = 3 * s.shear_modulus;
  const double most = excess / stiffness;  // with neither hardening nor rate
  if (!(static_yield > 0) && soft <= 0) return most;

  const double tolerance = 1e-12 * q_trial;
  const double unit = dt * s.reference_rate;
  double y = std::log(most / unit);
  if (s.c * static_yield > 0) y = std::min(y, excess / (s.c * static_yield));  // with the rate term alone
  double x = unit * std::exp(y);
  for (int i = 0; i < 40 && x > 0; ++i) {
    const auto at = expand(x, y);
    const double residual = q_trial - stiffness * x - soft * at.yield;
    if (std::fabs(residual) <= tolerance) break;
    const double slope = stiffness * x + soft * (at.by_ep * x + at.by_log_rate);
    y += residual / slope;
    x *= exp_of_small(residual / slope);
  }
  return x;
}

/// False position (Illinois) in ln(dep) between 1e-30 and 1 of the increment at the yield stress before;
/// 0 if the root is smaller still. Needs nothing but a yield stress that does not fall with dep.
template <class Model>
requires(Model::rate_dependent && !requires(const Model& m) {
  m.expand(1.0, 1.0);
}) double plastic_increment(const Model& s, double q_trial, YieldState before, double dt) {
  before.rate = 0;
  const double excess = q_trial - s.yield(before), stiffness = 3 * s.shear_modulus;
  if (!(excess > 0)) return 0;
  const double ep = before.ep, most = excess / stiffness, tolerance = 1e-12 * q_trial;
  const auto residual = [&](double x) {
    before.ep = ep + x;
    before.rate = x / dt;
    return q_trial - stiffness * x - s.yield(before);
  };
  double low = std::log(1e-30), high = 0, at_low = residual(1e-30 * most), at_high = residual(most);
  if (!(at_low > 0)) return 0;
  if (at_high >= -tolerance) return most;
  double y = high;
  for (int i = 0, kept = 0; i < 200; ++i) {
    y = (low * at_high - high * at_low) / (at_high - at_low);
    const double at = residual(most * std::exp(y));
    if (std::fabs(at) <= tolerance) break;
    const int side = at > 0 ? 1 : -1;
    (at > 0 ? low : high) = y;
    (at > 0 ? at_low : at_high) = at;
    if (side == kept) (at > 0 ? at_high : at_low) *= 0.5;
    kept = side;
  }
  return most * std::exp(y);
}

/// The same of whichever model the material has. @param solid part of it, the rest is molten.
/// @param melts_at melting temperature [K] of the state.
inline double plastic_increment(const Strength& strength, double q_trial, const YieldState& before, double dt,
                                double solid = 1, double melts_at = infinite) {
  return std::visit(
      [&]<class Model>(const Model& model) {
        return plastic_increment(PartlyMolten<Model>(model, solid, melts_at), q_trial, before, dt);
      },
      strength);
}

}  // namespace recoil
