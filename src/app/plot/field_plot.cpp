#include "app/plot/field_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/load_case.hpp"
#include "app/plot/plot_file.hpp"
#include "config/geometry.hpp"
#include "config/units.hpp"
#include "core/error.hpp"
#include "format/csv.hpp"
#include "picture/axis.hpp"
#include "picture/field_picture.hpp"
#include "picture/field_plane.hpp"
#include "picture/line_chart.hpp"

namespace recoil::app {

namespace fs = std::filesystem;

namespace {

/// The plane of "z=0mm"; without a text the one across z through the middle.
Cut cut_of(const std::string& text, const config::Domain& domain) {
  if (text.empty()) return middle_cut(domain, 2);
  const std::size_t axis = std::string("xyz").find(text.front());
  if (axis == std::string::npos || text.size() < 2 || text[1] != '=')
    throw InputError(fmt::format("a plane is given as z=PLACE, not '{}'\n   = help: --slice z=0mm", text));
  return {axis, quantity_option(text.substr(2), "m", "--slice")};
}

/// The axes of the picture's plane.
std::vector<std::string> axes_in(const config::Domain& domain, Cut cut) {
  std::vector<std::string> axes = config::axes_of(domain.geometry);
  if (axes.size() == 3) axes.erase(axes.begin() + static_cast<std::ptrdiff_t>(cut.axis));
  return axes;
}

LineChart curve_of(const FieldPlane& plane, const std::string& title, const std::string& note) {
  LineChart chart{title, note, "x [mm]", plane.label};
  Series s;
  for (int i = 0; i < plane.values.nx; ++i) {
    s.x.push_back(1e3 * (plane.values.x0 + (i + 0.5) * plane.values.dx));
    s.y.push_back(plane.values.at(i, 0));
  }
  chart.series.push_back(std::move(s));
  return chart;
}

/// Reads "0mm,1mm:9mm,1mm": two places [m].
std::pair<Point2, Point2> read_line(const std::string& text) {
  const auto place = [&text](const std::string& part) {
    const std::size_t comma = part.find(',');
    if (comma == std::string::npos)
      throw InputError(fmt::format("'{}' is not a line\n   = help: --along 0mm,1mm:9mm,1mm", text));
    return Point2{quantity_option(part.substr(0, comma), "m", "--along"),
                  quantity_option(part.substr(comma + 1), "m", "--along")};
  };
  const std::size_t colon = std::min(text.find(':'), text.size());
  const std::pair<Point2, Point2> line{place(text.substr(0, colon)),
                                       place(colon < text.size() ? text.substr(colon + 1) : "")};
  if (line.first == line.second)
    throw InputError(fmt::format("'{}' is a point\n   = help: --along needs two places", text));
  return line;
}

/// The value at (u, v), in cells from the lower left corner: linear between the four nearest centres of
/// cells, of which those without matter do not count. NaN in a cell without matter.
double value_at(const PlaneArray& a, double u, double v) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
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

/// The field along a line, two values a cell, over the distance from its beginning.
/// @param mirror whether x < 0 is the mirror image of x > 0.
LineChart line_out(const FieldPlane& plane, const std::string& text, const std::string& title,
                   const std::string& time, bool mirror) {
  const auto [from, to] = read_line(text);
  const PlaneArray& a = plane.values;
  const double length = std::hypot(to.x - from.x, to.y - from.y);
  const int n = static_cast<int>(std::clamp(2 * length / std::min(a.dx, a.dy), 2.0, 2e4));
  Series s;
  for (int k = 0; k <= n; ++k) {
    const double t = 1.0 * k / n, x = from.x + t * (to.x - from.x), y = from.y + t * (to.y - from.y);
    s.x.push_back(1e3 * t * length);
    s.y.push_back(value_at(a, ((mirror ? std::abs(x) : x) - a.x0) / a.dx, (y - a.y0) / a.dy));
  }
  if (std::ranges::all_of(s.y, [](double v) { return std::isnan(v); }))
    throw InputError(fmt::format("there is no matter along {}\n   = help: choose another --along", text));
  const auto mm = [](double x) { return fmt::format("{}{:.4g}", x < 0 ? "\u2212" : "", 1e3 * std::abs(x)); };
  const std::string note =
      fmt::format("{}, ({}, {}) to ({}, {}) mm", time, mm(from.x), mm(from.y), mm(to.x), mm(to.y));
  LineChart chart{title, note, "distance [mm]", plane.label};
  chart.series.push_back(std::move(s));
  return chart;
}

/// Colours by the options; zero in the middle of them where values have both signs.
void choose_colours(FieldPicture& picture, bool signed_values, const PlotOptions& o) {
  if (!picture.categories.empty()) {
    if (o.log || !o.lowest.empty() || !o.highest.empty())
      throw InputError("--min, --max and --log do not apply to a field of names\n   = help: omit them");
    return;
  }
  Range values;
  for (const double v : picture.values) values.include(v, o.log);
  picture.log = o.log;
  picture.range = range_of(o, picture.label, values.lo, values.hi);
  const double lo = picture.range ? picture.range->first : values.lo;
  const double hi = picture.range ? picture.range->second : values.hi;
  if (signed_values && !o.log && lo < 0 && (hi > 0 || !picture.range)) picture.map = ColourMap::diverging;
}

/// Size, heading and sharpness by the options.
void choose_look(FieldPicture& picture, const PlotOptions& o) {
  if (o.width > 0) picture.max_width = o.width;
  if (o.height > 0) picture.max_height = o.height;
  if (!o.title.empty()) picture.title = o.title;
  if (!o.file.empty() && picture_format(o.file) != PictureFormat::png) picture.detail = 2;
}

/// What a window leaves of one axis.
struct Span {
  double from = -1e300, to = 1e300;  // m
};

/// Reads "r=0mm..9mm,z=0mm..12mm".
std::array<Span, 2> read_window(const std::string& text, const std::vector<std::string>& axes) {
  std::array<Span, 2> window;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    const std::string part = text.substr(at, end - at);
    const std::size_t equals = part.find('='), dots = part.find("..");
    const auto axis = std::find(axes.begin(), axes.end(), part.substr(0, equals)) - axes.begin();
    if (equals == std::string::npos || dots == std::string::npos || axis > 1)
      throw InputError(
          fmt::format("'{}' is not an interval of a window\n   = help: --window {}=0mm..9mm,{}=0mm..12mm",
                      part, axes[0], axes[1]));
    window[axis] = {quantity_option(part.substr(equals + 1, dots - equals - 1), "m", "--window"),
                    quantity_option(part.substr(dots + 2), "m", "--window")};
    at = end + 1;
  }
  return window;
}

/// Leaves the cells whose centre lies in the window.
void crop(PlaneArray& a, const std::array<Span, 2>& window) {
  const auto first = [](double x0, double dx, double from, int n) {
    return std::clamp(static_cast<int>(std::ceil((from - x0) / dx - 0.5)), 0, n);
  };
  const int i0 = first(a.x0, a.dx, std::max(window[0].from, a.x0), a.nx),
            i1 = first(a.x0, a.dx, std::min(window[0].to, a.x0 + a.nx * a.dx), a.nx),
            j0 = first(a.y0, a.dy, std::max(window[1].from, a.y0), a.ny),
            j1 = first(a.y0, a.dy, std::min(window[1].to, a.y0 + a.ny * a.dy), a.ny);
  if (i1 <= i0 || j1 <= j0)
    throw InputError("the window lies outside the field\n   = help: choose another --window");
  PlaneArray b{i1 - i0, j1 - j0, a.x0 + i0 * a.dx, a.y0 + j0 * a.dy, a.dx, a.dy, {}};
  for (int j = j0; j < j1; ++j)
    for (int i = i0; i < i1; ++i) b.values.push_back(a.at(i, j));
  a = std::move(b);
}

/// The points of a table of time and two coordinates at the time nearest to t [s].
Outline read_outline(const std::string& file, double t) {
  const CsvTable table = read_csv(file);
  if (table.columns.size() < 3)
    throw InputError(
        fmt::format("{} is not an outline\n   = help: its columns are a time and two coordinates", file));
  const auto column = [&](std::size_t k) {
    std::vector<double> v = table.numbers(table.columns[k]);
    const std::string unit = table.unit(table.columns[k]);
    for (double& x : v) x *= unit.empty() ? 1 : config::unit_size(unit);
    return v;
  };
  const std::vector<double> time = column(0), x = column(1), y = column(2);
  double best = 0;
  for (const double s : time)
    if (std::abs(s - t) < std::abs(best - t)) best = s;
  Outline outline;
  for (std::size_t k = 0; k < time.size(); ++k)
    if (time[k] == best) outline.points.push_back({x[k], y[k]});
  return outline;
}

Canvas picture_of(const FieldPlane& plane, const config::Case& c, Cut cut, const std::string& note,
                  const PlotOptions& o) {
  const PlaneArray& a = plane.values;
  FieldPicture picture;
  picture.nx = a.nx, picture.ny = a.ny;
  picture.x0 = a.x0, picture.y0 = a.y0;
  picture.dx = a.dx, picture.dy = a.dy;
  picture.values = a.values;
  picture.level_set = plane.matter.values;
  for (const PlaneArray& phi : plane.level_sets)
    for (Outline& line : zero_outlines(phi)) picture.outlines.push_back(std::move(line));
  picture.title = c.title;
  picture.note = note;
  picture.label = plane.label;
  picture.categories = plane.categories;
  const auto axes = axes_in(c.domain, cut);
  picture.x_title = axes[0] + " [mm]";
  picture.y_title = axes[1] + " [mm]";
  picture.mirror = c.domain.geometry == config::Geometry::axisymmetric;
  if (!o.outline.empty()) picture.references.push_back(read_outline(o.outline, plane.time_s));
  choose_colours(picture, plane.signed_values, o);
  choose_look(picture, o);
  return field_picture(picture);
}

}  // namespace

