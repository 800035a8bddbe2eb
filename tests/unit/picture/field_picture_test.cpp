#include "picture/field_picture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

#include "core/error.hpp"
#include "picture/frame.hpp"

namespace recoil::field_picture_test {
namespace {

bool near(Rgb a, Rgb b) {
  return std::abs(a.r - b.r) < 6 && std::abs(a.g - b.g) < 6 && std::abs(a.b - b.b) < 6;
}

int count(const Image& image, Rgb colour) {
  int n = 0;
  for (int j = 0; j < image.height; ++j)
    for (int i = 0; i < image.width; ++i) n += near(image.at(i, j), colour);
  return n;
}

/// A disc of matter of radius 3 mm in a field of nx x ny cells of 0.1 mm, its middle at (cx, cy) mm.
FieldPicture disc(int nx, int ny, double cx, double cy) {
  FieldPicture p;
  p.nx = nx, p.ny = ny, p.dx = p.dy = 1e-4;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const double phi = std::hypot((i + 0.5) * 0.1 - cx, (j + 0.5) * 0.1 - cy) - 3;
      p.level_set.push_back(phi);
      p.values.push_back(phi < 0 ? 1.0 : std::numeric_limits<double>::quiet_NaN());
    }
  p.range = {0.0, 2.0};
  return p;
}

Rgb middle_colour() {
  static const Rgb colour = colour_at(colour_table(ColourMap::sequential, 1024), 0.5);
  return colour;
}

/// Where the matter is in the picture.
PixelRect extent(const Image& image) {
  PixelRect r{1e9, 1e9, -1, -1};
  for (int j = 0; j < image.height; ++j)
    for (int i = 0; i < image.width * 3 / 4; ++i)  // without the colour bar
      if (near(image.at(i, j), middle_colour()))
        r = {std::min(r.x0, 1.0 * i), std::min(r.y0, 1.0 * j), std::max(r.x1, i + 1.0),
             std::max(r.y1, j + 1.0)};
  return r;
}

TEST(FieldPicture, DiscIsRoundAndTheRestIsVoid) {
  for (const bool tall : {false, true}) {
    FieldPicture p = tall ? disc(80, 160, 4, 8) : disc(120, 80, 6, 4);
    const Image image = rendered(field_picture(p));
    const PixelRect r = extent(image);
    EXPECT_NEAR((r.x1 - r.x0) / (r.y1 - r.y0), 1, 0.02);
    EXPECT_GT(count(image, kPictureStyle.void_space), 20000);
    EXPECT_LE(image.width, p.max_width);
    EXPECT_LE(image.height, p.max_height);
  }
}

TEST(FieldPicture, LevelSetGivesTheAreaBetterThanCells) {
  FieldPicture p = disc(20, 20, 1, 1);  // 2 mm x 2 mm, then a disc of 0.6 mm: 6 cells across the radius
  p.values.clear(), p.level_set.clear();
  for (int j = 0; j < 20; ++j)
    for (int i = 0; i < 20; ++i) {
      const double phi = std::hypot((i + 0.5) * 0.1 - 1, (j + 0.5) * 0.1 - 1) - 0.6;
      p.level_set.push_back(phi);
      p.values.push_back(phi < 0 ? 1.0 : std::numeric_limits<double>::quiet_NaN());
    }
  const Image image = rendered(field_picture(p));
  const PixelRect r = extent(image);
  int inside = 0;
  for (int j = static_cast<int>(r.y0); j < static_cast<int>(r.y1); ++j)
    for (int i = static_cast<int>(r.x0); i < static_cast<int>(r.x1); ++i)
      inside += near(image.at(i, j), middle_colour());
  const double radius = 0.5 * (r.x1 - r.x0);
  EXPECT_NEAR(inside / (radius * radius), 3.1416, 0.05);
}

/// Pixels that are neither of the page nor empty matter, in the rows of the heading.
int heading_pixels(const Image& image, int x0, int x1) {
  int n = 0;
  for (int j = 0; j < 60; ++j)
    for (int i = std::max(0, x0); i < std::min(image.width, x1); ++i) n += image.at(i, j).r < 140;
  return n;
}

/// A rod of 2 x 100 mm: the title has the width of the picture, and the time a line of its own.
TEST(FieldPicture, NarrowFieldHasAHeading) {
  FieldPicture p;
  p.nx = 20, p.ny = 1000, p.dx = p.dy = 1e-4;
  p.values.assign(20000, 1.0);
  p.label = "pressure [GPa]";
  const Image bare = rendered(field_picture(p));
  EXPECT_GE(bare.width, 480);
  p.title = "A rod of copper on a wall that moves";
  p.note = "at 12.5 us";
  const Image image = rendered(field_picture(p));
  EXPECT_EQ(image.width, bare.width);
  EXPECT_GT(heading_pixels(image, image.width / 2, image.width - 14), 100) << "the end of the title";
  EXPECT_EQ(heading_pixels(image, image.width - 14, image.width), 0);
  EXPECT_EQ(heading_pixels(image, 0, 12), 0);
}

TEST(FieldPicture, MirrorShowsBothHalves) {
  FieldPicture p = disc(80, 80, 0, 4);
  p.mirror = true;
  const PixelRect r = extent(rendered(field_picture(p)));
  EXPECT_NEAR((r.x1 - r.x0) / (r.y1 - r.y0), 1, 0.02);
}

/// Cells that begin 4 mm from the axis: two discs of 6 mm with 10 mm between them.
TEST(FieldPicture, MirrorLeavesRoomBesideTheAxis) {
  FieldPicture p = disc(80, 80, 4, 4);
  p.mirror = true;
  p.x0 = 4e-3;
  const Image image = rendered(field_picture(p));
  std::vector<int> widest{0, 0, 0, 0};  // where matter begins and ends along a row
  for (int j = 0; j < image.height; ++j) {
    std::vector<int> borders;
    for (int i = 1; i < image.width; ++i)
      if (near(image.at(i, j), middle_colour()) != near(image.at(i - 1, j), middle_colour()))
        borders.push_back(i);
    if (borders.size() == 4 && borders[1] - borders[0] > widest[1] - widest[0]) widest = borders;
  }
  const double across = widest[1] - widest[0];
  ASSERT_GT(across, 50);
  EXPECT_NEAR((widest[2] - widest[1]) / across, 10.0 / 6, 0.02);
  EXPECT_NEAR((widest[3] - widest[2]) / across, 1, 0.02);
}

TEST(FieldPicture, CellsLieWhereTheyShould) {
  FieldPicture p;
  p.nx = p.ny = 2, p.dx = p.dy = 1;
  p.values = {0, 1, 2, 3};  // lower left, lower right, upper left, upper right
  const Image image = rendered(field_picture(p));
  const auto table = colour_table(ColourMap::sequential, 1024);
  const int x0 = 120, x1 = 700, low = image.height - 200, high = 200;
  EXPECT_TRUE(near(image.at(x0, low), colour_at(table, 0)));
  EXPECT_TRUE(near(image.at(x1, low), colour_at(table, 1.0 / 3)));
  EXPECT_TRUE(near(image.at(x0, high), colour_at(table, 2.0 / 3)));
  EXPECT_TRUE(near(image.at(x1, high), colour_at(table, 1)));
}

TEST(FieldPicture, ZeroIsPaleInSignedFields) {
  FieldPicture p;
  p.nx = 3, p.ny = 1, p.dx = p.dy = 1;
  p.map = ColourMap::diverging;
  p.values = {-1, 0, 4};
  const Image image = rendered(field_picture(p));
  const Rgb pale = colour_at(colour_table(ColourMap::diverging, 1024), 0.5);
  EXPECT_TRUE(near(image.at(image.width / 2, 150), pale));
}

TEST(FieldPicture, OutlinesAreDark) {
  FieldPicture p = disc(80, 80, 4, 4);
  const Rgb dark{24, 26, 30};
  const int before = count(rendered(field_picture(p)), dark);
  p.outlines = zero_outlines({p.nx, p.ny, p.x0, p.y0, p.dx, p.dy, p.level_set});
  EXPECT_GT(count(rendered(field_picture(p)), dark), before + 500);
}

TEST(FieldPicture, TimeDiagramFillsThePicture) {
  FieldPicture p;
  p.nx = 10, p.ny = 1000, p.dx = 1e-3, p.dy = 1e-8;
  p.values.assign(10000, 1.0);
  p.equal_aspect = false;
  p.y_scale = 1e6;
  const Image image = rendered(field_picture(p));
  EXPECT_NEAR(image.width, p.max_width, 40);
  EXPECT_NEAR(image.height, p.max_height, 40);
}

TEST(FieldPicture, CategoriesHaveTheirColoursAndNames) {
  FieldPicture p;
  p.nx = 2, p.ny = 1, p.dx = p.dy = 1;
  p.values = {3, 7};
  const Rgb red{200, 30, 30}, green{30, 160, 60}, blue{30, 30, 200};
  p.categories = {{3, "flyer", red}, {7, "target", green}, {9, "anvil", blue}};
  const Image image = rendered(field_picture(p));
  EXPECT_GT(count(image, red), 10000);
  EXPECT_GT(count(image, green), 10000);
  EXPECT_NEAR(count(image, blue), 18 * 18, 60) << "only in the legend";
}

TEST(FieldPicture, ValuesBeyondTheRangePointTheBar) {
  FieldPicture p;
  p.nx = 2, p.ny = 2, p.dx = p.dy = 1;
  p.values = {0, 1, 2, 3};
  p.range = {{0.0, 3.0}};
  const auto top_of_the_bar = [&] {  // pixels of its yellow
    const Image image = rendered(field_picture(p));
    int n = 0;
    for (int i = image.width - 120; i < image.width; ++i)
      n += image.at(i, 28).r > 200 && image.at(i, 28).b < 160;
    return n;
  };
  const int whole = top_of_the_bar();
  EXPECT_GT(whole, 15);
  p.range = {{0.0, 2.5}};
  const int tip = top_of_the_bar();
  EXPECT_GT(tip, 0);
  EXPECT_LT(tip, whole / 2);
}

TEST(FieldPicture, LogarithmicColoursAreEvenInDecades) {
  FieldPicture p;
  p.nx = 3, p.ny = 1, p.dx = p.dy = 1;
  p.values = {1, 10, 100};
  p.log = true;
  const Image image = rendered(field_picture(p));
  const Rgb middle = colour_at(colour_table(ColourMap::sequential, 1024), 0.5);
  EXPECT_TRUE(near(image.at(image.width / 2, 150), middle));
  p.values = {-1, 0, 0};
  EXPECT_EQ(field_picture(p).width(), image.width) << "nothing positive still makes a picture";
}

TEST(FieldPicture, EmptyFieldsAndWrongSizes) {
  FieldPicture p;
  p.nx = p.ny = 4, p.dx = p.dy = 1;
  p.values.assign(16, std::numeric_limits<double>::quiet_NaN());
  EXPECT_GT(count(rendered(field_picture(p)), kPictureStyle.void_space), 1000);
  p.values.pop_back();
  EXPECT_THROW(field_picture(p), InternalError);
}

}  // namespace
}  // namespace recoil::field_picture_test
