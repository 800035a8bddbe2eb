#include "app/field_plot.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "config/units.hpp"
#include "core/closest.hpp"
#include "core/error.hpp"
#include "output/field_picture.hpp"
#include "output/line_chart.hpp"
#include "output/raster.hpp"
#include "output/vtkhdf.hpp"

namespace recoil::app {

namespace fs = std::filesystem;

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// The units that names of arrays end in, as people write them.
struct UnitName {
  const char *in_array, *shown;
};
constexpr UnitName units[] = {{"_GPa", "GPa"}, {"_m_per_s", "m/s"}, {"_kg_per_m3", "kg/m3"},
                              {"_K", "K"},     {"_m", "m"},         {"_J_per_kg", "J/kg"}};

struct ArrayName {
  std::string base, unit;
};

ArrayName split(const std::string& name) {
  for (const UnitName& u : units)
    if (name.ends_with(u.in_array))
      return {name.substr(0, name.size() - std::string(u.in_array).size()), u.shown};
  return {name, ""};
}

const NamedArray& array_named(const UnstructuredGrid& grid, const std::string& name) {
  std::vector<std::string> names;
  for (const NamedArray& a : grid.cell_arrays) {
    names.push_back(split(a.name).base);
    if (a.name == name || names.back() == name) return a;
  }
  const std::string near = did_you_mean(name, names);
  throw InputError(fmt::format("there is no field '{}'\n   = help: {}", name,
                               near.empty() ? fmt::format("there are {}", fmt::join(names, ", ")) : near));
}

int component_of(const NamedArray& a, const std::string& name) {
  const std::vector<std::string> names = a.components == 6
                                             ? std::vector<std::string>{"xx", "yy", "zz", "xy", "yz", "xz"}
                                             : std::vector<std::string>{"x", "y", "z"};
  // Axisymmetric cases: r is the first direction of a file, z the second.
  const std::string axis = name == "r" ? "x" : name == "rr" ? "xx" : name == "rz" ? "xy" : name;
  const auto found = std::find(names.begin(), names.end(), axis);
  if (a.components == 1 || found == names.end())
    throw InputError(fmt::format("'{}' has no component '{}'", split(a.name).base, name));
  return static_cast<int>(found - names.begin());
}

/// The files of a run's dumps with their times.
std::vector<SeriesEntry> dumps_of(const fs::path& folder, fs::path& fields) {
  fields = folder / "fields";
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(fields, error))
    if (entry.path().string().ends_with(".hdf.series"))
      if (auto all = read_series(entry.path()); !all.empty()) return all;
  throw InputError(
      fmt::format("{} holds no fields\n   = help: set output.fields.every in the case", folder.string()));
}

SeriesEntry nearest_dump(const std::vector<SeriesEntry>& all, const std::string& at) {
  if (at.empty()) return all.back();
  const config::Quantity time = config::parse_quantity(at, "s", "--at");
  if (!time.ok()) throw InputError(fmt::format("{}\n   = help: {}", time.problem, time.help));
  return *std::min_element(all.begin(), all.end(), [&](const SeriesEntry& a, const SeriesEntry& b) {
    return std::abs(a.time_s - time.value) < std::abs(b.time_s - time.value);
  });
}

/// Place of the plane of "z=0mm" [m].
double place_of_slice(const std::string& text) {
  if (text.empty()) return 0;
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || text.substr(0, equals) != "z")
    throw InputError(fmt::format("a plane is given as z=PLACE, not '{}'\n   = help: --slice z=0mm", text));
  const config::Quantity place = config::parse_quantity(text.substr(equals + 1), "m", "--slice");
  if (!place.ok()) throw InputError(fmt::format("{}\n   = help: {}", place.problem, place.help));
  return place.value;
}

/// Signed distance of the matter of all bodies together: the least of theirs; empty where the file has none.
std::vector<std::vector<double>> distances(const UnstructuredGrid& grid) {
  std::vector<std::vector<double>> all;
  for (const NamedArray& a : grid.cell_arrays)
    if (a.name.starts_with("phi") && a.components == 1) all.push_back(as_doubles(a.values));
  return all;
}

