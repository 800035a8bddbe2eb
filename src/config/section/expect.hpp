#pragma once

#include <string>
#include <vector>

#include "config/declare/entry.hpp"
#include "config/document.hpp"

namespace recoil::config {

/// One acceptance check of [expect] or expected.toml.
struct Expectation {
  std::string quantity;                    // e.g. "gauge.rear.velocity@3.8us"
  bool is_flag = false, flag = false;      // a true/false expectation
  double value = 0;                        // SI
  double tolerance = 0;                    // SI, absolute
  bool at_most = false, at_least = false;  // one-sided checks: only `value` counts
  std::string unit;                        // as written, to print with
  std::string source, why;
  Place place;

  static constexpr const char* doc =
      "A result, in quotes, and its expected value: one of value, at-most, at-least; or just true or false.";
  static Entries<Expectation> keys();
  void check(const TableReading& reading);
};

/// Reads the checks of an [expect] table: "quantity" = { value = "0.695 us", within = "3 %" }, { at-most =
/// ... }, { at-least = ... }, or true / false.
std::vector<Expectation> read_expectations(const Node& table, Diagnostics& out);

/// The same of a whole file such as expected.toml: its [expect], or without one everything at its top.
std::vector<Expectation> read_expectations(const Document& document, Diagnostics& out);

/// The table [expect] again. @param file of the case: checks of another file name it.
WrittenTable write_expectations(const std::vector<Expectation>& all, const std::string& file);

}  // namespace recoil::config
