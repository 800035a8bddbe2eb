#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "picture/canvas.hpp"

namespace recoil {

enum class LinePattern { solid, dashed, dotted, none };

/// How a series is drawn; without a colour it gets its own from the palette.
struct SeriesStyle {
  std::optional<Rgb> colour{};
  double width = 2.4;  ///< pixels
  LinePattern pattern = LinePattern::solid;
  bool markers = false;  ///< a dot at each point
};

/// The style of a predicted or measured curve that ours is compared with.
inline constexpr SeriesStyle kReferenceStyle{
    .colour = Rgb{58, 62, 70}, .width = 2.0, .pattern = LinePattern::dashed};

/// One curve. x and y have the same size; the curve breaks at NaN.
struct Series {
  std::string label;
  std::vector<double> x, y;
  SeriesStyle style{};
};

/// A thin line across the chart at one value (a predicted arrival, a yield stress).
struct Guide {
  double at = 0;
  std::string label;
  bool vertical = true;
};

/// A chart of curves. Values are in the units that the titles name.
struct LineChart {
  std::string title, note{};     ///< heading on the left, small remark on the right
  std::string x_title, y_title;  ///< with units: "time [µs]"
  std::vector<Series> series{};  ///< drawn in this order, later ones on top
  std::vector<Guide> guides{};
  std::optional<std::pair<double, double>> x_range{}, y_range{};
  bool log_x = false, log_y = false;
  int width = 1200, height = 800;
};

/// Draws the chart. The legend stands where it hides no curve, beside the plot if need be. @throws
/// InternalError where x and y of a series differ in size.
Canvas line_chart(const LineChart& chart);

}  // namespace recoil
