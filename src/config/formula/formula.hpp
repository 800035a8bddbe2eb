#pragma once

#include <memory>
#include <string>
#include <vector>

#include "config/geometry.hpp"

namespace recoil::config {

/// Powers of the units of a quantity.
struct Dimension {
  int length = 0, time = 0, pressure = 0;
};

/// A formula of the coordinates, such as "20*m/s * sin(pi*x/(60*mm))". It knows numbers, the coordinates of
/// the geometry, `pi`, lengths (km, m, cm, mm, um) and times (s, ms, us, ns) as units to multiply with, the
/// operators + - * / ^ and comparisons with `? :`, and the functions of muParser
/// (docs/how-to/describe-a-body.md lists them). Not for several threads at once: its value is found in place.
class Formula {
 public:
  enum class Of {
    place,
    place_and_time
  };  // the latter knows the time `t`, and units of pressure (GPa to Pa)

  /// @param axes names of the coordinates. @throws InputError, which says what is wrong with the text.
  Formula(const std::string& text, const std::vector<std::string>& axes, Of of = Of::place);
  Formula(Formula&&) noexcept;
  Formula& operator=(Formula&&) noexcept;
  ~Formula();

  /// The value in SI at a place [m] and a time [s].
  double at(const Vector& x, double time = 0) const;

  /// Whether the value follows these powers of the units, whatever the units are. They are varied over many
  /// orders, so that a comparison with a bare number is found too. @param places where it is asked, and at
  /// their mirror images [m]; those without a finite value say nothing.
  bool has_dimension(const std::vector<Vector>& places, const Dimension& dimension) const;

 private:
  struct Parts;
  struct UnitSizes;
  double at(const Vector& x, double time, const UnitSizes& sizes) const;

  std::unique_ptr<Parts> parts_;
};

}  // namespace recoil::config
