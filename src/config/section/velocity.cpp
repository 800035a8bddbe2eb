#include "config/section/velocity.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <vector>

#include "config/declare/kinds.hpp"
#include "config/section/body.hpp"

namespace recoil::config {

namespace {

/// The other form of a velocity.
struct PolarVelocity {
  double speed = 0;                 // m/s
  double angle = 0, elevation = 0;  // rad

  static constexpr const char* doc = "A velocity given by its size and direction (planar, 3d).";
  static Entries<PolarVelocity> keys() {
    return {{.name = "speed",
             .member = &PolarVelocity::speed,
             .unit = "m/s",
             .least = 0,
             .required = true,
             .doc = "size of the velocity",
             .example = R"("1 km/s")"},
            {.name = "angle",
             .member = &PolarVelocity::angle,
             .unit = "rad",
             .doc = "from the x axis towards y",
             .example = R"("-10 deg")"},
            {.name = "elevation",
             .member = &PolarVelocity::elevation,
             .unit = "rad",
             .doc = "from the plane of x and y towards z",
             .example = R"("30 deg")",
             .only_in = {Geometry::space}}};
  }
};

void read_velocity(Body& body, const TableReading& reading, const Key& key) {
  const CaseReading& in = reading.in;
  const Node& node = *reading.record.node(key.name);
  if (!node.find("speed") && !node.find("angle") && !node.find("elevation")) {
    body.velocity = read_vector(node, key, in.out, in.axes);
    return;
  }
  if (in.geometry != Geometry::planar && in.geometry != Geometry::space)
    return in.out.error(
        node.place,
        fmt::format("a velocity by speed and angle exists in geometries \"planar\" and \"3d\", not in \"{}\"",
                    name_of(in.geometry)),
        fmt::format("give its components {}", fmt::join(in.axes, ", ")));
  PolarVelocity polar;
  read_struct(node, polar, in);
  body.velocity = pointing(polar.angle, polar.elevation);
  for (double& component : body.velocity) component *= polar.speed;
}

}  // namespace

Custom<Body> custom_velocity() {
  return {Key::Type::vector, false, read_velocity,
          [](const Body& body, const char*, const Writing& how) { return how.vector(body.velocity, "m/s"); },
          [](const std::string& path, std::vector<Section>& all) {
            add_sections<PolarVelocity>(path, all);
            all.back().kind = "polar";
          }};
}

}  // namespace recoil::config
