#include "config/section/velocity_field.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>

#include "config/declare/reading.hpp"
#include "config/section/formula.hpp"
#include "core/error.hpp"

namespace recoil::config {

namespace {

constexpr const char* example = "\"20*m/s * sin(pi*x/(60*mm))\"";

/// Places within the domain that lie on no plane of symmetry of it.
std::vector<Vector> places_in(const Vector& lo, const Vector& hi) {
  std::vector<Vector> places;
  for (const Vector& part :
       {Vector{0.137, 0.211, 0.843}, Vector{0.618, 0.419, 0.271}, Vector{0.893, 0.769, 0.557}}) {
    Vector& x = places.emplace_back();
    for (std::size_t d = 0; d < x.size(); ++d) x[d] = lo[d] + part[d] * (hi[d] - lo[d]);
  }
  return places;
}

void check_formula(const TableReading& reading, const char* key, const std::string& text) {
  const std::vector<std::string>& axes = reading.in.axes;
  if (!reading.has(key) || !reading.good(key) || std::ranges::find(axes, key) == axes.end()) return;
  try {
    const Formula formula(text, reading.in.axes);
    if (reading.in.knows_domain && !formula.is_velocity(places_in(reading.in.lo, reading.in.hi)))
      reading.wrong(
          key,
          fmt::format("the formula of '{}' is no velocity: numbers need units, and coordinates are lengths",
                      key),
          fmt::format("e.g. {} = {}", key, example));
  } catch (const InputError& e) {
    reading.wrong(key, fmt::format("the formula of '{}' {}", key, e.what()),
                  fmt::format("coordinates are {}, units km, m, cm, mm, um, s, ms, us, ns; e.g. {} = {}",
                              fmt::join(axes, ", "), key, example));
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
