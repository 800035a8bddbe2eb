#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "app/sweep/swept_keys.hpp"
#include "app/sweep/threshold.hpp"

namespace recoil::app {

/// A column of quantities.
struct SweepColumn {
  std::string quantity, unit;  // "1": none
};

/// One run of a sweep.
struct SweepRow {
  std::vector<std::string> values;  // of the keys, in their order
  std::string run, verdict;         // its folder; "failed" of a run without results
  std::vector<double> numbers;      // in the order and unit of the columns; NaN: none
};

/// What a sweep has found: its runs in their order.
struct SweepTable {
  std::string title;
  std::vector<SweptKey> keys;
  std::vector<SweepColumn> columns;
  std::vector<SweepRow> rows;
};

/// One line for each run: the keys (with their unit where they are numbers), run, verdict, the quantities.
std::string sweep_csv(const SweepTable& table);
/// For people: the keys that vary, and the columns with these positions.
std::string sweep_markdown(const SweepTable& table, const std::vector<std::size_t>& shown);

/// Where a condition changes, for one choice of the other keys.
struct FoundThreshold {
  std::vector<std::string> values;  // of all keys; of the one that was searched along empty
  Threshold search;
  std::string problem;  // why the search ended early; empty: it did not
};

/// @param along the key that was searched along.
std::string threshold_csv(const std::vector<SweptKey>& keys, std::size_t along,
                          const std::vector<FoundThreshold>& found);
/// One sentence for each.
std::string threshold_text(const std::vector<SweptKey>& keys, std::size_t along, const std::string& condition,
                           const std::vector<FoundThreshold>& found);

}  // namespace recoil::app
