#pragma once

#include <string>
#include <vector>

#include "config/declare/common_keys.hpp"
#include "config/declare/reading.hpp"

namespace recoil::config {

struct BarGauge {
  std::string body;
  std::string wall;  // what its foot stands on
  double every = 0;  // s; 0: every step

  static constexpr const char* kind = "bar";
  static constexpr const char* doc = "The shape of a bar whose foot stands on another body; its axis is z.";
  static std::vector<Geometry> only_in() { return {Geometry::axisymmetric, Geometry::space}; }
  static Entries<BarGauge> keys() {
    return {body_key("body", &BarGauge::body, watched_body),
            body_key("wall", &BarGauge::wall, "the body that the foot of a bar stands on"),
            every_key(&BarGauge::every, every_record)};
  }
  void check(const TableReading& reading) const {
    if (reading.good("wall") && wall == body)
      reading.wrong("wall", "'" + body + "' cannot stand on itself", "name the other body of the impact");
  }
  static std::vector<Column> columns() {
    return {{"length", "mm", "from the end of the foot to the other end of the axis"},
            {"foot-radius", "mm", "largest within half the first radius of the end of the foot"},
            {"radius", "mm", "largest anywhere"},
            {"volume-radius", "mm", "largest that the matter of one row of cells would fill; NaN in 3d"},
            {"contact-radius", "mm", "up to which the gap to the wall is below 0.1 dx; 0: nowhere"},
            {"lift-off", "mm", "gap to the wall at 95 % of the foot's radius, at most 8 dx"},
            {"plastic-strain", "1", "largest"},
            {"axis-plastic-strain", "1", "largest within dx of the axis"},
            {"rim-lift-off", "mm", "gap under the outermost cells of the foot"}};
  }
};

}  // namespace recoil::config
