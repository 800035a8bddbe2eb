#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "config/diagnostics.hpp"

namespace recoil::app {

/// A key of the case and the values that it takes in a sweep.
struct SweptKey {
  std::string key;                  // "body.flyer.velocity.x"
  std::vector<std::string> values;  // as written, or made from a range
  std::vector<double> numbers;  // the values in `unit`; empty where they are not all numbers of one dimension
  std::string unit;             // of the first value; empty: none
  bool is_range = false;        // FROM:TO or FROM:TO:N
};

/// Reads every "KEY=V1,V2,...", "KEY=FROM:TO:N" (N values, evenly spaced) and "KEY=FROM:TO" (its ends).
/// Commas and colons within quotes and brackets belong to a value. Mistakes go to `out`, with their places.
std::vector<SweptKey> read_swept_keys(const std::vector<std::string>& texts, config::Diagnostics& out);

/// A number of a range as text, "337.5 m/s": to ten digits.
std::string range_value(double number, const std::string& unit);
/// The number that range_value() writes.
double rounded_in_range(double number);

/// One value of every key: positions in SweptKey::values.
using Combination = std::vector<std::size_t>;
/// All of them; the last key runs fastest.
std::vector<Combination> combinations_of(const std::vector<SweptKey>& keys);

/// The changes of the case: PATH=VALUE for every key.
std::vector<std::string> changes_of(const std::vector<SweptKey>& keys, const Combination& at);

/// A name for the folder of a run, from all that is set: "body.flyer.velocity.x=300m_s".
/// @param changes PATH=VALUE.
std::string folder_name(const std::vector<std::string>& changes);

}  // namespace recoil::app
