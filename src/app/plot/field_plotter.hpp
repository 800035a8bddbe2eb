#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/commands.hpp"
#include "app/plot/space_plotter.hpp"
#include "config/case.hpp"
#include "picture/canvas.hpp"
#include "picture/colour_map.hpp"
#include "picture/field_picture.hpp"
#include "picture/field_plane.hpp"
#include "picture/line_chart.hpp"

namespace recoil::app {

/// Size, heading and sharpness by the options.
void choose_look(FieldPicture& picture, const PlotOptions& options);

/// A part of the plane [m]; in 1d only x counts.
struct PlaneBox {
  double x0 = 0, x1 = 0, y0 = 0, y1 = 0;
};

/// Draws a field of a run's dumps as the options of `recoil plot` say: in the plane as colours with the
/// bodies' outlines or as a shaded view of space, in 1d or along a line as a curve.
class FieldPlotter {
 public:
  /// @throws InputError for a folder without a run, or options that do not suit it.
  explicit FieldPlotter(const PlotOptions& options);
  FieldPlotter(const FieldPlotter&) = delete;
  FieldPlotter& operator=(const FieldPlotter&) = delete;

  /// From now on all pictures show the same part of space in the same colours: what these dumps need
  /// together, unless the options say it.
  void hold_frame(const std::vector<ChosenDump>& dumps);

  /// @throws InputError for a dump without the field, or without matter along the line.
  Canvas draw(const ChosenDump& dump) const;

 private:
  FieldPlotter(const PlotOptions& options, const LoadedCase& run);
  FieldPlane whole_plane(const ChosenDump& dump) const;
  FieldPlane plane_of(const ChosenDump& dump) const;
  bool draws_curves() const { return is_line_ || !options_.along.empty(); }
  LineChart curve_in(const ChosenDump& dump, const std::string& note) const;
  Canvas picture_of(const FieldPlane& plane, const std::string& note) const;

  PlotOptions options_;
  config::Case case_;
  SpacePlane slice_;  // of a 3-D run
  bool is_line_ = false;
  std::optional<SpacePlotter> view_;  // in place of all that follows
  std::optional<PlaneBox> box_;       // that all pictures show; of a window in it only that
  std::vector<Category> categories_;
};

}  // namespace recoil::app
