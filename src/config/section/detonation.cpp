#include "config/section/detonation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>

#include "config/declare/reading.hpp"
#include "config/declare/write.hpp"

namespace recoil::config {

namespace {

void read_points(Detonation& detonation, const TableReading& reading, const Key& key) {
  const Node& list = *reading.record.node(key.name);
  const CaseReading& in = reading.in;
  if (!list.is_array() || list.children.empty())
    return in.out.error(list.place, fmt::format("'{}' needs a list of positions", key.name),
                        "e.g. " + key.example);
  const Key point{.name = "point", .type = Key::Type::vector, .unit = "m", .example = key.example};
  for (const Node& node : list.children)
    detonation.points.push_back(read_vector(node, point, in.out, in.axes));
}

std::string write_points(const Detonation& detonation, const char*, const Writing& how) {
  std::vector<std::string> points;
  for (const Vector& p : detonation.points) points.push_back(how.vector(p, "m"));
  return fmt::format("[{}]", fmt::join(points, ", "));
}

}  // namespace

Entries<Detonation> Detonation::keys() {
  return {{.name = "points",
           .member = Custom<Detonation>{Key::Type::any, false, read_points, write_points},
           .unit = "m",
           .required = true,
           .doc = "where it is lit; a front runs from each in all directions",
           .example = R"([{ x = "0 mm" }])"},
          {.name = "direction",
           .member = &Detonation::direction,
           .optional = true,
           .rule = Rule::direction,
           .doc = "normal of a plane front through the first point, which runs both ways from there",
           .example = R"({ x = 1 })"},
          {.name = "time",
           .member = &Detonation::time,
           .unit = "s",
           .doc = "when it is lit",
           .example = R"("1 us")"}};
}

}  // namespace recoil::config
