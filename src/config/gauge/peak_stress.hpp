#pragma once

#include <string>
#include <vector>

#include "config/declare/common_keys.hpp"
#include "config/declare/reading.hpp"

namespace recoil::config {

struct PeakStressGauge {
  std::string body;
  Vector at{}, to{};   // m: ends of the line
  int stations = 100;  // on that line

  static constexpr const char* kind = "peak-stress";
  static constexpr const char* doc =
      "The largest compressive stress that material points on a line have met, over the distance from its "
      "start. The file is rewritten at each flush.";
  static Entries<PeakStressGauge> keys() {
    return {body_key("body", &PeakStressGauge::body, watched_body),
            place_key("at", &PeakStressGauge::at, "start of the line"),
            place_key("to", &PeakStressGauge::to, "end of the line"),
            {.name = "stations",
             .member = &PeakStressGauge::stations,
             .least = 1,
             .most = 10000,
             .doc = "number of material points on the line",
             .example = "100"}};
  }
  void check(const TableReading& reading) const {
    if (reading.good("to") && to == at)
      reading.wrong("to", "the line from 'at' to 'to' has no length", "move its end");
  }
  static std::vector<Column> columns() {
    return {{"stress", "GPa", "largest compressive, along the line"}, {"time", "us", "of it"}};
  }
};

}  // namespace recoil::config
