#include "config/declare/read_struct.hpp"

#include <fmt/ranges.h>

namespace recoil::config {

void adapt(Key& key, Rule rule, const char* unit, const CaseReading& in) {
  if (unit) key.unit = unit;
  if (rule == Rule::body && !in.bodies.empty()) key.example = written_text(in.bodies.back());
  if (const std::size_t x = key.example.find("{ x ="); x != std::string::npos)
    key.example.replace(x + 2, 1, in.axes.front());
  if (exists_in(key.only_in, in.geometry)) return;
  key.required = false;  // check_geometry() reports it where it is given
  key.type = Key::Type::any;
}

bool check_coordinate(const TableReading& reading, const std::string& name, std::size_t& d) {
  const auto& [node, record, in, keys, owner] = reading;
  const auto axis = std::find(in.axes.begin(), in.axes.end(), name);
  d = static_cast<std::size_t>(axis - in.axes.begin());
  if (axis == in.axes.end()) {
    if (record.has(name))
      reading.refuse(name,
                     fmt::format("'{}' in [{}] is not a coordinate of a case with geometry \"{}\"", name,
                                 node.path, name_of(in.geometry)),
                     fmt::format("its coordinates are {}", fmt::join(in.axes, ", ")));
    return false;
  }
  if (!record.has(name))
    in.out.error(record.place(), fmt::format("'{}' is missing in [{}]", name, node.path),
                 fmt::format("give [low, high], e.g. {} = [\"0 mm\", \"10 mm\"]", name));
  return true;
}

bool check_geometry(const TableReading& reading, const Key& key) {
  if (exists_in(key.only_in, reading.in.geometry)) return true;
  if (reading.has(key.name))
    reading.refuse(
        key.name,
        fmt::format("'{}' does not apply to geometry \"{}\"", key.name, name_of(reading.in.geometry)),
        "it exists in: " + names_of(key.only_in));
  return false;
}

namespace {

void check_inside(const TableReading& reading, const std::string& name, const Vector& at) {
  const CaseReading& in = reading.in;
  for (std::size_t d = 0; d < in.axes.size(); ++d) {
    if (in.lo[d] >= in.hi[d]) continue;  // reported already
    if (at[d] >= in.lo[d] && at[d] <= in.hi[d]) continue;
    reading.wrong(
        name,
        fmt::format("'{}' of '{}' lies outside the domain: {} = {:.6g} mm, the domain reaches from "
                    "{:.6g} to {:.6g} mm",
                    name, reading.node.key, in.axes[d], 1e3 * at[d], 1e3 * in.lo[d], 1e3 * in.hi[d]),
        "move it, or make the domain larger");
  }
}

}  // namespace

Vector checked(const TableReading& reading, const std::string& name, Rule rule, const Vector& v) {
  if (rule == Rule::inside_domain) check_inside(reading, name, v);
  if (rule != Rule::direction) return v;
  if (v == Vector{}) {
    std::string example;
    for (const Key& key : reading.keys)
      if (key.name == name) example = key.example;
    reading.refuse(name, fmt::format("'{}' has no direction: all its components are 0", name),
                   fmt::format("e.g. {} = {}", name, example));
  }
  return normalised(v);
}

}  // namespace recoil::config
