#pragma once

#include <string>
#include <vector>

#include "config/declare/common_keys.hpp"
#include "config/declare/reading.hpp"

namespace recoil::config {

struct CraterGauge {
  std::string body;
  Vector at{};         // m, on the original surface
  Vector direction{};  // unit vector along an axis, out of that surface
  double radius = 0;   // m, around `at`, of what is looked at
  double every = 0;    // s; 0: every step

  static constexpr const char* kind = "crater";
  static constexpr const char* doc =
      "The crater, or the hole, in a body below its original plane surface. It is measured along the lines "
      "of "
      "cells through that plane: how deep the first matter of the body's heaviest piece lies. Ejecta, what "
      "lines the crater and matter above the plane do not count; what is under an overhang is not seen.";
  static constexpr bool on_surface = true;  // where `at` must lie at the start
  static std::vector<Geometry> only_in() {
    return {Geometry::planar, Geometry::axisymmetric, Geometry::space};
  }
  static Entries<CraterGauge> keys() {
    return {body_key("body", &CraterGauge::body, watched_body),
            place_key("at", &CraterGauge::at, "the middle of the crater, on the original surface"),
            {.name = "direction",
             .member = &CraterGauge::direction,
             .required = true,
             .rule = Rule::direction,
             .doc = "out of that surface, along an axis",
             .example = "{ z = 1 }"},
            {.name = "radius",
             .member = &CraterGauge::radius,
             .unit = "m",
             .positive = true,
             .required = true,
             .doc = "the lines of cells so near to `at` are looked at; no more than the body is wide",
             .example = R"("10 mm")"},
            every_key(&CraterGauge::every, every_record)};
  }
  void check(const TableReading& reading) const {
    int axes = 0;
    for (const double part : direction) axes += part != 0 ? 1 : 0;
    if (reading.good("direction") && axes > 1)
      reading.wrong("direction", "the surface of a crater must be normal to an axis", "give one component");
    const bool round = reading.in.geometry == Geometry::axisymmetric;
    if (round && reading.good("direction") && direction[0] != 0)
      reading.wrong("direction", "the surface of a crater must be normal to z", "give z = 1 or z = -1");
    if (round && reading.good("at") && at[0] != 0)
      reading.wrong("at", "a crater lies on the axis", "leave r out");
  }
  static std::vector<Column> columns() {
    return {
        {"depth", "mm", "largest"},
        {"diameter", "mm",
         "of the circle with the area of what is deeper than half a cell or a hole, with its images beyond "
         "planes of symmetry; planar: its width"},
        {"volume", "volume",
         "below the original plane, without what is a hole; of what the domain holds, without images"},
        {"hole-diameter", "mm", "the same of the lines that meet no matter of the piece; 0: no hole"}};
  }
};

}  // namespace recoil::config