Image profile(const UnstructuredGrid& grid, const ScalarField& field, const std::string& title,
              const std::string& note) {
  LineChart chart;
  chart.title = title;
  chart.note = note;
  chart.x_title = "x [mm]";
  chart.y_title = field.label;
  std::vector<std::array<double, 3>> points;  // place, width, value
  for (std::size_t i = 0; i < grid.cells(); ++i) {
    const auto first = static_cast<std::size_t>(grid.connectivity[static_cast<std::size_t>(grid.offsets[i])]);
    const auto last =
        static_cast<std::size_t>(grid.connectivity[static_cast<std::size_t>(grid.offsets[i]) + 1]);
    const double a = grid.points[3 * first], b = grid.points[3 * last];
    points.push_back({500 * (a + b), 1e3 * std::abs(b - a), field.values[i]});
  }
  std::sort(points.begin(), points.end());
  Series s;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool gap = i > 0 && points[i][0] - points[i - 1][0] > 1.5 * points[i][1];
    if (gap) s.x.push_back(points[i][0] - points[i][1]), s.y.push_back(nothing);
    s.x.push_back(points[i][0]), s.y.push_back(points[i][2]);
  }
  chart.series.push_back(std::move(s));
  return line_chart(chart);
}

Image plane(const UnstructuredGrid& grid, const ScalarField& field, double cut, const std::string& title,
            const std::string& note) {
  const PlaneArray array = rasterise(grid, field.values, cut);
  FieldPicture picture;
  picture.nx = array.nx, picture.ny = array.ny;
  picture.x0 = array.x0, picture.y0 = array.y0;
  picture.dx = array.dx, picture.dy = array.dy;
  picture.values = array.values;
  for (const std::vector<double>& phi : distances(grid))
    for (Outline& o : zero_outlines(rasterise(grid, phi, cut))) picture.outlines.push_back(std::move(o));
  picture.title = title;
  picture.note = note;
  picture.label = field.label;
  double lo = 0, hi = 0;
  for (const double v : field.values)
    if (std::isfinite(v)) lo = std::min(lo, v), hi = std::max(hi, v);
  if (lo < -0.1 * hi) {  // signed: zero in the middle
    picture.map = ColourMap::diverging;
    const double most = std::max(-lo, hi);
    picture.range = {{-most, most}};
  }
  return field_picture(picture);
}

}  // namespace

ScalarField scalar_field(const UnstructuredGrid& grid, const std::string& name) {
  std::string wanted = name, part;
  if (const std::size_t dot = name.find('.'); dot != std::string::npos) {
    wanted = name.substr(0, dot);
    part = name.substr(dot + 1);
  }
  std::replace(wanted.begin(), wanted.end(), '-', '_');
  const NamedArray& a = array_named(grid, wanted);
  const std::vector<double> all = as_doubles(a.values);
  const auto n = static_cast<std::size_t>(a.components);
  if (part.empty() && n == 6)
    throw InputError(fmt::format("'{}' has six components\n   = help: name one, e.g. {}.xx", name, name));
  ScalarField field;
  const auto [base, unit] = split(a.name);
  field.label = base + (part.empty() ? "" : "." + part) + (unit.empty() ? "" : " [" + unit + "]");
  std::replace(field.label.begin(), field.label.end(), '_', ' ');
  const std::size_t component = part.empty() ? 0 : static_cast<std::size_t>(component_of(a, part));
  for (std::size_t i = 0; i < grid.cells(); ++i)
    field.values.push_back(n == 3 && part.empty() ? std::hypot(all[3 * i], all[3 * i + 1], all[3 * i + 2])
                                                  : all[n * i + component]);
  for (const NamedArray& fraction : grid.cell_arrays) {
    if (fraction.name != "volume_fraction" || &fraction == &a) continue;
    const std::vector<double> v = as_doubles(fraction.values);
    for (std::size_t i = 0; i < v.size(); ++i)
      if (v[i] < 0.5) field.values[i] = nothing;
  }
  return field;
}

int plot_field(const PlotOptions& o) {
  fs::path fields;
  const SeriesEntry dump = nearest_dump(dumps_of(o.folder, fields), o.at);
  const VtkhdfFile file = read_vtkhdf(fields / dump.name);
  const ScalarField field = scalar_field(file.grid, o.what.front());
  const std::string title = fs::path(o.folder).lexically_normal().filename().string();
  const std::string note = fmt::format("{:.4g} µs", dump.time_s * 1e6);
  const bool line =
      !file.grid.types.empty() && file.grid.types.front() == static_cast<unsigned char>(VtkCell::line);
  const Image image = line ? profile(file.grid, field, title, note)
                           : plane(file.grid, field, place_of_slice(o.slice), title, note);
  const fs::path png =
      o.file.empty() ? fs::path(o.folder) / fmt::format("{}_{:.4g}us.png", o.what.front(), dump.time_s * 1e6)
                     : fs::path(o.file);
  write_png(png, image);
  fmt::print("{}\n", png.string());
  return 0;
}

}  // namespace recoil::app
