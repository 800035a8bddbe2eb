#pragma once

#include <string>
#include <vector>

#include "config/geometry.hpp"

namespace recoil::config {

/// Values as texts of TOML, in SI, to the last bit: they read back equal.
std::string written_text(const std::string& text);
std::string written_number(double value);
std::string written_quantity(double value, const std::string& unit);  // unit "1": a bare number
std::string written_range(double lo, double hi, const std::string& unit);
std::string written_list(const std::vector<std::string>& texts);

/// What the writers of a case share.
struct Writing {
  Geometry geometry;
  std::vector<std::string> axes;

  std::string vector(const Vector& v, const std::string& unit) const;
};

/// One key and its value.
struct WrittenKey {
  std::string name, value;
  std::string source = {};  // where the value comes from, where its place in the case does not tell
};

/// A table of the case with all its values, defaults as well.
struct WrittenTable {
  std::string path;  // "mesh", "body.flyer"; empty: the top of the file
  std::vector<WrittenKey> keys;
};

/// `{ kind = "box", x = [...] }`
std::string inline_table(const std::vector<WrittenKey>& keys);

}  // namespace recoil::config
