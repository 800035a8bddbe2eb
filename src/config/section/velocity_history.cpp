#include "config/section/velocity_history.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>

#include "config/declare/reading.hpp"
#include "config/declare/write.hpp"
#include "config/section/body.hpp"
#include "config/section/timed_list.hpp"

namespace recoil::config {

namespace {

void read_history(Body& body, const TableReading& reading, const Key& key) {
  const CaseReading& in = reading.in;
  const Key velocity{.name = "velocity",
                     .type = Key::Type::vector,
                     .unit = "m/s",
                     .example = fmt::format("{{ {} = \"100 m/s\" }}", in.axes.front())};
  read_timed(body.velocity_history, reading, key, "a velocity", [&](double time, const Node& value) {
    return TimedVelocity{time, read_vector(value, velocity, in.out, in.axes)};
  });
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