int plot_field(const PlotOptions& o) {
  const config::Case c = load_run(o.folder).contents;
  const ChosenDump chosen = choose_dump(
      o.folder, o.at.empty() ? std::nullopt : std::optional<double>(quantity_option(o.at, "s", "--at")));
  const std::string& name = o.what.front();
  const Cut cut = cut_of(o.slice, c.domain);
  FieldPlane plane = field_plane(read_vtkhdf(chosen.path), name, run_units(c.domain.geometry), cut);
  const bool is_line = c.domain.geometry == config::Geometry::line;
  if (is_line && !(o.window.empty() && o.outline.empty() && o.along.empty()))
    throw InputError(
        "--window, --outline and --along need a field in the plane\n   = help: omit them for a 1d run");
  const std::string note = fmt::format("{:.4g} µs", chosen.time_s * 1e6);
  const std::string file = fmt::format("{}_{:.4g}us", name, chosen.time_s * 1e6);
  if (is_line) return save_chart(o, curve_of(plane, c.title, note), file);
  if (!o.along.empty()) {
    const bool mirror = c.domain.geometry == config::Geometry::axisymmetric;
    return save_chart(o, line_out(plane, o.along, c.title, note, mirror), file + "_along");
  }
  if (!o.window.empty()) {
    const auto window = read_window(o.window, axes_in(c.domain, cut));
    crop(plane.values, window);
    crop(plane.matter, window);
    for (PlaneArray& phi : plane.level_sets) crop(phi, window);
  }
  return save_picture(o, picture_of(plane, c, cut, note, o), file);
}

