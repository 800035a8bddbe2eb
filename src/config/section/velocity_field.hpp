#pragma once

#include <functional>
#include <string>
#include <vector>

#include "config/declare/entry.hpp"

namespace recoil::config {

/// Formulas (config/formula/formula.hpp) of the velocity of a body at the start, by coordinate; an empty text
/// is 0.
struct VelocityField {
  std::string x, y, z, r;

  static constexpr const char* doc =
      "The velocity of a body at the start as formulas of the coordinates, in numbers times units: "
      "\"20*m/s * sin(pi*x/(60*mm))\". Units are km, m, cm, mm, um, s, ms, us and ns.";
  static Entries<VelocityField> keys();
  void check(const TableReading& reading) const;
  bool is_given() const { return !(x.empty() && y.empty() && z.empty() && r.empty()); }
  /// The formulas in the order of the coordinates.
  std::vector<std::string> along(Geometry geometry) const;
};

/// The velocity in SI at a place [m]. One function is not for several threads at once. @pre the formulas have
/// been checked.
std::function<Vector(const Vector&)> evaluated(const VelocityField& field, Geometry geometry);

/// The largest speed [m/s] among samples in a box [m]; 0 without formulas.
double fastest_in(const VelocityField& field, Geometry geometry, const Vector& lo, const Vector& hi);

}  // namespace recoil::config
