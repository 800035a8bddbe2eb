#pragma once

#include <string>
#include <vector>

#include "config/declare/entry.hpp"
#include "config/diagnostics.hpp"

namespace recoil::config {

/// A pressure at one time.
struct TimedPressure {
  double time = 0;      // s
  double pressure = 0;  // Pa
};

/// A pressure from outside on the free surface of a body: by a formula of place and time, or over time.
struct Load {
  std::string name, body;
  std::string pressure;                // formula [Pa] of coordinates and t; empty: history
  std::vector<TimedPressure> history;  // none: pressure
  std::string part;                    // formula of coordinates and t, a factor; empty: 1
  Vector facing{};                     // 0: all of the surface
  Place place;

  static constexpr const char* doc =
      "A pressure from outside on the free surface of a body, which pushes it and does work on it: that of a "
      "blast, a laser, a driver. Either 'pressure' or 'history'.";
  static Entries<Load> keys();
  void check(const TableReading& reading) const;
};

/// Reads [load.NAME].
void read_loads(const Node& table, std::vector<Load>& loads, CaseReading& in);

}  // namespace recoil::config
