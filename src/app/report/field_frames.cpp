#include "app/report/field_frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "config/geometry.hpp"
#include "core/error.hpp"
#include "format/packed.hpp"
#include "picture/outline.hpp"
#include "picture/raster.hpp"

namespace recoil::app {

namespace {

constexpr int fine_bits = 12, coarse_bits = 8;
constexpr std::size_t most_frames = 240;
constexpr double outline_parts = 64;  // of a cell, in which outlines are stored
constexpr double tail = 0.005;        // part of the values at either end that colours need not show

/// Fields of whole numbers.
bool has_categories(const FieldScalar& s) {
  return s.name == "body" || s.name == "contact" || s.name == "contact-state" || s.name == "fragment";
}

/// Curves as whole numbers: body, whether closed, number of points, all x, all y.
std::string packed_outlines(const std::vector<PlaneArray>& level_sets) {
  std::vector<std::int32_t> all;
  for (std::size_t m = 0; m < level_sets.size(); ++m) {
    const PlaneArray& a = level_sets[m];
    for (const Outline& line : zero_outlines(a)) {
      all.insert(all.end(), {static_cast<std::int32_t>(m), line.closed ? 1 : 0,
                             static_cast<std::int32_t>(line.points.size())});
      for (const auto& p : line.points)
        all.push_back(static_cast<std::int32_t>(std::lround((p.x - a.x0) / a.dx * outline_parts)));
      for (const auto& p : line.points)
        all.push_back(static_cast<std::int32_t>(std::lround((p.y - a.y0) / a.dy * outline_parts)));
    }
  }
  return packed_integers(all);
}

std::string colour_text(Rgb c) { return fmt::format("#{:02x}{:02x}{:02x}", c.r, c.g, c.b); }

std::vector<double> finite_values(const std::vector<double>& values) {
  std::vector<double> finite;
  for (const double v : values)
    if (std::isfinite(v)) finite.push_back(v);
  return finite;
}

}  // namespace

QuantisedField quantised(const std::vector<double>& values, int bits, bool exact) {
  const std::vector<double> finite = finite_values(values);
  QuantisedField q;
  if (!finite.empty()) {
    const auto [least, most] = std::ranges::minmax(finite);
    q.lowest = least;
    q.step = exact ? 1 : (most - least) / ((1 << bits) - 2);
  }
  std::vector<std::int32_t> codes;
  codes.reserve(values.size());
  for (const double v : values) {
    const double n = q.step > 0 ? std::round((v - q.lowest) / q.step) : 0;
    codes.push_back(std::isfinite(v) ? 1 + static_cast<std::int32_t>(n) : 0);
  }
  q.packed = packed_integers(codes);
  return q;
}

std::size_t FieldFrames::Frame::size() const {
  std::size_t n = outlines.size() + 40 * values.size();  // with the places in the JSON
  for (const QuantisedField& v : values) n += v.packed.size();
  return n;
}

FieldFrames::FieldFrames(const RunDumps& found, const LoadedCase& loaded, double most)
    : units_(run_units(loaded.contents.domain.geometry)), round_off_(round_off_of(loaded)) {
  const std::vector<ChosenDump>& dumps = found.whole;
  if (dumps.empty()) return;
  whole_ = dumps.size();
  dumps_ = whole_ + found.damaged.size();
  add_planes(loaded.contents);
  choose_detail(dumps, most);
  const std::size_t every = 1 + (dumps.size() - 1) / most_frames;
  for (std::size_t k = 0; k < dumps.size(); ++k)
    if (k % every == 0 || k + 1 == dumps.size()) add_dump(dumps[k]);
  thin_out(most);
}

void FieldFrames::add_planes(const config::Case& c) {
  const std::vector<std::string> axes = config::axes_of(c.domain.geometry);
  if (axes.size() < 3) {
    planes_.push_back(
        {{{"name", fmt::format("{}", axes.size() == 1 ? "along x" : "plane")}, {"axes", axes}}, {}, {}});
    return;
  }
  for (const std::size_t across : {1U, 0U, 2U}) {
    Plane plane;
    plane.cut = middle_cut(c.domain, across);
    std::vector<std::string> others = axes;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(across));
    plane.head = {{"name", fmt::format("{} = {:.4g} mm", axes[across], 1e3 * plane.cut.place)},
                  {"axes", others}};
    planes_.push_back(std::move(plane));
  }
}

/// From the dump in the middle.
void FieldFrames::choose_detail(const std::vector<ChosenDump>& dumps, double most) {
  add_dump(dumps[dumps.size() / 2]);
  const double all = static_cast<double>(size() * std::min(dumps.size(), most_frames));
  if (all > most) bits_ = coarse_bits;
  for (Plane& plane : planes_) plane.frames.clear();
  extremes_.clear();
}

void FieldFrames::choose_scalars(const UnstructuredGrid& grid) {
  scalars_ = scalars_of(grid, units_);
  for (const FieldScalar& s : scalars_) {
    const std::string vector = s.name.substr(0, s.name.find('.'));
    if (vector == "velocity" && s.name != vector && magnitudes_.empty())
      magnitudes_.push_back(find_scalar(vector, units_));
  }
  for (BodyField& body : bodies_of(grid)) bodies_.push_back(std::move(body.name));
}

