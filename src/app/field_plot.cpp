#include "app/field_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "config/read_case.hpp"
#include "config/read_shape.hpp"
#include "config/units.hpp"
#include "core/error.hpp"
#include "output/field_picture.hpp"
#include "output/field_plane.hpp"
#include "output/line_chart.hpp"

namespace recoil::app {

namespace fs = std::filesystem;

namespace {

double quantity(const std::string& text, const char* unit, const char* option) {
  const config::Quantity q = config::parse_quantity(text, unit, option);
  if (!q.ok()) throw InputError(fmt::format("{}\n   = help: {}", q.problem, q.help));
  return q.value;
}

/// Place of the plane of "z=0mm" [m]; without it z = 0, or the middle of a domain that does not hold it.
double place_of_slice(const std::string& text, const config::Domain& domain) {
  if (text.empty()) return domain.lo[2] <= 0 && domain.hi[2] > 0 ? 0 : 0.5 * (domain.lo[2] + domain.hi[2]);
  if (!text.starts_with("z="))
    throw InputError(fmt::format("a plane is given as z=PLACE, not '{}'\n   = help: --slice z=0mm", text));
  return quantity(text.substr(2), "m", "--slice");
}

/// The case that a run computed; of it only the domain counts here.
config::Case case_of(const fs::path& run) {
  config::Document document;
  config::Diagnostics out;
  const fs::path resolved = run / "case.resolved.toml";
  if (!fs::exists(resolved)) throw InputError(fmt::format("{} is no folder of a run", run.string()));
  config::Case c = config::read_case(resolved.string(), document, out);
  out.throw_if_errors();
  return c;
}

Image curve_of(const FieldPlane& plane, const std::string& title, const std::string& note) {
  LineChart chart{title, note, "x [mm]", plane.label};
  Series s;
  for (int i = 0; i < plane.values.nx; ++i) {
    s.x.push_back(1e3 * (plane.values.x0 + (i + 0.5) * plane.values.dx));
    s.y.push_back(plane.values.at(i, 0));
  }
  chart.series.push_back(std::move(s));
  return line_chart(chart);
}

Image picture_of(const FieldPlane& plane, const config::Case& c, const std::string& title,
                 const std::string& note) {
  const PlaneArray& a = plane.values;
  FieldPicture picture;
  picture.nx = a.nx, picture.ny = a.ny;
  picture.x0 = a.x0, picture.y0 = a.y0;
  picture.dx = a.dx, picture.dy = a.dy;
  picture.values = a.values;
  picture.level_set = plane.matter.values;
  for (const PlaneArray& phi : plane.level_sets)
    for (Outline& o : zero_outlines(phi)) picture.outlines.push_back(std::move(o));
  picture.title = title;
  picture.note = note;
  picture.label = plane.label;
  const auto axes = config::axes_of(c.domain.geometry);
  picture.x_title = axes[0] + " [mm]";
  picture.y_title = axes[1] + " [mm]";
  picture.mirror = c.domain.geometry == config::Geometry::axisymmetric;
  double lo = 0, hi = 0;
  for (const double v : a.values)
    if (std::isfinite(v)) lo = std::min(lo, v), hi = std::max(hi, v);
  if (plane.signed_values && lo < 0) {  // zero in the middle of the colours
    picture.map = ColourMap::diverging;
    picture.range = {{-std::max(-lo, hi), std::max(-lo, hi)}};
  }
  return field_picture(picture);
}

}  // namespace

int plot_field(const PlotOptions& o) {
  const config::Case c = case_of(o.folder);
  const ChosenDump chosen =
      choose_dump(o.folder, o.at.empty() ? std::nullopt : std::optional<double>(quantity(o.at, "s", "--at")));
  const std::string& name = o.what.front();
  const FieldPlane plane = field_plane(read_vtkhdf(chosen.path), name, run_units(c.domain.geometry),
                                       place_of_slice(o.slice, c.domain));
  const std::string note = fmt::format("{:.4g} µs", chosen.time_s * 1e6);
  const Image image = c.domain.geometry == config::Geometry::line ? curve_of(plane, c.title, note)
                                                                  : picture_of(plane, c, c.title, note);
  const fs::path png = o.file.empty()
                           ? fs::path(o.folder) / fmt::format("{}_{:.4g}us.png", name, chosen.time_s * 1e6)
                           : fs::path(o.file);
  write_png(png, image);
  fmt::print("{}\n", png.string());
  return 0;
}

}  // namespace recoil::app
