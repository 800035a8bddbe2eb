#include "gauge/column_list.hpp"

#include <numbers>
#include <string>

namespace recoil {

namespace {

/// The unit of sums that a declaration's word means, or the word.
std::string unit_of(const std::string& declared, const RunUnits& units) {
  if (declared == "mass") return units.mass;
  if (declared == "momentum") return units.momentum;
  if (declared == "energy") return units.energy;
  if (declared == "force") return units.force;
  if (declared == "area") return units.area;
  if (declared == "volume") return units.volume;
  return declared;
}

/// A value in SI times this is in the unit.
double to_unit(const std::string& unit) {
  if (unit == "GPa") return 1e-9;
  if (unit == "mm") return 1e3;
  if (unit == "us") return 1e6;
  if (unit == "deg") return 180 / std::numbers::pi;
  return 1;
}

}  // namespace

std::vector<SeriesColumn> column_list(const std::vector<config::Column>& declared, const RunUnits& units) {
  using enum config::Column::Each;
  std::vector<SeriesColumn> all;
  for (const config::Column& c : declared) {
    const std::string unit = unit_of(c.unit, units);
    if (c.each == once) all.push_back({c.name, unit, to_unit(unit)});
    if (c.each == once) continue;
    for (const std::string& part : c.each == axis ? units.axes : units.stresses)
      all.push_back({std::string(c.name) + "." + part, unit, to_unit(unit)});
  }
  return all;
}

}  // namespace recoil
