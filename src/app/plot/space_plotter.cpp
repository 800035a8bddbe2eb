#include "app/plot/space_plotter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>

#include "app/plot/colour_options.hpp"
#include "app/plot/plane_option.hpp"
#include "app/plot/plot_file.hpp"
#include "app/plot/rigid_scene.hpp"
#include "app/plot/written_field.hpp"
#include "config/geometry.hpp"
#include "core/error.hpp"
#include "picture/axis.hpp"

namespace recoil::app {

namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double usual_azimuth = -55 * degree, usual_elevation = 24 * degree;

int axis_of(const std::string& text, const char* option) {
  const std::size_t axis = text.size() == 1 ? std::string("xyz").find(text) : std::string::npos;
  if (axis == std::string::npos) throw InputError(fmt::format("{} is x, y or z, not '{}'", option, text));
  return static_cast<int>(axis);
}

/// Along an axis, from its positive or negative side.
View along_axis(const std::string& text, int up) {
  const bool back = text.front() == '-';
  const int axis = axis_of(text.substr(back || text.front() == '+' ? 1 : 0), "--view");
  if (axis == up) return View::from(-90 * degree, back ? -90 * degree : 90 * degree, up);
  return View::from((axis == (up + 1) % 3 ? 0 : 90 * degree) + (back ? 180 * degree : 0), 0, up);
}

}  // namespace

bool asks_for_view(const PlotOptions& o) {
  return !o.view.empty() || !o.cut.empty() || o.mirror || !o.up.empty() || !o.bodies.empty();
}

View read_view(const std::string& text, const std::string& up) {
  const int axis = up.empty() ? 2 : axis_of(up, "--up");
  if (text.empty()) return View::from(usual_azimuth, usual_elevation, axis);
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos && text.find_first_of("xyz") != std::string::npos)
    return along_axis(text, axis);
  if (comma == std::string::npos)
    throw InputError(
        fmt::format("'{}' is no direction of view\n   = help: an axis such as x or -y, or two angles: --view "
                    "-50deg,25deg",
                    text));
  const double elevation = quantity_option(text.substr(comma + 1), "rad", "--view");
  if (!(std::abs(elevation) <= 90.001 * degree))
    throw InputError("--view: the second angle, above the horizon, is -90 deg to 90 deg");
  return View::from(quantity_option(text.substr(0, comma), "rad", "--view"), elevation, axis);
}

SpacePlane read_cut(const std::string& text, const View& view) {
  const SpacePlane plane = read_plane(text, "--cut");
  const double facing = dot(plane.normal, view.forward);
  if (std::abs(facing) < 1e-6)
    throw InputError(fmt::format(
        "the plane {} is seen from its edge\n   = help: choose another --view, e.g. --view -50deg,25deg",
        text));
  return facing > 0 ? SpacePlane{-plane.normal, -plane.distance} : plane;
}

std::array<std::array<bool, 3>, 2> symmetric_faces(const config::Domain& domain) {
  std::array<std::array<bool, 3>, 2> faces{};
  for (std::size_t d = 0; d < 3; ++d)
    for (std::size_t side = 0; side < 2; ++side)
      faces[side][d] = domain.boundary[d][side] == config::Boundary::symmetry;
  return faces;
}

SpacePlotter::SpacePlotter(const PlotOptions& o, const config::Case& c)
    : options_(o), case_(c), view_(read_view(o.view, o.up)) {
  if (c.domain.geometry != config::Geometry::space)
    throw InputError("--view, --up, --cut, --mirror and --body need a 3d run\n   = help: omit them");
  if (!(o.slice.empty() && o.window.empty() && o.outline.empty() && o.along.empty()))
    throw InputError(
        "--slice, --window, --outline and --along draw a plane or a curve\n   = help: omit them, or --view, "
        "--up, "
        "--cut, --mirror and --body");
  if (!o.cut.empty()) cut_ = read_cut(o.cut, view_);
}