int plot_field_over_time(const PlotOptions& o) {
  const config::Case c = load_run(o.folder).contents;
  if (c.domain.geometry != config::Geometry::line)
    throw InputError("--xt needs a 1d run\n   = help: omit it; --at chooses the time of a picture");
  const std::vector<ChosenDump> dumps = all_dumps(o.folder);
  if (dumps.size() < 3)
    throw InputError(
        fmt::format("{} has {} dumps, too few for an x-t diagram\n   = help: run it with --set "
                    "'output.fields.every=0.05us'",
                    o.folder, dumps.size()));
  const double dx = c.mesh.finest;
  FieldPicture picture;
  picture.nx = static_cast<int>(std::ceil((c.domain.hi[0] - c.domain.lo[0]) / dx));
  picture.ny = static_cast<int>(dumps.size());
  picture.dx = dx;
  picture.dy = (dumps.back().time_s - dumps.front().time_s) / (picture.ny - 1);
  picture.x0 = c.domain.lo[0];
  picture.y0 = dumps.front().time_s - 0.5 * picture.dy;
  bool signed_values = false;
  std::vector<PlaneArray> surfaces;
  const auto put = [&](const PlaneArray& from, int j, std::vector<double>& to) {
    for (int i = 0; i < from.nx; ++i) {
      const int k = static_cast<int>(std::floor((from.x0 + (i + 0.5) * from.dx - picture.x0) / dx));
      if (k >= 0 && k < picture.nx) to[k + picture.nx * j] = from.at(i, 0);
    }
  };
  picture.values.assign(static_cast<std::size_t>(picture.nx * picture.ny),
                        std::numeric_limits<double>::quiet_NaN());
  const std::vector<double> nothing = picture.values;
  for (int j = 0; j < picture.ny; ++j) {
    const FieldPlane plane =
        field_plane(read_vtkhdf(dumps[j].path), o.what.front(), run_units(c.domain.geometry));
    picture.label = plane.label;
    picture.categories = plane.categories;
    signed_values = plane.signed_values;
    put(plane.values, j, picture.values);
    surfaces.resize(plane.level_sets.size(),
                    {picture.nx, picture.ny, picture.x0, picture.y0, picture.dx, picture.dy, nothing});
    for (std::size_t m = 0; m < surfaces.size(); ++m) put(plane.level_sets[m], j, surfaces[m].values);
  }
  for (const PlaneArray& phi : surfaces)
    for (Outline& line : zero_outlines(phi)) picture.outlines.push_back(std::move(line));
  picture.title = c.title;
  picture.x_title = "x [mm]", picture.y_title = "time [µs]";
  picture.y_scale = 1e6;
  picture.equal_aspect = false;
  choose_colours(picture, signed_values, o);
  choose_look(picture, o);
  return save_picture(o, field_picture(picture), o.what.front() + "_xt");
}

}  // namespace recoil::app
