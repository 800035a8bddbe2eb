#include "config/section/velocity_field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>

#include "config/declare/reading.hpp"
#include "config/formula/check.hpp"
#include "config/formula/formula.hpp"

namespace recoil::config {

namespace {

constexpr const char* example = "\"20*m/s * sin(pi*x/(60*mm))\"";

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
          key("r", &VelocityField::r, {axisymmetric, spherical}),
          key("z", &VelocityField::z, {axisymmetric, space})};
}

void VelocityField::check(const TableReading& reading) const {
  if (reading.node.children.empty())
    reading.in.out.error(reading.node.place, "'velocity-field' has no formula",
                         fmt::format("e.g. velocity-field = {{ {} = {} }}", reading.in.axes.back(), example));
  const auto check_along = [&](const char* axis, const std::string& text) {
    if (std::ranges::find(reading.in.axes, axis) != reading.in.axes.end())
      check_formula(reading, axis, text, {"velocity", {1, -1, 0}, example, "5*m/s"});
  };
  check_along("x", x);
  check_along("y", y);
  check_along("r", r);
  check_along("z", z);
}

std::vector<std::string> VelocityField::along(Geometry geometry) const {
  switch (geometry) {
    case Geometry::line:
      return {x};
    case Geometry::spherical:
      return {r};
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
