#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/case.hpp"
#include "config/read_shape.hpp"

namespace recoil::config {

/// Reads every [body.NAME] below the `body` table.
std::vector<Body> read_bodies(const Node& table, const CaseReading& reading);

/// Reads every [gauge.NAME] below the `gauge` table; their bodies must be among `bodies`.
std::vector<Gauge> read_gauges(const Node& table, const std::vector<Body>& bodies, const Domain& domain,
                               const CaseReading& reading);

/// All ways to read "a-b" as two of the names; names may hold '-' themselves, so there may be several.
std::vector<std::array<std::string, 2>> pairs_named(std::string_view pair,
                                                    const std::vector<std::string>& names);

/// The two bodies of a pair "a-b"; unknown and ambiguous ones are reported, and come back empty.
std::array<std::string, 2> read_pair(const std::string& pair, const Place& place,
                                     const std::vector<std::string>& names, Diagnostics& out);

/// Checks that what the expectations speak of exists: gauge.NAME..., body.NAME..., contact.A-B...
void check_expected_names(const std::vector<Expectation>& expect, const std::vector<Body>& bodies,
                          const std::vector<Gauge>& gauges, Diagnostics& out);

}  // namespace recoil::config
