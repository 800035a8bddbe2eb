#pragma once

#include <memory>
#include <string>
#include <vector>

#include "config/geometry.hpp"

namespace recoil::config {

/// A formula of the coordinates, such as "20*m/s * sin(pi*x/(60*mm))". It knows numbers, the coordinates of
/// the geometry, `pi`, lengths (km, m, cm, mm, um) and times (s, ms, us, ns) as units to multiply with, the
/// operators + - * / ^ and comparisons with `? :`, and the usual functions (sin, cosh, exp, sqrt, abs,
/// min...). Not for several threads at once: its value is found in place.
class Formula {
 public:
  /// @param axes names of the coordinates. @throws InputError, which says what is wrong with the text.
  Formula(const std::string& text, const std::vector<std::string>& axes);
  Formula(Formula&&) noexcept;
  Formula& operator=(Formula&&) noexcept;
  ~Formula();

  /// The value in SI at x [m].
  double at(const Vector& x) const;

  /// Whether the value is a velocity whatever the units: it then follows the unit of length and the inverse
  /// of that of time. @param places where it is asked [m]; those without a finite value say nothing.
  bool is_velocity(const std::vector<Vector>& places) const;

 private:
  struct Parts;
  double at(const Vector& x, double length_unit, double time_unit) const;

  std::unique_ptr<Parts> parts_;
};

}  // namespace recoil::config
