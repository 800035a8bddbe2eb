#include "app/plot/field_plotter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/load_case.hpp"
#include "app/plot/colour_options.hpp"
#include "app/plot/line_out.hpp"
#include "app/plot/plane_option.hpp"
#include "app/plot/plot_file.hpp"
#include "app/plot/written_field.hpp"
#include "config/geometry.hpp"
#include "config/units.hpp"
#include "core/error.hpp"
#include "core/nothing.hpp"
#include "format/csv.hpp"
#include "picture/axis.hpp"
#include "picture/field_picture.hpp"
#include "picture/field_plane.hpp"
#include "picture/line_chart.hpp"

namespace recoil::app {

namespace {

/// The plane of --slice; without one the plane across z through the middle.
SpacePlane slice_of(const std::string& text, const config::Domain& domain) {
  if (!text.empty()) return read_plane(text, "--slice");
  return {{{0, 0, 1}}, middle_cut(domain, 2).place};
}

/// The axes of the picture's plane.
std::vector<std::string> axes_in(const config::Domain& domain, const SpacePlane& slice) {
  std::vector<std::string> axes = config::axes_of(domain.geometry);
  if (axes.size() < 3) return axes;
  if (const int axis = axis_across(slice); axis >= 0) {
    axes.erase(axes.begin() + axis);
    return axes;
  }
  const auto [across, up] = axes_of(slice);
  axes.clear();
  for (const Vec<3>& a : {across, up})
    axes.push_back(fmt::format("along ({:.3g}, {:.3g}, {:.3g})", a[0] + 0.0, a[1] + 0.0, a[2] + 0.0));
  return axes;
}

LineChart curve_of(const FieldPlane& plane, const config::Case& c, const std::string& note) {
  LineChart chart{c.title, note, config::axes_of(c.domain.geometry).front() + " [mm]", plane.label};
  Series s;
  for (int i = 0; i < plane.values.nx; ++i) {
    s.x.push_back(1e3 * (plane.values.x0 + (i + 0.5) * plane.values.dx));
    s.y.push_back(plane.values.at(i, 0));
  }
  chart.series.push_back(std::move(s));
  return chart;
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
    if (!(window[axis].to > window[axis].from))
      throw InputError(
          fmt::format("the interval '{}' of --window ends before it begins\n   = help: write the smaller "
                      "coordinate first: {}={}..{}",
                      part, axes[static_cast<std::size_t>(axis)], part.substr(dots + 2),
                      part.substr(equals + 1, dots - equals - 1)));
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

/// Grows the array to the box, without values there.
void pad(PlaneArray& a, const PlaneBox& box, double nothing) {
  const int left = static_cast<int>(std::lround((a.x0 - box.x0) / a.dx));
  const int below = static_cast<int>(std::lround((a.y0 - box.y0) / a.dy));
  PlaneArray b{static_cast<int>(std::lround((box.x1 - box.x0) / a.dx)),
               static_cast<int>(std::lround((box.y1 - box.y0) / a.dy)),
               a.x0 - left * a.dx,
               a.y0 - below * a.dy,
               a.dx,
               a.dy,
               {}};
  b.values.assign(static_cast<std::size_t>(b.nx) * static_cast<std::size_t>(b.ny), nothing);
  for (int j = 0; j < a.ny; ++j)
    for (int i = 0; i < a.nx; ++i)
      if (i + left >= 0 && i + left < b.nx && j + below >= 0 && j + below < b.ny)
        b.values[static_cast<std::size_t>(i + left) +
                 static_cast<std::size_t>(b.nx) * static_cast<std::size_t>(j + below)] = a.at(i, j);
  a = std::move(b);
}

void grow(std::optional<PlaneBox>& box, const PlaneArray& a) {
  const PlaneBox own{a.x0, a.x0 + a.nx * a.dx, a.y0, a.y0 + a.ny * a.dy};
  if (!box) box = own;
  *box = {std::min(box->x0, own.x0), std::max(box->x1, own.x1), std::min(box->y0, own.y0),
          std::max(box->y1, own.y1)};
}

}  // namespace

/// Size, heading and sharpness by the options.
void choose_look(FieldPicture& picture, const PlotOptions& o) {
  if (o.width > 0) picture.max_width = o.width;
  if (o.height > 0) picture.max_height = o.height;
  if (!o.title.empty()) picture.title = o.title;
  if (!o.file.empty() && picture_format(o.file) != PictureFormat::png) picture.detail = 2;
}

FieldPlotter::FieldPlotter(const PlotOptions& o) : FieldPlotter(o, load_run(o.folder)) {}

FieldPlotter::FieldPlotter(const PlotOptions& o, const LoadedCase& run)
    : options_(o), case_(run.contents), slice_(slice_of(o.slice, case_.domain)) {
  options_.round_off = round_off_of(run);
  if (asks_for_view(o)) view_.emplace(options_, case_);
  const bool in_space = case_.domain.geometry == config::Geometry::space;
  if (!in_space && !o.slice.empty()) throw InputError("--slice needs a 3d run\n   = help: omit it");
  if (is_line_in_space(o.along) && !in_space)
    throw InputError("a line of three coordinates needs a 3d run\n   = help: --along 0mm,1mm:9mm,1mm");
  if (is_line_in_space(o.along) && !(o.window.empty() && o.slice.empty()))
    throw InputError("a line of three coordinates lies in no plane\n   = help: omit --slice and --window");
  is_line_ = config::dimension(case_.domain.geometry) == 1;
  if (is_line_ && !(o.window.empty() && o.outline.empty() && o.along.empty()))
    throw InputError(
        "--window, --outline and --along need a field in the plane\n   = help: omit them for a 1d run");
}

FieldPlane FieldPlotter::whole_plane(const ChosenDump& dump) const {
  const RunUnits units = run_units(case_.domain.geometry);
  const VtkhdfFile file = read_with_field(dump.path, options_.what.front(), units);
  const int axis = axis_across(slice_);
  if (axis < 0) return field_plane(file, options_.what.front(), units, slice_);
  const double place = slice_.normal[axis] < 0 ? -slice_.distance : slice_.distance;
  return field_plane(file, options_.what.front(), units, Cut{static_cast<std::size_t>(axis), place});
}

FieldPlane FieldPlotter::plane_of(const ChosenDump& dump) const {
  FieldPlane plane = whole_plane(dump);
  if (draws_curves()) return plane;
  if (box_) {
    pad(plane.values, *box_, nothing);
    pad(plane.matter, *box_, 8 * std::max(plane.matter.dx, plane.matter.dy));
    for (PlaneArray& phi : plane.level_sets) pad(phi, *box_, nothing);
  }
  if (options_.window.empty()) return plane;
  const auto window = read_window(options_.window, axes_in(case_.domain, slice_));
  crop(plane.values, window);
  crop(plane.matter, window);
  for (PlaneArray& phi : plane.level_sets) crop(phi, window);
  return plane;
}

LineChart FieldPlotter::curve_in(const ChosenDump& dump, const std::string& note) const {
  if (is_line_in_space(options_.along)) {
    const RunUnits units = run_units(case_.domain.geometry);
    return line_in_space(
        {read_with_field(dump.path, options_.what.front(), units), options_.what.front(), units},
        options_.along, case_.title, note);
  }
  const FieldPlane plane = plane_of(dump);
  if (is_line_) return curve_of(plane, case_, note);
  const bool mirror = case_.domain.geometry == config::Geometry::axisymmetric;
  return line_in_plane(plane, options_.along, case_.title, note, mirror);
}

void FieldPlotter::hold_frame(const std::vector<ChosenDump>& dumps) {
  if (view_) return view_->hold_frame(dumps);
  Range values;
  std::string label;
  if (draws_curves()) {
    for (const ChosenDump& dump : dumps) {
      if (is_line_) grow(box_, whole_plane(dump).matter);
      const LineChart chart = curve_in(dump, "");
      label = chart.y_title;
      for (const Series& s : chart.series)
        for (const double y : s.y) values.include(y, options_.log);
    }
    return hold_limits(options_, label, values);
  }
  std::optional<PlaneBox> box;
  for (const ChosenDump& dump : dumps) grow(box, whole_plane(dump).matter);
  box_ = box;
  for (const ChosenDump& dump : dumps) {
    const FieldPlane plane = plane_of(dump);
    label = plane.label;
    for (const double v : plane.values.values) values.include(v, options_.log);
    for (const Category& c : plane.categories)
      if (std::ranges::find(categories_, c.value, &Category::value) == categories_.end())
        categories_.push_back(c);
  }
  std::ranges::sort(categories_, {}, &Category::value);
  if (categories_.empty()) hold_limits(options_, label, values);
}

Canvas FieldPlotter::draw(const ChosenDump& dump) const {
  if (view_) return view_->draw(dump);
  const std::string note = fmt::format("{:.4g} µs", dump.time_s * 1e6);
  if (!draws_curves()) return picture_of(plane_of(dump), note);
  LineChart chart = curve_in(dump, note);
  if (box_ && is_line_) chart.x_range = {1e3 * box_->x0, 1e3 * box_->x1};
  return chart_canvas(options_, std::move(chart));
}

Canvas FieldPlotter::picture_of(const FieldPlane& plane, const std::string& note) const {
  const config::Case& c = case_;
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
  picture.categories = categories_.empty() ? plane.categories : categories_;
  const auto axes = axes_in(c.domain, slice_);
  picture.x_title = axes[0] + " [mm]";
  picture.y_title = axes[1] + " [mm]";
  picture.mirror = c.domain.geometry == config::Geometry::axisymmetric;
  if (!options_.outline.empty()) picture.references.push_back(read_outline(options_.outline, plane.time_s));
  choose_colours(picture, plane.signed_values, options_);
  choose_look(picture, options_);
  return field_picture(picture);
}

}  // namespace recoil::app
