#pragma once

#include <limits>
#include <string>
#include <vector>

#include "config/geometry.hpp"

namespace recoil::config {

/// One key that a table may hold: drives reading, checking, `explain`, the JSON schema and the reference
/// page. Keys of a case follow from the declarations beside their structs (entry.hpp).
struct Key {
  enum class Type {
    quantity,  // "0.05 mm"; with an empty unit (or "1") a bare number
    integer,
    flag,
    text,
    choice,     // one of `choices`
    texts,      // ["a", "b"], each one of `choices` where there are any
    range,      // ["0 mm", "2 mm"], low < high
    vector,     // { x = "450 m/s", y = ... }, components left out are 0
    direction,  // { x = 1, y = ... }, or by { angle = "30 deg", elevation = ... } in planar and 3d
    turn,       // planar a quantity, about the axis out of the plane; 3d a vector
    table,      // anything: the caller reads it
    any,        // anything, a table or not: the caller reads it
  };
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  std::string name;
  Type type = Type::text;
  std::string unit = {};       // SI: quantity, range, vector
  double minimum = -infinity;  // SI, allowed itself
  double maximum = infinity;   // SI, allowed itself
  bool positive = false;       // zero is refused as well
  bool required = false;
  std::string default_text = {};  // as one would write it; empty: none
  std::string doc = {};
  std::vector<std::string> choices = {};
  std::vector<std::string> not_yet = {};  // values of a later version
  std::string example = {};               // a value as one would write it
  std::vector<Geometry> only_in = {};     // empty: in every geometry
};

/// A column of the file that a gauge writes. A unit such as "force" stands for the unit of sums of this
/// geometry (RunUnits).
struct Column {
  /// axis: one column for each coordinate, NAME.x, ...; turn: for each axis about which bodies turn, in the
  /// plane NAME alone.
  enum class Each { once, axis, stress, turn };
  const char* name;
  const char* unit;
  const char* doc;
  Each each = Each::once;
};

/// A table of the case file. A `*` stands for a name that the user chooses.
struct Section {
  std::string name;  // "mesh", "body.*", "body.*.shape"; empty: the top of the file
  std::string doc;
  std::vector<Key> keys;
  std::string kind = {};  // the keys belong to this `kind` of the table
  std::vector<Column> columns = {};
};

/// Every table of a case file, in the order in which one writes them.
const std::vector<Section>& case_sections();

}  // namespace recoil::config
