#include "picture/text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "picture/stroke_font.hpp"

namespace recoil {
namespace {

constexpr Rgb kWhite{255, 255, 255};

/// Smallest rectangle around everything that is not white.
PixelRect inked(const Image& image) {
  PixelRect r{1e9, 1e9, -1, -1};
  for (int j = 0; j < image.height; ++j)
    for (int i = 0; i < image.width; ++i)
      if (image.at(i, j).r < 200)
        r = {std::min(r.x0, 1.0 * i), std::min(r.y0, 1.0 * j), std::max(r.x1, i + 1.0),
             std::max(r.y1, j + 1.0)};
  return r;
}

TEST(StrokeFont, HasAllOfAsciiEachDrawnDifferently) {
  std::set<std::vector<unsigned char>> pictures;
  for (char c = ' '; c <= '~'; ++c) {
    ASSERT_TRUE(has_glyph(static_cast<char32_t>(c))) << c;
    Image image = make_image(60, 60, kWhite);
    draw_text(image, {10, 40}, std::string(1, c), {.size = 32});
    EXPECT_TRUE(pictures.insert(image.rgb).second) << "'" << c << "' looks like another character";
  }
}

TEST(StrokeFont, StrokesStayNearTheirBox) {
  for (char32_t c = U' '; c <= U'~'; ++c)
    for (const auto& stroke : glyph(c).strokes)
      for (const auto& p : stroke) {
        EXPECT_GE(p.x, -0.01) << static_cast<char>(c);
        EXPECT_LE(p.x, glyph(c).advance + 0.01) << static_cast<char>(c);
        EXPECT_GE(p.y, -0.25) << static_cast<char>(c);
        EXPECT_LE(p.y, 0.80) << static_cast<char>(c);
      }
}

TEST(Text, AnchorsPlaceIt) {
  const std::string text = "HHHHH";
  const double width = text_width(text, 30);
  Image left = make_image(300, 100, kWhite), right = left, centre = left;
  draw_text(left, {150, 50}, text, {.size = 30});
  draw_text(right, {150, 50}, text, {.size = 30, .horizontal = HorizontalAnchor::right});
  draw_text(centre, {150, 50}, text,
            {.size = 30, .horizontal = HorizontalAnchor::centre, .vertical = VerticalAnchor::middle});
  EXPECT_NEAR(inked(left).x0, 150, 5);
  EXPECT_NEAR(inked(left).y1, 50, 3);
  EXPECT_NEAR(inked(left).y0, 50 - 21, 3);
  EXPECT_NEAR(inked(left).x1, 150 + width, 5);
  EXPECT_NEAR(inked(right).x1, 150, 5);
  EXPECT_NEAR(0.5 * (inked(centre).x0 + inked(centre).x1), 150, 2);
  EXPECT_NEAR(0.5 * (inked(centre).y0 + inked(centre).y1), 50, 2);
}

TEST(Text, UpwardsIsTheSameTurned) {
  Image flat = make_image(200, 200, kWhite), turned = flat;
  draw_text(flat, {50, 100}, "pressure", {.size = 30});
  draw_text(turned, {100, 150}, "pressure", {.size = 30, .upwards = true});
  const PixelRect a = inked(flat), b = inked(turned);
  EXPECT_NEAR(b.y1 - b.y0, a.x1 - a.x0, 2);
  EXPECT_NEAR(b.x1 - b.x0, a.y1 - a.y0, 2);
  EXPECT_NEAR(b.x1 - 100, a.y1 - 100, 2) << "descenders point to the right";
}

TEST(Text, ReadsUtf8AndRaisesInBraces) {
  EXPECT_DOUBLE_EQ(text_width("µ", 20), text_width("u", 20));
  EXPECT_LT(text_width("10^{3}", 20), text_width("103", 20));
  EXPECT_TRUE(has_glyph(U'\u2212'));
  EXPECT_FALSE(has_glyph(U'\u4e00'));
  EXPECT_GT(text_width("\xff\xc3", 20), 0) << "broken bytes draw as boxes";
}

}  // namespace
}  // namespace recoil
