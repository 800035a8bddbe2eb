#include "app/report/surface_frames.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "app/plot/rigid_scene.hpp"
#include "config/geometry.hpp"
#include "core/error.hpp"
#include "format/packed.hpp"
#include "format/run_units.hpp"
#include "format/vtkhdf.hpp"
#include "picture/field_scalar.hpp"
#include "picture/space/field_scene.hpp"
#include "picture/space/surface_net.hpp"
#include "record/rigid_places.hpp"

namespace recoil::app {

namespace {

constexpr std::size_t most_surface_frames = 24;
constexpr double most_cells = 80;   // of the lattice along the longest side
constexpr double point_parts = 16;  // of its spacing, in which points are stored
constexpr int value_bits = 8;       // as many as there are colours
constexpr std::array names{"plastic-strain", "velocity", "temperature", "damage", "pressure"};

/// Those of `names` that a dump has.
std::vector<std::string> fields_in(const UnstructuredGrid& grid, const RunUnits& units) {
  std::vector<std::string> found;
  const std::vector<FieldScalar> all = scalars_of(grid, units);
  for (const std::string name : names)
    if (std::ranges::any_of(
            all, [&](const FieldScalar& s) { return s.name == name || s.name.starts_with(name + "."); }))
      found.push_back(name);
  return found;
}

double spacing_of(const Scene& scene) {
  const SpaceBox box = scene.box();
  double longest = 0;
  for (int d = 0; d < 3; ++d) longest = std::max(longest, box.hi[d] - box.lo[d]);
  return std::max(0.5 * scene.cell(), longest / most_cells);
}

/// Which of n dumps are shown: `shown` of them, evenly, with the last.
std::vector<std::size_t> evenly(std::size_t n, std::size_t shown) {
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k < std::min(n, shown); ++k) chosen.push_back(n - 1 - k * n / std::min(n, shown));
  std::ranges::reverse(chosen);
  return chosen;
}

std::string packed_points(const SurfaceNet& net, const Vec<3>& corner, double unit) {
  std::vector<std::int32_t> all;
  for (int d = 0; d < 3; ++d)
    for (const Vec<3>& x : net.points)
      all.push_back(static_cast<std::int32_t>(std::lround((x[d] - corner[d]) / unit)));
  return packed_integers(all);
}

std::string packed_faces(const SurfaceNet& net) {
  std::vector<std::int32_t> all;
  for (std::size_t n = 0; n < 4; ++n)
    for (const auto& face : net.faces) all.push_back(face[n]);
  return packed_integers(all);
}

}  // namespace

std::size_t SurfaceFrames::Frame::size() const {
  std::size_t n = 100 + points.size() + faces.size() + 40 * values.size();  // with the places in the JSON
  for (const QuantisedField& v : values) n += v.packed.size();
  return n;
}

SurfaceFrames::SurfaceFrames(const RunDumps& found, const config::Case& c, double most) {
  if (c.domain.geometry != config::Geometry::space) return;
  const std::vector<ChosenDump>& dumps = found.whole;
  if (dumps.empty()) return;
  const double one = static_cast<double>(frame_of(dumps.back(), c).size());  // the most deformed surfaces
  const auto room = static_cast<std::size_t>(std::clamp(most / one, 0.0, double{most_surface_frames}));
  for (const std::size_t k : evenly(dumps.size(), room)) frames_.push_back(frame_of(dumps[k], c));
}

SurfaceFrames::Frame SurfaceFrames::packed_frame(double time, const SurfaceNet& net, double spacing) {
  Vec<3> low = net.points.empty() ? Vec<3>{} : net.points.front(), high = low;
  for (const Vec<3>& x : net.points)
    for (int d = 0; d < 3; ++d) low[d] = std::min(low[d], x[d]), high[d] = std::max(high[d], x[d]);
  Frame frame{.time_us = time * 1e6,
              .spacing_mm = spacing * 1e3,
              .points = packed_points(net, low, spacing / point_parts),
              .faces = packed_faces(net)};
  for (std::size_t d = 0; d < 3; ++d) {
    frame.low_mm[d] = low[static_cast<int>(d)] * 1e3;
    frame.high_mm[d] = high[static_cast<int>(d)] * 1e3;
  }
  return frame;
}

SurfaceFrames::Frame SurfaceFrames::frame_of(const ChosenDump& dump, const config::Case& c) {
  const VtkhdfFile file = read_vtkhdf(dump.path);
  const RunUnits units = run_units(c.domain.geometry);
  if (fields_.empty()) fields_ = fields_in(file.grid, units);
  const std::vector<RigidPlace> rigid = rigid_places_in(file.grid);
  Frame frame;
  std::vector<Vec<3>> below;
  for (const std::string& name : fields_) {
    const FieldScene matter(file, name, units);
    const RigidScene scene(matter, matter.bodies(), c, file.time_s, rigid, {});
    if (below.empty()) {
      const double spacing = spacing_of(scene);
      const SurfaceNet net = surface_net(scene, spacing);
      frame = packed_frame(file.time_s, net, spacing);
      below = points_below(net, 0.5 * scene.cell());
    }
    std::vector<double> values;
    for (const Vec<3>& x : below) values.push_back(scene.value(x, scene.body(x)));
    frame.values.push_back(quantised(values, value_bits, false));
  }
  return frame;
}

std::size_t SurfaceFrames::size() const {
  std::size_t n = 0;
  for (const Frame& frame : frames_) n += frame.size();
  return n;
}

Json SurfaceFrames::write(Blocks& blocks) const {
  if (frames_.empty() || fields_.empty()) return nullptr;
  std::array<double, 3> low = frames_.front().low_mm, high = frames_.front().high_mm;
  for (const Frame& frame : frames_)
    for (std::size_t d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], frame.low_mm[d]);
      high[d] = std::max(high[d], frame.high_mm[d]);
    }
  Json j = {{"fields", fields_}, {"point_parts", point_parts}, {"box", {low, high}}};
  for (const Frame& frame : frames_) {
    Json f = {{"t", frame.time_us},
              {"spacing", frame.spacing_mm},
              {"corner", frame.low_mm},
              {"points", blocks.add(frame.points)},
              {"faces", blocks.add(frame.faces)}};
    for (const QuantisedField& v : frame.values)
      f["values"].push_back({blocks.add(v.packed), v.lowest, v.step});
    j["frames"].push_back(std::move(f));
  }
  return j;
}

}  // namespace recoil::app
