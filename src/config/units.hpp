#pragma once

#include <string>
#include <string_view>

namespace recoil::config {

/// A text read as a number with a unit, or why that failed.
struct Quantity {
  double value = 0;     // SI
  double written = 0;   // the number as written
  std::string unit;     // as written
  std::string problem;  // empty: all is well
  std::string help;     // how to cure the problem
  bool ok() const { return problem.empty(); }
};

/// Reads "0.05 mm" as SI and checks that its dimension is that of `si_unit` ("m", "kg/m3", "J/(kg K)", ...;
/// "1" or empty: a pure number, "3 %" included). `name` is what the message calls the key. Angles are never
/// taken from units without one (Hz, 1/s), nor given to others.
Quantity parse_quantity(std::string_view text, std::string_view si_unit, std::string_view name);

/// Reads a text of any dimension to coherent SI.
Quantity parse_any_quantity(std::string_view text, std::string_view name);

/// What 1 of `unit` is in SI, without any shift of zero (1 degC is 1 K). @throws InputError for an unknown
/// unit.
double unit_size(std::string_view unit);

/// A value in SI expressed in `unit` (shift of zero included). @throws InputError for an unknown unit.
double in_unit(double si, std::string_view unit);

/// "5.084 GPa": a value in SI, printed in `unit` with that many significant digits.
std::string format_quantity(double si, std::string_view unit, int digits = 6);

/// "length", "velocity", ... of a unit, or its base units where it has no common name.
std::string dimension_name(std::string_view unit);

/// Whether a value that was written in `given` can be compared with one in `needed`: both of one dimension,
/// or zero without a unit. @throws InputError for an unknown unit.
bool is_comparable(double value, std::string_view given, std::string_view needed);

/// The coherent SI unit of the same dimension, where it is a common one: "mm/us" gives "m/s"; else empty.
std::string si_unit_of(std::string_view unit);

}  // namespace recoil::config
