#pragma once

#include <string>
#include <vector>

#include "config/case.hpp"
#include "config/diagnostics.hpp"
#include "config/document.hpp"

namespace recoil::config {

/// The newest case format that this program reads.
constexpr int case_format = 1;

/// Reads and checks a case file. Everything that is wrong with it goes to `out` in one pass; the case is only
/// fit for use where there were no errors. Checks that need materials or geometry are left to others.
/// @param document receives the parsed file, with the overrides applied: [material.NAME] tables are read from
/// it.
/// @param overrides PATH=VALUE, e.g. "mesh.finest=0.1mm".
Case read_case(const std::string& path, Document& document, Diagnostics& out,
               const std::vector<std::string>& overrides = {});

/// The same from a document that has been parsed already.
Case read_case(const Document& document, Diagnostics& out);

/// Checks that what the expectations speak of exists: gauge.NAME..., body.NAME..., contact.A-B...
void check_expected_names(const std::vector<Expectation>& expect, const std::vector<Body>& bodies,
                          const std::vector<Gauge>& gauges, Diagnostics& out);

}  // namespace recoil::config