SpacePlotter::Frame SpacePlotter::frame_of(const ChosenDump& dump) const {
  // Rigid bodies have no field.
  std::vector<std::string> bodies;
  for (const std::string& name : options_.bodies) {
    const auto b = std::ranges::find(case_.bodies, name, &config::Body::name);
    if (b == case_.bodies.end() || !b->rigid) bodies.push_back(name);
  }
  if (bodies.empty() && !options_.bodies.empty())
    throw InputError("--body names rigid bodies only, which have no field\n   = help: add a deformable one");
  const RunUnits units = run_units(case_.domain.geometry);
  const VtkhdfFile file = read_with_field(dump.path, options_.what.front(), units);
  return {{file, options_.what.front(), units, bodies}, rigid_places_in(file.grid), file.time_s};
}

template <class F>
auto SpacePlotter::completed(const Frame& frame, F&& f) const {
  const RigidScene scene(frame.field, frame.field.bodies(), case_, frame.time, frame.rigid, options_.bodies);
  if (!options_.mirror) return f(static_cast<const Scene&>(scene));
  auto [low, high] = symmetric_faces(case_.domain);
  const SpaceBox box = scene.box();  // matter that has left a plane of symmetry is not mirrored there
  for (std::size_t d = 0; d < 3; ++d) {
    const int k = static_cast<int>(d);
    low[d] = low[d] && std::abs(box.lo[k] - case_.domain.lo[d]) < 0.01 * scene.cell();
    high[d] = high[d] && std::abs(box.hi[k] - case_.domain.hi[d]) < 0.01 * scene.cell();
  }
  return f(static_cast<const Scene&>(MirroredScene(scene, low, high)));
}

ViewWindow SpacePlotter::seen_of(const Frame& frame) const {
  const auto seen = completed(frame, [&](const Scene& s) { return window_of(s, view_, cut_); });
  if (!seen)
    throw InputError(fmt::format("nothing is left of the bodies{}",
                                 options_.cut.empty() ? "" : " behind --cut " + options_.cut));
  return *seen;
}

SpacePicture SpacePlotter::empty_picture(const ChosenDump& dump) const {
  SpacePicture p;
  p.view = view_;
  p.cut = cut_;
  p.title = options_.title.empty() ? case_.title : options_.title;
  p.note = fmt::format("{:.4g} µs", dump.time_s * 1e6);
  if (options_.width > 0) p.max_width = options_.width;
  if (options_.height > 0) p.max_height = options_.height;
  return p;
}

void SpacePlotter::hold_frame(const std::vector<ChosenDump>& dumps) {
  window_.reset();
  for (const ChosenDump& dump : dumps) {
    const ViewWindow own = seen_of(frame_of(dump));
    window_ = window_ ? joined(*window_, own) : own;
  }
  Range values;
  std::string label;
  for (const ChosenDump& dump : dumps) {
    const Frame frame = frame_of(dump);
    label = frame.field.label();
    for (const Category& c : frame.field.categories())
      if (std::ranges::find(categories_, c.value, &Category::value) == categories_.end())
        categories_.push_back(c);
    SpacePicture p = empty_picture(dump);
    p.window = *window_;
    p.max_width = 400, p.max_height = 400;  // few rays tell the range
    const SpaceRays rays = completed(frame, [&](const Scene& s) { return rays_of(p, s); });
    for (const double v : rays.values()) values.include(v, options_.log);
  }
  std::ranges::sort(categories_, {}, &Category::value);
  if (categories_.empty()) hold_limits(options_, label, values);
}

Canvas SpacePlotter::draw(const ChosenDump& dump) const {
  const Frame frame = frame_of(dump);
  SpacePicture p = empty_picture(dump);
  p.window = window_ ? *window_ : seen_of(frame);
  p.label = frame.field.label();
  const SpaceRays rays = completed(frame, [&](const Scene& s) { return rays_of(p, s); });
  const std::vector<double> values = rays.values();
  const std::vector<Category>& names = categories_.empty() ? frame.field.categories() : categories_;
  const ColourChoice choice = chosen_colours(values, p.label, names, frame.field.signed_values(), options_);
  return space_picture(p, rays, colours_of(values, choice));
}

}  // namespace recoil::app
