#include "material/starting_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "core/error.hpp"

namespace recoil {

namespace {

/// e [J/kg] of matter of one density and temperature.
double energy_of(const TemperatureLaw& law, double rho, double t) {
  if (law.thermal().rule == Thermal::Rule::plastic_work) return law.isentrope(rho);
  return law.energy_at(law.solid_density(rho, 0), t);
}

}  // namespace

StartingState state_at_start(const Material& m, std::optional<double> pressure,
                             std::optional<double> temperature, const std::string& body) {
  const double rho0 = density(m), p = pressure.value_or(0);
  if (!pressure && !temperature) return {rho0, 0, 0};
  const TemperatureLaw law = temperature_law(m);
  const double start = m.thermal.initial_temperature, t = temperature.value_or(start);
  const auto fail = [&](const std::string& why) {
    throw InputError(
        fmt::format("body '{}' cannot start at {:.6g} GPa and {:.6g} K: {}", body, p * 1e-9, t, why));
  };
  const bool by_work = m.thermal.rule == Thermal::Rule::plastic_work;
  if (by_work && t < start)
    fail(fmt::format("where only plastic work heats, the least temperature is the initial {:.6g} K", start));
  if (const auto* porous = std::get_if<Porous>(&m.eos); porous && p > porous->elastic_limit)
    fail(fmt::format("its pores are crushed above {:.6g} GPa", porous->elastic_limit * 1e-9));
  const auto excess = [&](double rho) { return recoil::pressure(m.eos, rho, energy_of(law, rho, t)) - p; };
  // From rest to the nearest density that has this pressure.
  const DensityRange range = density_range(m.eos);
  const double least = range.least * rho0,
               most = std::min(range.most * rho0, largest_density(m.eos) * (1 - 1e-9));
  double near = rho0, far = rho0;
  const bool denser = excess(rho0) < 0;
  while (excess(far) != 0 && (excess(far) < 0) == denser) {
    near = far;
    far *= denser ? 1.002 : 1 / 1.002;
    if (far < least || far > most) fail("its equation of state has no such state");
  }
  for (int k = 0; k < 100 && near != far; ++k) {
    const double middle = 0.5 * (near + far);
    if (middle == near || middle == far) break;
    ((excess(middle) < 0) == denser ? near : far) = middle;
  }
  const double e = barotropic(m.eos) ? energy_of(law, far, t) : energy(m.eos, far, p);
  if (!(sound_speed_squared(m.eos, far, p) > 0)) fail("matter is unstable there");
  return {far, e, by_work ? t - start : 0.0};
}

double over_isentrope(const TemperatureLaw& law, const StartingState& start) {
  const double t = law.unmelted(start.density, start.energy, start.heat);
  const bool by_energy = law.thermal().rule == Thermal::Rule::energy;
  return t / (by_energy ? law.on_isentrope(law.solid_density(start.density, 0))
                        : law.thermal().initial_temperature);
}

}  // namespace recoil
