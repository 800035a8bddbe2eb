#pragma once

#include <algorithm>
#include <cmath>

#include "material/strength/strength.hpp"

namespace recoil {

/// The increment dep >= 0 of equivalent plastic strain that puts a trial stress back on the yield
/// surface (Wilkins 1964), with the rate of the same increment:
///   q_trial - 3 G dep = yield(ep + dep, dep/dt, temperature).
/// q_trial: equivalent stress of the trial [Pa]; ep: plastic strain before, >= 0; dt [s] > 0.
/// 0 inside the surface. The stress deviator is to be scaled by 1 - 3 G dep/q_trial. The equation
/// holds to 1e-12 q_trial. A melted material (yield 0) gives q_trial/(3 G).
/// One overload per kind of yield: constant, linear in ep, rate dependent.
template <class Model>
requires(!Model::rate_dependent) double plastic_increment(const Model& s, double q_trial, double ep,
                                                          double temperature, double /*dt*/) {
  const double excess = q_trial - s.yield(ep, 0, temperature);
  if (!(excess > 0) || !(s.shear_modulus > 0)) return 0;
  double slope = 0;
  if constexpr (requires { s.hardening; }) slope = s.hardening;
  return excess / (3 * s.shear_modulus + slope);
}

/// Newton's method in y = ln(dep/(dt reference_rate)). Its residual falls with y and is concave (see
/// Model::expand), so that steps from the right of the root approach it without overshoot: no
/// bracket is needed, a few steps suffice, and the same input gives the same bits.
template <class Model>
requires(Model::rate_dependent) double plastic_increment(const Model& s, double q_trial, double ep,
                                                         double temperature, double dt) {
  const double soft = s.softening(temperature);
  const double static_yield = soft * s.yield(ep, 0, s.reference_temperature);
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
    const auto at = s.expand(ep + x, y);
    const double residual = q_trial - stiffness * x - soft * at.yield;
    if (std::fabs(residual) <= tolerance) break;
    const double slope = stiffness * x + soft * (at.by_ep * x + at.by_log_rate);
    y += residual / slope;
    x = unit * std::exp(y);
  }
  return x;
}

}  // namespace recoil
