#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "config/diagnostics.hpp"
#include "config/document.hpp"
#include "config/keys.hpp"

namespace recoil::config {

/// Whose keys a table holds, for messages.
struct Owner {
  std::string what = {};                    // "a gauge of kind "point""; empty: nothing to be named
  std::vector<std::string> elsewhere = {};  // keys that exist, but mean nothing for it
};

/// One table read against a list of keys: checked values in SI. Keys that were not given, or were wrong (and
/// reported), have their default, and without one 0, false or nothing, so that reading can go on and find
/// more. All getters @throw InternalError for a name that is not in the list.
class Record {
 public:
  /// The key is in the table, accepted or not.
  bool has(std::string_view name) const;
  /// The key is in the table and its value was accepted.
  bool good(std::string_view name) const;

  double number(std::string_view name) const;  // quantity (SI), integer
  std::int64_t integer(std::string_view name) const;
  bool flag(std::string_view name) const;
  const std::string& text(std::string_view name) const;  // text, choice
  const std::vector<std::string>& texts(std::string_view name) const;
  std::array<double, 2> range(std::string_view name) const;
  std::array<double, 3> vector3(std::string_view name) const;  // components in the order of the axes
  /// The value as written in the file; null where not given.
  const Node* node(std::string_view name) const;

  /// Of the value; where the key was not given, of the table.
  Place place(std::string_view name) const;
  /// Of the key itself; where it was not given, of the table.
  Place key_place(std::string_view name) const;
  const Place& place() const { return place_; }

 private:
  friend Record read_record(const Node&, std::span<const Key>, Diagnostics&, std::span<const std::string>,
                            const Owner&);
  friend struct ValueReader;
  friend std::array<double, 3> read_vector(const Node&, const Key&, Diagnostics&,
                                           std::span<const std::string>);
  struct Value {
    const Node* node = nullptr;
    bool good = false;
    std::array<double, 3> numbers{};
    std::int64_t integer = 0;
    bool flag = false;
    std::string text;
    std::vector<std::string> texts;
  };
  const Value& value(std::string_view name) const;

  std::map<std::string, Value, std::less<>> values_;
  Place place_;
};

/// Reads a table. Unknown keys (with did-you-mean), wrong types, wrong dimensions, values out of range and
/// missing required keys are errors in `out`. The table and the keys must outlive the record.
/// @param axes names of the components of vectors, at most three; empty: x, y, z.
Record read_record(const Node& table, std::span<const Key> keys, Diagnostics& out,
                   std::span<const std::string> axes = {}, const Owner& owner = {});

/// Reports a required key that is not there, and how to give it.
void report_missing(const Node& table, const Key& key, const Owner& owner, Diagnostics& out);

/// Reads one quantity to SI; what is wrong with it is reported, and the result is then 0.
/// @param name what messages call it; @param example a value to suggest, may be empty.
double read_quantity(const Node& node, const std::string& name, const std::string& unit, Diagnostics& out,
                     const std::string& example = {});

/// Reads one vector { x = "450 m/s", ... } as a key of type vector asks; components left out or wrong are 0.
std::array<double, 3> read_vector(const Node& node, const Key& key, Diagnostics& out,
                                  std::span<const std::string> axes);

}  // namespace recoil::config