void FieldFrames::add_dump(const ChosenDump& chosen) {
  const VtkhdfFile dump = read_vtkhdf(chosen.path);
  if (scalars_.empty()) choose_scalars(dump.grid);
  for (Plane& plane : planes_) plane.frames.push_back(frame_of(dump, plane.cut));
}

FieldFrames::Frame FieldFrames::frame_of(const VtkhdfFile& dump, const Cut& cut) {
  const Raster raster(dump.grid, cut);
  Frame frame;
  for (const FieldScalar& s : scalars_) {
    std::vector<double> values = raster.of(values_of(dump.grid, s)).values;
    if (s.name == "body")
      for (double& v : values) v = v < 0 ? std::numeric_limits<double>::quiet_NaN() : v;
    note(s, values);
    frame.values.push_back(quantised(values, bits_, has_categories(s)));
  }
  for (const FieldScalar& s : magnitudes_) note(s, raster.of(values_of(dump.grid, s)).values);
  std::vector<PlaneArray> level_sets;
  for (const BodyField& body : bodies_of(dump.grid)) level_sets.push_back(raster.of(body.level_set));
  frame.outlines = packed_outlines(level_sets);
  const PlaneArray a = level_sets.empty() ? PlaneArray{} : level_sets.front();
  frame.head = {{"t", dump.time_s * 1e6}, {"nx", a.nx},       {"ny", a.ny},      {"x", a.x0 * 1e3},
                {"y", a.y0 * 1e3},        {"dx", a.dx * 1e3}, {"dy", a.dy * 1e3}};
  return frame;
}

void FieldFrames::note(const FieldScalar& scalar, const std::vector<double>& values) {
  std::vector<double> finite = finite_values(values);
  if (finite.empty()) return;
  Extremes& e = extremes_[scalar.name];
  if (has_categories(scalar)) e.values.insert(finite.begin(), finite.end());
  const auto [least, most] = std::ranges::minmax(finite);
  e.lowest = std::min(e.lowest, least), e.highest = std::max(e.highest, most);
  const auto out = static_cast<std::ptrdiff_t>(tail * static_cast<double>(finite.size()));
  std::ranges::nth_element(finite, finite.begin() + out);
  e.low = std::min(e.low, finite[static_cast<std::size_t>(out)]);
  std::ranges::nth_element(finite, finite.end() - 1 - out);
  e.high = std::max(e.high, *(finite.end() - 1 - out));
}

std::size_t FieldFrames::size() const {
  std::size_t n = 0;
  for (const Plane& plane : planes_)
    for (const Frame& f : plane.frames) n += f.size();
  return n;
}

/// Leaves out frames, evenly over the run but never the last one.
void FieldFrames::thin_out(double most) {
  const double part = static_cast<double>(size()) / std::max(most, 1.0);
  if (!(part > 1)) return;
  const auto every = static_cast<std::size_t>(std::ceil(std::min(part, 1e6)));
  for (Plane& plane : planes_) {
    std::vector<Frame> kept;
    for (std::size_t k = 0; k < plane.frames.size(); ++k)
      if ((plane.frames.size() - 1 - k) % every == 0) kept.push_back(std::move(plane.frames[k]));
    plane.frames = std::move(kept);
  }
}

Json FieldFrames::variable(const FieldScalar& s) const {
  const auto found = extremes_.find(s.name);
  const Extremes e = found == extremes_.end() ? Extremes{} : found->second;
  Json j = {{"name", s.name},
            {"label", s.name == "contact-state" ? "contact" : s.label},
            {"signed", s.signed_values},
            {"round_off", round_off_.in(unit_in(s.label))},
            {"range", {number(e.lowest), number(e.highest)}},
            {"typical", {number(e.low), number(e.high)}}};
  for (const Category& c : categories_of(s.name, bodies_, e.values))
    j["categories"].push_back({{"value", c.value}, {"name", c.name}, {"colour", colour_text(c.colour)}});
  return j;
}

Json FieldFrames::write(Blocks& blocks) const {
  if (planes_.empty() || planes_.front().frames.empty()) return nullptr;
  Json j = {{"bits", bits_},
            {"dumps", dumps_},
            {"omission", omission()},
            {"bodies", bodies_},
            {"outline_parts", outline_parts}};
  for (const FieldScalar& s : scalars_) j["variables"].push_back(variable(s));
  for (const FieldScalar& m : magnitudes_) {
    j["variables"].push_back(variable(m));
    for (const FieldScalar& s : scalars_)
      if (s.name.starts_with(m.name + ".")) j["variables"].back()["parts"].push_back(s.name);
  }
  for (const Plane& plane : planes_) {
    Json one = plane.head;
    for (const Frame& frame : plane.frames) {
      Json f = frame.head;
      f["outlines"] = blocks.add(frame.outlines);
      for (const QuantisedField& v : frame.values)
        f["values"].push_back({blocks.add(v.packed), v.lowest, v.step});
      one["frames"].push_back(std::move(f));
    }
    j["planes"].push_back(std::move(one));
  }
  return j;
}

std::string FieldFrames::omission() const {
  return shown() < dumps_ ? fmt::format("{} of {} dumps of the fields", shown(), dumps_) : "";
}

}  // namespace recoil::app
