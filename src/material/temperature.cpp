#include "material/temperature.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <variant>

namespace recoil {

template <class Model>
void TemperatureLaw::tabulate(const Model& eos) {
  fill(eos);
  tabulate_growth(eos);
}
void TemperatureLaw::tabulate(const MieGruneisen& eos) {
  gamma0_ = eos.gamma0;
  fill(eos);
  tabulate_growth(eos);
  closed_from_ = MieGruneisen::straight_to * eos.rho0;
}
void TemperatureLaw::tabulate(const IdealGas& eos) {  // whose densities go beyond any table
  rho0_ = eos.rho0;
  gas_power_ = eos.gamma - 1;
  gas_energy_ = (eos.p0 + eos.p_inf) / eos.rho0;
}
void TemperatureLaw::tabulate(const LinearEos& eos) { fill(eos); }  // gamma0_ = 0: the isentrope stays at T0
void TemperatureLaw::tabulate(const PolynomialEos& eos) { fill(eos); }
void TemperatureLaw::tabulate(const Porous& eos) {
  std::visit([this](const auto& m) { tabulate(m); }, eos.solid);
  distension_ = eos.alpha0;
}
void TemperatureLaw::tabulate(const Tabular& eos) {
  own_ = eos.table;
  fill(eos);
}

/// Integrates de/drho = p/rho^2 from rest both ways by the classical Runge-Kutta rule: from 0.4 rho0, or
/// the least density that the material has (at least 8e-6 rho0), to the largest admissible one, at most 4
/// rho0.
template <class Model>
void TemperatureLaw::fill(const Model& eos) {
  const DensityRange range = density_range(eos);
  const double part_below = 1 - std::min(0.4, 0.8 * std::max(range.least, 1e-5));
  const int below = static_cast<int>(std::lround(part_below / 3e-4));
  rho0_ = eos.rho0;
  spacing_ = part_below * rho0_ / below;
  lowest_ = rho0_ - below * spacing_;
  const double highest = std::min(eos.largest_density(), std::clamp(range.most, 4.0, 10.0) * rho0_);
  const int above = static_cast<int>(std::ceil((highest - rho0_) / spacing_));
  table_.assign(static_cast<std::size_t>(below + above) + 1, 0.0);
  rest_ = below;
  for (int k = below; k < below + above; ++k) advance(eos, k, +1);
  for (int k = below; k > 0; --k) advance(eos, k, -1);
}

/// ln(T_s/T0) by the trapezoidal rule over the table of e_s.
template <class Model>
void TemperatureLaw::tabulate_growth(const Model& eos) {
  const auto slope = [&](int k) {
    const double rho = lowest_ + k * spacing_, e = table_[static_cast<std::size_t>(k)];
    constexpr double step = 1e3;  // J/kg
    return (eos.pressure(rho, e + step) - eos.pressure(rho, e - step)) / (2 * step * rho * rho);
  };
  closed_from_ = infinite;
  growth_.assign(table_.size(), 0.0);
  const int last = static_cast<int>(table_.size()) - 1;
  const auto add = [&](int from, int to) {
    growth_[static_cast<std::size_t>(to)] =
        growth_[static_cast<std::size_t>(from)] + 0.5 * (to - from) * spacing_ * (slope(from) + slope(to));
  };
  for (int k = rest_; k < last; ++k) add(k, k + 1);
  for (int k = rest_; k > 0; --k) add(k, k - 1);
}

template <class Model>
void TemperatureLaw::advance(const Model& eos, int k, int direction) {
  const auto from = static_cast<std::size_t>(k), to = static_cast<std::size_t>(k + direction);
  const double h = direction * spacing_;
  const double r = lowest_ + k * spacing_, e = table_[from];
  const auto slope = [&](double rho, double energy) { return eos.pressure(rho, energy) / (rho * rho); };
  const double k1 = slope(r, e);
  const double k2 = slope(r + 0.5 * h, e + 0.5 * h * k1);
  const double k3 = slope(r + 0.5 * h, e + 0.5 * h * k2);
  const double k4 = slope(r + h, e + h * k3);
  table_[to] = e + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
}

/// From the melting temperature without pressure, where heat has expanded matter, to that at rest density.
template <class Model>
void TemperatureLaw::find_melting_at_rest(const Model& eos) {
  if (!melting_.melts()) return;
  melting_at_rest_ = melting_.temperature;
  if (!melting_.at_rest) melting_at_rest_ *= melting_.temperature / melting_at(density_without_pressure(eos));
  find_least_melting(std::log(std::min(eos.largest_density() / rho0_, 10.0)));
}
/// Of the solid at its melting temperature [kg/m3].
template <class Model>
double TemperatureLaw::density_without_pressure(const Model& eos) const {
  const auto pushes = [&](double rho) {
    return eos.pressure(rho, solid_energy_at(rho, melting_.temperature)) > 0;
  };
  double free = rho0_, denser = rho0_;
  const double least = std::max(0.5, density_range(eos).least) * rho0_;
  while (pushes(free) && free > least) denser = free, free *= 1 - 1e-3;
  for (int k = 0; k < 60 && free < denser; ++k) {
    const double middle = 0.5 * (free + denser);
    (pushes(middle) ? denser : free) = middle;
  }
  return free;
}
void TemperatureLaw::find_melting_at_rest(const Porous& eos) {
  std::visit([this](const auto& m) { find_melting_at_rest(m); }, eos.solid);
}

/// @param last logarithm of the largest compression.
void TemperatureLaw::find_least_melting(double last) {
  constexpr int samples = 64;
  constexpr double between = 0.99;  // of the least sample, for what lies between
  const double first = std::log(least_melting_part);
  for (int k = 0; k <= samples; ++k) {
    const double rho = rho0_ * std::exp(first + (last - first) * k / samples);
    least_melting_ = std::min(least_melting_, between * melting_at(rho));
  }
}

TemperatureLaw::TemperatureLaw(const Thermal& thermal, const Eos& eos, const Melting& melting)
    : thermal_(thermal), melting_(melting) {
  if (!(density(eos) > 0)) return;  // of a rigid body
  std::visit([this](const auto& m) { tabulate(m), find_melting_at_rest(m); }, eos);
}

}  // namespace recoil
