#include "app/plot/round_off.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "app/load_case.hpp"
#include "config/units.hpp"
#include "core/error.hpp"
#include "picture/axis.hpp"

namespace recoil::app {

std::string unit_in(const std::string& label) {
  const std::size_t open = label.rfind('[');
  return open == std::string::npos || !label.ends_with(']') ? "1"
                                                            : label.substr(open + 1, label.size() - open - 2);
}

double RoundOff::in(const std::string& unit) const {
  if (unit.empty() || unit == "1") return number;
  struct Known {
    const char* unit;
    double value;
  };
  for (const Known& known : {Known{"GPa", stress}, Known{"m/s", speed}, Known{"kg/m3", density},
                             Known{"K", temperature}, Known{"mm", length}})
    if (unit == known.unit) return known.value / config::unit_size(unit);
  return 0;
}

Spread RoundOff::judge(const std::string& unit, double lowest, double highest, double digits) const {
  if (!(lowest <= highest)) return Spread::real;
  const double noise = in(unit), largest = std::max(std::abs(lowest), std::abs(highest));
  if (largest > 0 && largest <= noise) return Spread::round_off;
  return lowest < highest && highest - lowest <= std::max(noise, digits * largest) ? Spread::uniform
                                                                                   : Spread::real;
}

RoundOff round_off_of(const LoadedCase& run) {
  double stiffest = 0, fastest = 0, densest = 0, hottest = 0;
  for (std::size_t m = 0; m < run.materials.size(); ++m) {
    if (run.contents.bodies[m].rigid) continue;
    const Material& material = run.materials[m];
    const double c = longitudinal_speed(material), rho = density(material);
    stiffest = std::max(stiffest, rho * c * c);
    fastest = std::max(fastest, c);
    densest = std::max(densest, rho);
    if (material.thermal.specific_heat > 0)
      hottest = std::max(hottest, c * c / material.thermal.specific_heat);
  }
  constexpr double part = RoundOff::part;
  return {
      part * stiffest, part * fastest, part * densest, part * hottest, part * run.contents.mesh.finest, part};
}

RoundOff round_off_of(const std::string& folder) {
  try {
    return round_off_of(load_run(folder));
  } catch (const InputError&) {
    return {};  // tables alone can be drawn as well
  }
}

std::optional<std::pair<double, double>> honest_range(Spread spread, double least, double lowest,
                                                      double highest, bool signed_values) {
  if (spread == Spread::real) return std::nullopt;
  if (spread == Spread::round_off) return std::pair{signed_values || lowest < 0 ? -least : 0.0, least};
  const double middle = 0.5 * (lowest + highest);
  const AxisScale around = axis_around({middle, middle}, 0);
  return std::pair{around.lo, around.hi};
}

std::string noted(const std::string& label, Spread spread) {
  if (spread == Spread::real) return label;
  return label + (spread == Spread::uniform ? ", uniform" : ", round-off only");
}

}  // namespace recoil::app
