#include "picture/text.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace recoil::text_test {
namespace {

constexpr Rgb kWhite{255, 255, 255};

/// Smallest rectangle around everything that is not white.
PixelRect inked(const Canvas& canvas) {
  const Image image = rendered(canvas);
  PixelRect r{1e9, 1e9, -1, -1};
  for (int j = 0; j < image.height; ++j)
    for (int i = 0; i < image.width; ++i)
      if (image.at(i, j).r < 200)
        r = {std::min(r.x0, 1.0 * i), std::min(r.y0, 1.0 * j), std::max(r.x1, i + 1.0),
             std::max(r.y1, j + 1.0)};
  return r;
}

TEST(Text, AnchorsPlaceIt) {
  const std::string text = "HHHHH";
  const double width = text_width(text, 30);
  Canvas left(300, 100, kWhite), right(300, 100, kWhite), centre(300, 100, kWhite);
  draw_text(left, {150, 50}, text, {.size = 30});
  draw_text(right, {150, 50}, text, {.size = 30, .horizontal = HorizontalAnchor::right});
  draw_text(centre, {150, 50}, text,
            {.size = 30, .horizontal = HorizontalAnchor::centre, .vertical = VerticalAnchor::middle});
  EXPECT_NEAR(inked(left).x0, 150, 5);
  EXPECT_NEAR(inked(left).y1, 50, 1);
  EXPECT_NEAR(inked(left).y0, 50 - 30 * kCapitalHeight, 1);
  EXPECT_NEAR(inked(left).x1, 150 + width, 5);
  EXPECT_NEAR(inked(right).x1, 150, 5);
  EXPECT_NEAR(0.5 * (inked(centre).x0 + inked(centre).x1), 150, 2);
  EXPECT_NEAR(0.5 * (inked(centre).y0 + inked(centre).y1), 50, 2);
}

TEST(Text, UpwardsIsTheSameTurned) {
  Canvas flat(200, 200, kWhite), turned(200, 200, kWhite);
  draw_text(flat, {50, 100}, "pressure", {.size = 30});
  draw_text(turned, {100, 150}, "pressure", {.size = 30, .upwards = true});
  const PixelRect a = inked(flat), b = inked(turned);
  EXPECT_NEAR(b.y1 - b.y0, a.x1 - a.x0, 2);
  EXPECT_NEAR(b.x1 - b.x0, a.y1 - a.y0, 2);
  EXPECT_NEAR(b.x1 - 100, a.y1 - 100, 2) << "descenders point to the right";
}

TEST(Text, LeavesNothingToTheNextShape) {
  Canvas canvas(100, 100, kWhite), bare(100, 100, kWhite);
  draw_text(canvas, {5, 95}, "a", {.size = 12, .colour = kWhite});
  for (Canvas* c : {&canvas, &bare}) {
    fill_polygon(*c, {{60, 10}, {80, 10}, {80, 30}}, {0, 0, 0});
    fill_circle(*c, {70, 60}, 8, {0, 0, 0}, c->bounds());
  }
  EXPECT_TRUE(rendered(canvas).rgb == rendered(bare).rgb);
}

TEST(Text, RaisesInBraces) {
  EXPECT_LT(text_width("10^{3}", 20), text_width("103", 20));
  EXPECT_GT(text_width("10^{3}", 20), text_width("10", 20));
  Canvas flat(100, 100, kWhite), raised(100, 100, kWhite);
  draw_text(flat, {20, 60}, "5", {.size = 40});
  draw_text(raised, {20, 60}, "^{5}", {.size = 40});
  EXPECT_LT(inked(raised).y0, inked(flat).y0) << "higher";
  EXPECT_LT(inked(raised).y1, inked(flat).y1 - 8);
}

TEST(Text, BrokenBytesAreReplaced) {
  const double one = text_width("\ufffd", 20);
  for (const char* bytes : {"\xff", "\x80", "\xc0"}) EXPECT_DOUBLE_EQ(text_width(bytes, 20), one);
  EXPECT_DOUBLE_EQ(text_width("\xff\xc3", 20), 2 * one);
  EXPECT_DOUBLE_EQ(text_width("\xed\xa0\x80", 20), 3 * one) << "a surrogate";
  Canvas canvas(100, 100, kWhite);
  draw_text(canvas, {10, 50}, "\xff", {.size = 30});
  EXPECT_NO_THROW(rendered(canvas));
}

RC_GTEST_PROP(TextOfAnyBytes, IsDrawnAndIsAsWideAsItsParts, ()) {
  const auto bytes = *rc::gen::container<std::string>(rc::gen::arbitrary<char>());
  const double width = text_width(bytes, 20);
  RC_ASSERT(std::isfinite(width) && width >= 0);
  RC_ASSERT(std::abs(text_width(bytes + " " + bytes, 20) - 2 * width - text_width(" ", 20)) <
                1e-6 * (1 + width) ||
            bytes.find('{') != std::string::npos);
  Canvas canvas(50, 50, kWhite);
  draw_text(canvas, {10, 30}, bytes, {.size = 20});
  rendered(canvas);
}

/// A heading that is too long ends in an ellipsis, before what stands at the right of it.
TEST(Text, ShortenedToItsRoom) {
  const std::string title =
      "A plate strikes a parallel inclined plate, 30 \u00b0 to the mesh: copper on tungsten";
  for (const double room : {60.0, 150.0, 300.0, 450.0}) {
    const std::string shorter = shortened_text(title, room, 14, true);
    EXPECT_LE(text_width(shorter, 14, true), room);
    EXPECT_TRUE(shorter.ends_with("\u2026")) << shorter;
    EXPECT_TRUE(title.starts_with(shorter.substr(0, shorter.size() - 3))) << shorter;
  }
  EXPECT_EQ(shortened_text(title, 2000, 14, true), title);
}

}  // namespace
}  // namespace recoil::text_test
