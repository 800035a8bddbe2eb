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

/// What stands behind the names of columns of which there is one for each `each`; an empty text for none.
std::vector<std::string> parts(config::Column::Each each, const RunUnits& units) {
  using enum config::Column::Each;
  std::vector<std::string> names = each == axis ? units.axes : each == stress ? units.stresses : units.turns;
  if (each == once || (each == turn && names.size() == 1)) return {""};
  for (std::string& name : names) name = "." + name;
  return names;
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
  std::vector<SeriesColumn> all;
  for (const config::Column& c : declared) {
    const std::string unit = unit_of(c.unit, units);
    for (const std::string& part : parts(c.each, units)) all.push_back({c.name + part, unit, to_unit(unit)});
  }
  return all;
}

}  // namespace recoil
