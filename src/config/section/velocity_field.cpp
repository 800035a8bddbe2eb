#include "config/section/velocity_field.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <regex>
#include <utility>

#include "config/declare/reading.hpp"
#include "config/section/formula.hpp"
#include "core/error.hpp"

namespace recoil::config {

namespace {

constexpr const char* example = "\"20*m/s * sin(pi*x/(60*mm))\"";

constexpr const char* functions =
    "sin, cos, tan, asin, acos, atan, atan2, sinh, cosh, tanh, asinh, acosh, atanh, exp, ln, "
    "log (of base e), log2, log10, sqrt, abs, sign, rint, min, max, sum, avg";

/// Places within the domain that lie on no plane of symmetry of it.
std::vector<Vector> places_in(const Vector& lo, const Vector& hi) {
  std::vector<Vector> places;
  for (const Vector& part :
       {Vector{0.137, 0.211, 0.843}, Vector{0.618, 0.419, 0.271}, Vector{0.893, 0.769, 0.557},
        Vector{0.021, 0.947, 0.389}, Vector{0.977, 0.033, 0.691}, Vector{0.371, 0.583, 0.017}}) {
    Vector& x = places.emplace_back();
    for (std::size_t d = 0; d < x.size(); ++d) x[d] = lo[d] + part[d] * (hi[d] - lo[d]);
  }
  return places;
}

/// What stands in the parentheses that open before `begin`.
std::string argument_at(const std::string& text, std::size_t begin) {
  std::size_t end = begin;
  for (int depth = 1; end < text.size(); ++end) {
    depth += text[end] == '(' ? 1 : text[end] == ')' ? -1 : 0;
    if (depth == 0) break;
  }
  return text.substr(begin, end - begin);
}

/// The first function of pure numbers that is given a number with a unit; empty: none is.
std::string function_of_units(const std::string& text, const std::vector<std::string>& axes,
                              const std::vector<Vector>& places) {
  static const std::regex call(
      R"(\b(sin|cos|tan|asin|acos|atan|sinh|cosh|tanh|asinh|acosh|atanh|exp|ln|log|log2|log10|rint)\s*\()");
  for (auto at = std::sregex_iterator(text.begin(), text.end(), call); at != std::sregex_iterator(); ++at) {
    const std::size_t begin = static_cast<std::size_t>(at->position() + at->length());
    if (!Formula(argument_at(text, begin), axes).has_dimension(places, 0, 0)) return (*at)[1];
  }
  return {};
}

void check_dimension(const TableReading& reading, const char* key, const std::string& text) {
  const std::vector<std::string>& axes = reading.in.axes;
  const Formula formula(text, axes);
  const std::vector<Vector> places = places_in(reading.in.lo, reading.in.hi);
  if (!reading.in.knows_domain || formula.is_velocity(places)) return;
  const std::string function = function_of_units(text, axes, places);
  if (!function.empty())
    return reading.wrong(
        key,
        fmt::format("the formula of '{}' is no velocity: {} needs a pure number, and is given "
                    "one with a unit",
                    key, function),
        fmt::format("divide by a unit: {}({}/mm)", function, axes.front()));
  reading.wrong(key,
                fmt::format("the formula of '{}' is no velocity: numbers need units, and coordinates are "
                            "lengths",
                            key),
                text.find_first_of("<>=") == std::string::npos
                    ? fmt::format("e.g. {} = {}", key, example)
                    : fmt::format("so do numbers in comparisons: {} > 20*mm ? 5*m/s : 0*m/s", axes.front()));
}

void check_formula(const TableReading& reading, const char* key, const std::string& text) {
  const std::vector<std::string>& axes = reading.in.axes;
  if (!reading.has(key) || !reading.good(key) || std::ranges::find(axes, key) == axes.end()) return;
  try {
    check_dimension(reading, key, text);
  } catch (const InputError& e) {
    reading.wrong(
        key, fmt::format("the formula of '{}' {}", key, e.what()),
        fmt::format("coordinates are {}, units km, m, cm, mm, um, s, ms, us, ns, functions {}; e.g. {} "
                    "= {}",
                    fmt::join(axes, ", "), functions, key, example));
  }
}

}  // namespace

Entries<VelocityField> VelocityField::keys() {
  using enum Geometry;
  const auto key = [](const char* name, std::string VelocityField::*member, std::vector<Geometry> only_in) {
    return Entry<VelocityField>{.name = name,
                                .member = member,
                                .optional = true,
                                .doc = "formula of the velocity along this coordinate; without it 0",
                                .example = example,
                                .only_in = std::move(only_in)};
  };
  return {key("x", &VelocityField::x, {line, planar, space}), key("y", &VelocityField::y, {planar, space}),
          key("r", &VelocityField::r, {axisymmetric}), key("z", &VelocityField::z, {axisymmetric, space})};
}

void VelocityField::check(const TableReading& reading) const {
  if (reading.node.children.empty())
    reading.in.out.error(reading.node.place, "'velocity-field' has no formula",
                         fmt::format("e.g. velocity-field = {{ {} = {} }}", reading.in.axes.back(), example));
  check_formula(reading, "x", x);
  check_formula(reading, "y", y);
  check_formula(reading, "r", r);
  check_formula(reading, "z", z);
}

std::vector<std::string> VelocityField::along(Geometry geometry) const {
  switch (geometry) {
    case Geometry::line:
      return {x};
    case Geometry::planar:
      return {x, y};
    case Geometry::axisymmetric:
      return {r, z};
    default:
      return {x, y, z};
  }
}

std::function<Vector(const Vector&)> evaluated(const VelocityField& field, Geometry geometry) {
  const auto formulas = std::make_shared<std::vector<std::optional<Formula>>>();
  for (const std::string& text : field.along(geometry)) {
    auto& formula = formulas->emplace_back();
    if (!text.empty()) formula.emplace(text, axes_of(geometry));
  }
  return [formulas](const Vector& x) {
    Vector u{};
    for (std::size_t d = 0; d < formulas->size(); ++d)
      if ((*formulas)[d]) u[d] = (*formulas)[d]->at(x);
    return u;
  };
}

double fastest_in(const VelocityField& field, Geometry geometry, const Vector& lo, const Vector& hi) {
  if (!field.is_given()) return 0;
  constexpr int samples = 32;  // along each axis, and both ends
  const auto velocity = evaluated(field, geometry);
  const std::size_t axes = static_cast<std::size_t>(dimension(geometry));
  std::array<int, 3> i{};
  double fastest = 0;
  for (std::size_t counted = 0; counted < axes;) {
    Vector x{};
    for (std::size_t d = 0; d < axes; ++d) x[d] = lo[d] + i[d] * (hi[d] - lo[d]) / samples;
    const Vector u = velocity(x);
    fastest = std::max(fastest, std::hypot(u[0], u[1], u[2]));
    for (counted = 0; counted < axes && ++i[counted] > samples; ++counted) i[counted] = 0;
  }
  return fastest;
}

}  // namespace recoil::config
