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
#include "app/plot/colour_options.hpp"
#include "app/plot/field_plotter.hpp"
#include "app/plot/plot_file.hpp"
#include "app/plot/written_field.hpp"
#include "config/geometry.hpp"
#include "config/units.hpp"
#include "core/error.hpp"
#include "format/csv.hpp"
#include "picture/axis.hpp"
#include "picture/field_picture.hpp"
#include "picture/field_plane.hpp"
#include "picture/line_chart.hpp"

namespace recoil::app {

namespace {

constexpr double told_difference = 0.01;  // between the time of a picture and the one asked for

}  // namespace

int plot_field(const PlotOptions& o) {
  const auto wanted = o.at.empty() ? std::nullopt : std::optional<double>(quantity_option(o.at, "s", "--at"));
  if (wanted && *wanted < 0)
    throw InputError(
        fmt::format("--at {} lies before the start of the run\n   = help: a run begins at time 0", o.at));
  const ChosenDump chosen = choose_dump(o.folder, wanted);
  if (wanted && std::abs(chosen.time_s - *wanted) > told_difference * *wanted)
    fmt::print(
        "note: {:.6g} us is the saved time nearest to {:.6g} us; more are saved with a shorter `every` in "
        "[output.fields]\n",
        chosen.time_s * 1e6, *wanted * 1e6);
  const Canvas canvas = FieldPlotter(o).draw(chosen);
  return save_picture(o, canvas,
                      fmt::format("{}_{:.4g}us{}", o.what.front(), chosen.time_s * 1e6,
                                  asks_for_view(o)  ? "_view"
                                  : o.along.empty() ? ""
                                                    : "_along"));
}

int plot_field_over_time(const PlotOptions& given) {
  const LoadedCase run = load_run(given.folder);
  const config::Case& c = run.contents;
  PlotOptions o = given;
  o.round_off = round_off_of(run);
  if (config::dimension(c.domain.geometry) != 1)
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
    const RunUnits units = run_units(c.domain.geometry);
    const FieldPlane plane =
        field_plane(read_with_field(dumps[j].path, o.what.front(), units), o.what.front(), units);
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
  picture.x_title = config::axes_of(c.domain.geometry).front() + " [mm]", picture.y_title = "time [µs]";
  picture.y_scale = 1e6;
  picture.equal_aspect = false;
  choose_colours(picture, signed_values, o);
  choose_look(picture, o);
  return save_picture(o, field_picture(picture), o.what.front() + "_xt");
}

}  // namespace recoil::app
