#include "app/plot/plane_option.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstddef>
#include <system_error>

#include "app/plot/plot_file.hpp"
#include "core/error.hpp"

namespace recoil::app {

namespace {

/// One term of the sum: "+0.5z". @returns whether it is one.
bool add_term(const std::string& text, std::size_t& at, Vec<3>& sum) {
  double sign = 1, factor = 1;
  if (text[at] == '+' || text[at] == '-') sign = text[at++] == '-' ? -1 : 1;
  const char* begin = text.data() + at;
  const auto read = std::from_chars(begin, text.data() + text.size(), factor);
  if (read.ec == std::errc()) at += static_cast<std::size_t>(read.ptr - begin);
  if (at < text.size() && text[at] == '*') ++at;
  const std::size_t axis = at < text.size() ? std::string("xyz").find(text[at]) : std::string::npos;
  if (axis == std::string::npos) return false;
  ++at;
  sum[static_cast<int>(axis)] += sign * factor;
  return true;
}

}  // namespace

SpacePlane read_plane(const std::string& text, const char* option) {
  const std::size_t equals = text.find('=');
  const std::string sum = text.substr(0, equals);
  SpacePlane plane{{}, 0};
  bool good = equals != std::string::npos && !sum.empty();
  for (std::size_t at = 0; good && at < sum.size();) good = add_term(sum, at, plane.normal);
  const double size = norm(plane.normal);
  if (!good || !(size > 0))
    throw InputError(
        fmt::format("a plane is given as z=PLACE, not '{}'\n   = help: {} z=0mm; an oblique one: {} x+y=0mm",
                    text, option, option));
  plane.distance = quantity_option(text.substr(equals + 1), "m", option) / size;
  plane.normal *= 1 / size;
  return plane;
}

int axis_across(const SpacePlane& plane) {
  const int axis = main_axis(plane.normal);
  return std::abs(plane.normal[axis]) > 1 - 1e-12 ? axis : -1;
}

}  // namespace recoil::app
