#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "config/declare/common_keys.hpp"
#include "config/declare/reading.hpp"

namespace recoil::config {

struct ContactGauge {
  std::array<std::string, 2> pair;
  Vector at{};         // m: only what lies so near to it as `radius` counts
  double radius = 0;   // m; 0: all of it
  Vector direction{};  // unit vector along which force and impulse are also given; zero: none
  double every = 0;    // s; 0: every step

  static constexpr const char* kind = "contact";
  static constexpr const char* doc =
      "The contact of two bodies. With a radius, force and work are integrated over time from the last stage "
      "of each step, which represents its middle; without, impulse and work are what was exchanged, to the "
      "last bit. All other values are of the middle of the step that ends at the time of the record.";
  static Entries<ContactGauge> keys() {
    Entry<ContactGauge> at = place_key("at", &ContactGauge::at,
                                       "the centre of the part that counts; without it the whole contact");
    at.required = false;
    at.when = [](const ContactGauge& g) { return g.radius > 0; };
    return {{.name = "pair",
             .member = &ContactGauge::pair,
             .required = true,
             .doc = "the two bodies",
             .example = R"("flyer-target")"},
            at,
            {.name = "radius",
             .member = &ContactGauge::radius,
             .unit = "m",
             .positive = true,
             .optional = true,
             .doc = "only the contact within this distance of `at` counts, so that its rim can be left out",
             .example = R"("2 mm")"},
            {.name = "direction",
             .member = &ContactGauge::direction,
             .optional = true,
             .rule = Rule::direction,
             .doc = "force and impulse are also given along this direction",
             .example = "{ x = 1, y = 1 }",
             .only_in = {Geometry::planar, Geometry::axisymmetric, Geometry::space}},
            every_key(&ContactGauge::every, every_record)};
  }
  /// A part of the contact needs its middle and its radius.
  void check(const TableReading& reading) const {
    if (reading.has("at") != reading.has("radius")) reading.missing(reading.has("at") ? "radius" : "at");
  }
  /// How many of the last columns are not written.
  std::size_t switched_off() const { return direction == Vector{} ? 2 : 0; }
  /// The last two only with a direction.
  static std::vector<Column> columns() {
    using enum Column::Each;
    return {{"traction", "GPa", "mean over the area in contact, positive in tension; 0 when apart"},
            {"velocity", "m/s", "that of the work, along the normal out of the first body"},
            {"area", "area", "in contact"},
            {"gap", "mm", "mean over the area in contact"},
            {"widest-gap", "mm", "largest"},
            {"deepest-overlap", "mm", "largest, negative"},
            {"widest-gap-in-cells", "1", "the same over the edge of the finest cell"},
            {"deepest-overlap-in-cells", "1", "the same over the edge of the finest cell"},
            {"force", "force", "on the first named body", axis},
            {"impulse", "momentum", "on the first named body", axis},
            {"work", "energy", "done on the first named body"},
            {"normal-force", "force", "its size, normal to the surface cell by cell"},
            {"tangential-force", "force", "its size, along the surface cell by cell"},
            {"normal-impulse", "momentum", "the normal force over time"},
            {"tangential-impulse", "momentum", "the tangential force over time"},
            {"friction", "1", "tangential over normal impulse"},
            {"traction-scatter", "GPa", "root mean square over the area of its departure from the mean"},
            {"force.along", "force", "along `direction`"},
            {"impulse.along", "momentum", "along `direction`"}};
  }
};

}  // namespace recoil::config
