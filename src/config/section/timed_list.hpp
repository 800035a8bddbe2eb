#pragma once

#include <fmt/format.h>

#include <vector>

#include "config/declare/reading.hpp"

namespace recoil::config {

/// Reads [[time, value], ...], at least two of them, with growing times; what is wrong is reported.
/// @param noun of the value, with its article: "a velocity". @param item makes what is kept of a time [s] and
/// the node of its value.
template <class Item, class Make>
void read_timed(std::vector<Item>& items, const TableReading& reading, const Key& key, const char* noun,
                Make&& item) {
  const Node& list = *reading.record.node(key.name);
  Diagnostics& out = reading.in.out;
  if (!list.is_array() || list.children.size() < 2)
    return out.error(list.place, fmt::format("'{}' needs a list of at least two times", key.name),
                     "e.g. " + key.example);
  for (const Node& pair : list.children) {
    if (!pair.is_array() || pair.children.size() != 2) {
      out.error(pair.place, fmt::format("'{}' lists pairs of a time and {}", key.name, noun),
                "e.g. " + key.example);
      continue;
    }
    const Item next = item(read_quantity(pair.children[0], "time", "s", out, "\"1 us\""), pair.children[1]);
    if (!items.empty() && next.time <= items.back().time)
      out.error(pair.place, fmt::format("the times of '{}' do not grow", key.name),
                "two values at one time: let the change take a nanosecond");
    items.push_back(next);
  }
}

}  // namespace recoil::config
