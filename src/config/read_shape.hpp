#pragma once

#include <string>
#include <vector>

#include "config/case.hpp"
#include "config/diagnostics.hpp"
#include "config/document.hpp"
#include "config/table.hpp"

namespace recoil::config {

/// What the readers of a case share.
struct CaseReading {
  Geometry geometry;
  std::vector<std::string> axes;  // names of the coordinates, in the order of vectors
  Diagnostics& out;
};

/// Names of the coordinates: {"r", "z"} for axisymmetric.
std::vector<std::string> axes_of(Geometry geometry);
/// A vector of length 1 in the direction of v, or v where it has none. What is one already, as a resolved
/// case has it, stays as it is, so that it reads back equal.
Vector normalised(Vector v);

/// "planar", ... as in a case file.
std::string name_of(Geometry geometry);

/// Takes the extents along all axes of the geometry from the keys named after them. Missing ones and those of
/// other geometries are errors. @return false after an error.
bool read_extents(const Record& record, const std::string& where, const CaseReading& reading, Vector& lo,
                  Vector& hi);

/// Reads a shape from its table { kind = ..., ... }.
Shape read_shape(const Node& node, const CaseReading& reading);

}  // namespace recoil::config
