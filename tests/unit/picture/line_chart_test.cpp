#include "picture/line_chart.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "core/error.hpp"

namespace recoil::line_chart_test {
namespace {

constexpr Rgb kMagenta{255, 0, 255};

/// Pixels of about that colour inside [x0, x1) x [y0, y1).
int count(const Image& image, Rgb colour, int x0, int y0, int x1, int y1) {
  int n = 0;
  for (int j = y0; j < y1; ++j)
    for (int i = x0; i < x1; ++i) {
      const Rgb c = image.at(i, j);
      n += std::abs(c.r - colour.r) < 12 && std::abs(c.g - colour.g) < 12 && std::abs(c.b - colour.b) < 12;
    }
  return n;
}
int count(const Image& image, Rgb colour) { return count(image, colour, 0, 0, image.width, image.height); }

LineChart rising() {
  LineChart chart;
  chart.title = "Rear surface";
  chart.x_title = "time [µs]";
  chart.y_title = "velocity [m/s]";
  chart.series = {{"", {0, 1, 2}, {0, 50, 100}, {.colour = kMagenta}}};
  return chart;
}

TEST(LineChart, CurveRunsFromLowerLeftToUpperRight) {
  const Image image = rendered(line_chart(rising()));
  ASSERT_EQ(image.width, 1200);
  ASSERT_EQ(image.height, 800);
  EXPECT_GT(count(image, kMagenta, 0, 400, 600, 800), 300);
  EXPECT_GT(count(image, kMagenta, 600, 0, 1200, 400), 300);
  EXPECT_EQ(count(image, kMagenta, 0, 0, 500, 300), 0);
  EXPECT_EQ(count(image, kMagenta, 700, 500, 1200, 800), 0);
}

TEST(LineChart, MarginsAreWhiteButForText) {
  const Image image = rendered(line_chart(rising()));
  const Rgb white{255, 255, 255};
  EXPECT_EQ(count(image, white, 0, 0, 1200, 8), 1200 * 8);
  EXPECT_EQ(count(image, white, 0, 0, 10, 800), 10 * 800);
  EXPECT_EQ(count(image, white, 1192, 0, 1200, 800), 8 * 800);
  EXPECT_EQ(count(image, white, 0, 794, 1200, 800), 1200 * 6);
}

TEST(LineChart, TitlesAndLegendAreDrawn) {
  LineChart bare = rising();
  bare.title = bare.x_title = bare.y_title = "";
  LineChart named = rising();
  named.series[0].label = "recoil";
  const Rgb ink{32, 34, 38};
  const int without = count(rendered(line_chart(bare)), ink),
            with = count(rendered(line_chart(rising())), ink);
  EXPECT_GT(with, without + 200);
  EXPECT_GT(count(rendered(line_chart(named)), ink), with + 20);
  EXPECT_GT(count(rendered(line_chart(named)), kMagenta),
            count(rendered(line_chart(rising())), kMagenta) + 50);
}

TEST(LineChart, LegendHidesNoCurveWhereThereIsRoom) {
  LineChart chart = rising();
  const int before = count(rendered(line_chart(chart)), kMagenta);
  chart.series.push_back({"another curve with a long name", {}, {}, {}});
  EXPECT_EQ(count(rendered(line_chart(chart)), kMagenta), before);
}

TEST(LineChart, LegendStandsBesideAPlotThatIsFull) {
  LineChart chart = rising();
  chart.series.clear();
  for (int k = 0; k < 40; ++k)  // no gap anywhere
    chart.series.push_back({k == 0 ? "wave" : "", {0, 1}, {1.0 * k, 1.0 * k}, {.colour = kMagenta}});
  const Image image = rendered(line_chart(chart));
  EXPECT_EQ(count(image, kMagenta, 1060, 140, 1200, 800), 0) << "the plot ends before the legend";
  EXPECT_GT(count(image, kMagenta, 1060, 0, 1200, 140), 20) << "the sample in the legend";
}

TEST(LineChart, DashedReferenceHasGaps) {
  LineChart chart = rising();
  const int solid = count(rendered(line_chart(chart)), kMagenta);
  chart.series[0].style.pattern = LinePattern::dashed;
  const int dashed = count(rendered(line_chart(chart)), kMagenta);
  EXPECT_GT(dashed, solid / 3);
  EXPECT_LT(dashed, 4 * solid / 5);
}

TEST(LineChart, RangeAndGuidesAreObeyed) {
  LineChart chart = rising();
  chart.x_range = {0.0, 20.0};
  EXPECT_EQ(count(rendered(line_chart(chart)), kMagenta, 400, 0, 1200, 800), 0)
      << "the curve ends at a tenth of the width";
  const auto dark = [](const Image& image) {  // of the part of the plot where the curve is not
    int n = 0;
    for (int j = 100; j < 700; ++j)
      for (int i = 400; i < 1150; ++i) n += image.at(i, j).r < 190;
    return n;
  };
  EXPECT_EQ(dark(rendered(line_chart(chart))), 0);
  chart.guides = {{10, "arrival", true}};
  const int one = dark(rendered(line_chart(chart)));
  EXPECT_GT(one, 250);
  chart.guides.push_back({20, "limit", false});
  EXPECT_GT(dark(rendered(line_chart(chart))), one + 250);
}

/// A label in the corner that the legend would take first, as a curve takes the other end of the guide.
TEST(LineChart, LegendHidesNoLabelOfAGuide) {
  LineChart chart = rising();
  chart.series = {{"", {0, 0.1, 0.2, 0.3, 0.4, 1}, {0.85, 1, 0.85, 1, 0, 0}, {.colour = kMagenta}}};
  chart.y_range = {0.0, 1.0};
  chart.guides = {{0.93, "a guide with a label that is long", false}};
  const Rgb soft{96, 100, 108};
  const auto label_pixels = [&] {
    const Image image = rendered(line_chart(chart));
    return count(image, soft, 850, 0, image.width, 160);
  };
  const int bare = label_pixels();
  ASSERT_GT(bare, 50);
  for (const char* name : {"on the right", "on the left"}) chart.series.push_back({name, {}, {}, {}});
  EXPECT_EQ(label_pixels(), bare);
}

TEST(LineChart, OddDataStillMakeAPicture) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  LineChart chart;
  EXPECT_EQ(line_chart(chart).width(), 1200);
  chart.series = {
      {"a", {}, {}, {}}, {"b", {1}, {nan}, {}}, {"c", {1, 2, nan}, {inf, 3, 3}, {.markers = true}}};
  EXPECT_EQ(line_chart(chart).height(), 800);
  chart.log_x = chart.log_y = true;
  chart.series.push_back({"d", {-1, 0, 1e-8, 1e8}, {0, -5, 1e-30, 1e30}, {}});
  EXPECT_EQ(line_chart(chart).height(), 800);
  chart.series.push_back({"e", {1}, {}, {}});
  EXPECT_THROW(line_chart(chart), InternalError);
}

}  // namespace
}  // namespace recoil::line_chart_test
