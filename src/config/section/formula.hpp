#pragma once

#include <memory>
#include <string>
#include <vector>

#include "config/geometry.hpp"

namespace recoil::config {

/// A formula of the coordinates, such as "20*m/s * sin(pi*x/(60*mm))". It knows numbers, the coordinates of
/// the geometry, `pi`, lengths (km, m, cm, mm, um) and times (s, ms, us, ns) as units to multiply with, the
/// operators + - * / ^ and comparisons with `? :`, and the functions of muParser
/// (docs/how-to/describe-a-body.md lists them). Not for several threads at once: its value is found in place.
class Formula {
 public:
  /// @param axes names of the coordinates. @throws InputError, which says what is wrong with the text.
  Formula(const std::string& text, const std::vector<std::string>& axes);
  Formula(Formula&&) noexcept;
  Formula& operator=(Formula&&) noexcept;
  ~Formula();

  /// The value in SI at x [m].
  double at(const Vector& x) const;

  /// Whether the value follows these powers of the units of length and time, whatever the units are. They are
  /// varied over many orders, so that a comparison with a bare number is found too. @param places where it is
  /// asked, and at their mirror images [m]; those without a finite value say nothing.
  bool has_dimension(const std::vector<Vector>& places, int length, int time) const;
  bool is_velocity(const std::vector<Vector>& places) const { return has_dimension(places, 1, -1); }

 private:
  struct Parts;
  double at(const Vector& x, double length_unit, double time_unit) const;

  std::unique_ptr<Parts> parts_;
};

}  // namespace recoil::config
