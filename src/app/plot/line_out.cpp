#include "app/plot/line_out.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "app/plot/plot_file.hpp"
#include "core/error.hpp"
#include "core/nothing.hpp"

namespace recoil::app {

namespace {

/// The value at (u, v), in cells from the lower left corner: linear between the four nearest centres of
/// cells, of which those without matter do not count. NaN in a cell without matter.
double value_at(const PlaneArray& a, double u, double v) {
  if (!(u >= 0 && u < a.nx && v >= 0 && v < a.ny)) return nothing;
  if (std::isnan(a.at(static_cast<int>(u), static_cast<int>(v)))) return nothing;
  const int i = static_cast<int>(std::floor(u - 0.5)), j = static_cast<int>(std::floor(v - 0.5));
  const double s = u - 0.5 - i, t = v - 0.5 - j;
  double sum = 0, weight = 0;
  for (const int q : {0, 1})
    for (const int p : {0, 1}) {
      const double near = a.at(std::clamp(i + p, 0, a.nx - 1), std::clamp(j + q, 0, a.ny - 1));
      const double w = std::abs(1 - p - s) * std::abs(1 - q - t);
      if (std::isnan(near)) continue;
      sum += w * near, weight += w;
    }
  return sum / weight;
}

using Place = std::vector<double>;  // two coordinates or three [m]

Place read_place(const std::string& text, const std::string& line, std::size_t count) {
  Place place;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    const std::string part = text.substr(at, end - at);
    if (part.empty()) break;
    place.push_back(quantity_option(part, "m", "--along"));
    at = end + 1;
  }
  if (place.size() != count)
    throw InputError(fmt::format("'{}' is not a line\n   = help: --along {}", line,
                                 count == 3 ? "0mm,0mm,1mm:9mm,0mm,1mm" : "0mm,1mm:9mm,1mm"));
  return place;
}

std::pair<Place, Place> read_line(const std::string& text, std::size_t count) {
  const std::size_t colon = std::min(text.find(':'), text.size());
  std::pair<Place, Place> line{read_place(text.substr(0, colon), text, count),
                               read_place(colon < text.size() ? text.substr(colon + 1) : "", text, count)};
  if (line.first == line.second)
    throw InputError(fmt::format("'{}' is a point\n   = help: --along needs two places", text));
  return line;
}

std::string in_mm(const Place& place) {
  std::string text;
  for (const double x : place)
    text += fmt::format("{}{}{:.4g}", text.empty() ? "" : ", ", x < 0 ? "\u2212" : "", 1e3 * std::abs(x));
  return "(" + text + ")";
}

/// @param value at a place, NaN where there is no matter.
template <class F>
LineChart line_out(const std::string& text, std::size_t count, double cell, F&& value) {
  const auto [from, to] = read_line(text, count);
  double length = 0;
  for (std::size_t d = 0; d < count; ++d) length = std::hypot(length, to[d] - from[d]);
  const int n = static_cast<int>(std::clamp(2 * length / cell, 2.0, 2e4));
  Series s;
  for (int k = 0; k <= n; ++k) {
    const double t = 1.0 * k / n;
    Place x = from;
    for (std::size_t d = 0; d < count; ++d) x[d] += t * (to[d] - from[d]);
    s.x.push_back(1e3 * t * length);
    s.y.push_back(value(x));
  }
  if (std::ranges::all_of(s.y, [](double v) { return std::isnan(v); }))
    throw InputError(fmt::format("there is no matter along {}\n   = help: choose another --along", text));
  LineChart chart;
  chart.note = fmt::format("{} to {} mm", in_mm(from), in_mm(to));
  chart.x_title = "distance [mm]";
  chart.series.push_back(std::move(s));
  return chart;
}

}  // namespace

LineChart line_in_plane(const FieldPlane& plane, const std::string& along, const std::string& title,
                        const std::string& time, bool mirror) {
  const PlaneArray& a = plane.values;
  LineChart chart = line_out(along, 2, std::min(a.dx, a.dy), [&](const Place& x) {
    return value_at(a, ((mirror ? std::abs(x[0]) : x[0]) - a.x0) / a.dx, (x[1] - a.y0) / a.dy);
  });
  chart.title = title;
  chart.note = time + ", " + chart.note;
  chart.y_title = plane.label;
  return chart;
}

bool is_line_in_space(const std::string& along) {
  return std::ranges::count(along.substr(0, along.find(':')), ',') == 2;
}

LineChart line_in_space(const FieldScene& scene, const std::string& along, const std::string& title,
                        const std::string& time) {
  LineChart chart = line_out(along, 3, scene.cell(), [&](const Place& at) {
    const Vec<3> x{{at[0], at[1], at[2]}};
    return scene.distance(x) < 0 ? scene.value(x, scene.body(x)) : std::numeric_limits<double>::quiet_NaN();
  });
  chart.title = title;
  chart.note = time + ", " + chart.note;
  chart.y_title = scene.label();
  return chart;
}

}  // namespace recoil::app
