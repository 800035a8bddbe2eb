#include "config/section/load.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <regex>

#include "config/declare/common_keys.hpp"
#include "config/declare/read_struct.hpp"
#include "config/declare/reading.hpp"
#include "config/declare/write.hpp"
#include "config/formula/check.hpp"
#include "config/section/timed_list.hpp"

namespace recoil::config {

namespace {

constexpr const char* pressure_example = "\"2*GPa * exp(-t/(0.5*us))\"";
constexpr const char* part_example = "\"x < 3*mm\"";

/// A formula; a plain quantity such as "2 GPa" becomes one.
void read_pressure(Load& load, const TableReading& reading, const Key& key) {
  static const std::regex quantity(R"(^\s*([-+]?[0-9.]+(?:[eE][-+]?[0-9]+)?)\s+(GPa|MPa|kPa|Pa)\s*$)");
  load.pressure = std::regex_replace(reading.record.text(key.name), quantity, "$1*$2");
}

std::string write_pressure(const Load& load, const char*, const Writing&) {
  return written_text(load.pressure);
}

void read_history(Load& load, const TableReading& reading, const Key& key) {
  read_timed(load.history, reading, key, "a pressure", [&](double time, const Node& value) {
    return TimedPressure{time, read_quantity(value, "pressure", "Pa", reading.in.out, "\"1 GPa\"")};
  });
}

std::string write_history(const Load& load, const char*, const Writing&) {
  std::vector<std::string> pairs;
  for (const TimedPressure& t : load.history)
    pairs.push_back(
        fmt::format("[{}, {}]", written_quantity(t.time, "s"), written_quantity(t.pressure, "Pa")));
  return fmt::format("[{}]", fmt::join(pairs, ", "));
}

}  // namespace

Entries<Load> Load::keys() {
  return {
      body_key("body", &Load::body, "the deformable body whose surface is loaded"),
      {.name = "pressure",
       .member = Custom<Load>{Key::Type::text, true, read_pressure, write_pressure},
       .optional = true,
       .doc = "formula of the pressure, of the coordinates and the time t, with the units of a "
              "velocity-field and GPa, MPa, kPa, Pa; where it is below 0 it pulls",
       .example = pressure_example},
      {.name = "history",
       .member = Custom<Load>{Key::Type::any, false, read_history, write_history},
       .unit = "Pa",
       .optional = true,
       .doc = "pairs of a time and a pressure; straight lines between them, constant before the first and "
              "after the last",
       .example = R"([["0 us", "0 GPa"], ["0.1 us", "2 GPa"]])"},
      {.name = "part",
       .member = &Load::part,
       .optional = true,
       .doc = "formula of a factor, of the coordinates and t: what part of the pressure acts at a place; a "
              "comparison is 1 where it holds, else 0",
       .example = part_example},
      {.name = "facing",
       .member = &Load::facing,
       .optional = true,
       .rule = Rule::direction,
       .doc = "it acts where the outward normal of the surface is within 45 degrees of this direction; "
              "without it everywhere",
       .example = R"({ x = -1 })"}};
}

void Load::check(const TableReading& reading) const {
  if (reading.has("pressure") == reading.has("history")) {
    if (reading.has("history"))
      reading.refuse("history", "'history' and 'pressure' do not go together",
                     "either a formula of t or a table of times; 'part' is a factor of both");
    else
      reading.in.out.error(reading.node.key_place,
                           fmt::format("[{}] has neither 'pressure' nor 'history'", reading.node.path),
                           fmt::format("e.g. pressure = {}", pressure_example));
  }
  using enum Formula::Of;
  check_formula(reading, "pressure", pressure,
                {"pressure", {0, 0, 1}, pressure_example, "2*GPa", place_and_time});
  check_formula(
      reading, "part", part,
      {"pure number", {}, fmt::format("\"{} < 3*mm\"", reading.in.axes.front()), "1", place_and_time});
  if (std::ranges::find(reading.in.rigid_bodies, body) != reading.in.rigid_bodies.end())
    reading.wrong("body", fmt::format("'{}' is rigid: loads act on bodies with a material", body),
                  "a rigid body is driven by its 'velocity-history'");
}

void read_loads(const Node& table, std::vector<Load>& loads, CaseReading& in) {
  for (const Node& node : table.children) {
    if (!check_is_table(node, "load", in.out) || !check_name(node, "load", in.out)) continue;
    Load& load = loads.emplace_back();
    load.name = node.key;
    load.place = node.key_place;
    read_struct(node, load, in);
  }
}

}  // namespace recoil::config
