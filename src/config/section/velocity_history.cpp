#include "config/section/velocity_history.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>

#include "config/declare/reading.hpp"
#include "config/declare/write.hpp"
#include "config/section/body.hpp"

namespace recoil::config {

namespace {

void read_history(Body& body, const TableReading& reading, const Key& key) {
  const Node& list = *reading.record.node(key.name);
  const CaseReading& in = reading.in;
  if (!list.is_array() || list.children.size() < 2)
    return in.out.error(list.place, fmt::format("'{}' needs a list of at least two times", key.name),
                        "e.g. " + key.example);
  const Key velocity{.name = "velocity",
                     .type = Key::Type::vector,
                     .unit = "m/s",
                     .example = fmt::format("{{ {} = \"100 m/s\" }}", in.axes.front())};
  for (const Node& pair : list.children) {
    if (!pair.is_array() || pair.children.size() != 2) {
      in.out.error(pair.place, fmt::format("'{}' lists pairs of a time and a velocity", key.name),
                   "e.g. " + key.example);
      continue;
    }
    const TimedVelocity next{read_quantity(pair.children[0], "time", "s", in.out, "\"1 us\""),
                             read_vector(pair.children[1], velocity, in.out, in.axes)};
    if (!body.velocity_history.empty() && next.time <= body.velocity_history.back().time)
      in.out.error(pair.place, fmt::format("the times of '{}' do not grow", key.name),
                   "two velocities at one time: let the change take a nanosecond");
    body.velocity_history.push_back(next);
  }
}

std::string write_history(const Body& body, const char*, const Writing& how) {
  std::vector<std::string> pairs;
  for (const TimedVelocity& t : body.velocity_history)
    pairs.push_back(fmt::format("[{}, {}]", written_quantity(t.time, "s"), how.vector(t.velocity, "m/s")));
  return fmt::format("[{}]", fmt::join(pairs, ", "));
}

}  // namespace

Custom<Body> custom_velocity_history() { return {Key::Type::any, false, read_history, write_history}; }

}  // namespace recoil::config
