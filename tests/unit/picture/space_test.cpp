#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "picture/space/cell_lookup.hpp"
#include "picture/space/space_picture.hpp"
#include "picture/space/view.hpp"

namespace recoil::space_test {
namespace {

/// A ball of radius 1 about the origin, known in x > 0 only; the field is x + 2 y.
class Ball : public Scene {
 public:
  SpaceBox box() const override { return {{{0, -2, -2}}, {{2, 2, 2}}}; }
  double cell() const override { return 0.1; }
  double distance(const Vec<3>& x) const override { return norm(x) - 1; }
  int body(const Vec<3>& /*x*/) const override { return 0; }
  double value(const Vec<3>& x, int /*body*/) const override { return x[0] + 2 * x[1]; }
};

/// A view along -x, y to the right, from x = 3.
const View along_x = View::from(0, 0, 2);
const Screen screen{20, 20, 0.2, {{3, -2, 2}}};

const Hit& at(const std::vector<Hit>& hits, int i, int j) {
  return hits[static_cast<std::size_t>(i + 20 * j)];
}

TEST(View, AnglesTurnTheViewerAboutTheAxisThatPointsUp) {
  const View v = View::from(-90 * std::numbers::pi / 180, 30 * std::numbers::pi / 180, 2);
  EXPECT_NEAR(norm(v.forward - Vec<3>{{0, std::sqrt(0.75), -0.5}}), 0, 1e-12);
  EXPECT_NEAR(norm(v.right - Vec<3>{{1, 0, 0}}), 0, 1e-12);
  EXPECT_NEAR(norm(v.up - Vec<3>{{0, 0.5, std::sqrt(0.75)}}), 0, 1e-12);
  const View x_up = View::from(0, 0, 0);
  EXPECT_NEAR(norm(x_up.up - Vec<3>{{1, 0, 0}}), 0, 1e-12);
  EXPECT_NEAR(norm(x_up.forward - Vec<3>{{0, -1, 0}}), 0, 1e-12);
}

TEST(View, RaysMeetTheNearestSurfaceWithItsNormal) {
  const auto hits = cast_rays(Ball(), along_x, screen, std::nullopt);
  int met = 0;
  for (int j = 0; j < 20; ++j)
    for (int i = 0; i < 20; ++i) {
      const double y = -2 + 0.2 * (i + 0.5), z = 2 - 0.2 * (j + 0.5), r = std::hypot(y, z);
      met += at(hits, i, j).any() ? 1 : 0;
      if (std::abs(r - 1) > 0.15) {
        EXPECT_EQ(at(hits, i, j).any(), r < 1) << y << ' ' << z;
      }
    }
  EXPECT_NEAR(met * 0.04, std::numbers::pi, 0.3);
  const Hit& middle = at(hits, 10, 9);
  EXPECT_NEAR(middle.depth, 2, 0.05);
  EXPECT_FALSE(middle.face);
  EXPECT_GT(middle.normal[0], 0.95);
  EXPECT_NEAR(middle.value, 0.95 + 0.2, 0.25) << "half a cell below the surface";
}

TEST(View, ACutShowsTheFieldOnItsFace) {
  const auto hits = cast_rays(Ball(), along_x, screen, SpacePlane{{{1, 0, 0}}, 0.5});
  const Hit& middle = at(hits, 10, 10);
  EXPECT_TRUE(middle.face);
  EXPECT_NEAR(middle.depth, 2.5, 1e-6);
  EXPECT_NEAR(middle.value, 0.5 + 2 * 0.1, 0.21);
  EXPECT_NEAR(middle.normal[0], 1, 1e-12);
}

TEST(View, BodiesEndAtTheBoxUnlessTheyAreMirrored) {
  const View from_behind = View::from(std::numbers::pi, 0, 2);
  const Screen behind{20, 20, 0.2, {{-3, 2, 2}}};
  EXPECT_TRUE(at(cast_rays(Ball(), from_behind, behind, std::nullopt), 10, 10).face);
  const Ball ball;
  const MirroredScene whole(ball, {true, false, false}, {false, false, false});
  EXPECT_EQ(whole.box().lo[0], -2);
  const auto hits = cast_rays(whole, from_behind, behind, std::nullopt);
  const Hit& middle = at(hits, 10, 10);
  EXPECT_FALSE(middle.face);
  EXPECT_NEAR(middle.depth, 2, 0.05);
  EXPECT_LT(middle.normal[0], -0.95);
}

TEST(View, TheWindowHoldsWhatIsSeen) {
  const auto seen = window_of(Ball(), along_x, std::nullopt);
  ASSERT_TRUE(seen.has_value());
  EXPECT_NEAR(seen->x0, -1, 0.06);
  EXPECT_NEAR(seen->x1, 1, 0.06);
  EXPECT_NEAR(seen->y1, 1, 0.06);
  EXPECT_FALSE(window_of(Ball(), along_x, SpacePlane{{{1, 0, 0}}, -0.5}).has_value());
}

TEST(SpacePicture, HasThePlainColourOfTheFieldOnACutAndPaperBesideTheBody) {
  SpacePicture p;
  p.view = along_x;
  p.cut = SpacePlane{{{1, 0, 0}}, 0.5};
  p.window = {-1, 1, -1, 1, -3};
  p.max_width = p.max_height = 400;
  const SpaceRays rays = rays_of(p, Ball());
  const Colours colours = colours_of({-10, 10}, {.range = std::pair{-10.0, 10.0}});
  const Image image = rendered(space_picture(p, rays, colours));
  // The face of the cut is a circle of radius sqrt(3)/2; its middle has 0.5.
  const int x = 28 + rays.screen.nx / 4, y = 24 + rays.screen.ny / 4;
  const Rgb face = image.at(x, y), wanted = colours.at(0.5);
  EXPECT_NEAR(face.r, wanted.r, 3);
  EXPECT_NEAR(face.g, wanted.g, 3);
  EXPECT_NEAR(face.b, wanted.b, 3);
  EXPECT_EQ(image.at(30, 26), (Rgb{255, 255, 255}));
}

/// Eight cells of width 1 beside one of width 2.
UnstructuredGrid two_sizes() {
  UnstructuredGrid grid;
  for (int n = 0; n < 8; ++n) {
    const double lo[3] = {1.0 * (n & 1), 1.0 * (n >> 1 & 1), 1.0 * (n >> 2 & 1)};
    const double hi[3] = {lo[0] + 1, lo[1] + 1, lo[2] + 1};
    add_box_cell(grid, 3, lo, hi);
  }
  const double lo[3] = {2, 0, 0}, hi[3] = {4, 2, 2};
  add_box_cell(grid, 3, lo, hi);
  return grid;
}

TEST(CellLookup, FindsCellsOfBothSizes) {
  const CellLookup cells(two_sizes());
  EXPECT_EQ(cells.finest(), 1);
  EXPECT_EQ(cells.at({{0.5, 0.5, 0.5}}), 0);
  EXPECT_EQ(cells.at({{1.5, 0.5, 1.5}}), 5);
  EXPECT_EQ(cells.at({{2.1, 1.9, 0.1}}), 8);
  EXPECT_EQ(cells.at({{3.9, 0.1, 1.9}}), 8);
  EXPECT_EQ(cells.at({{4, 2, 2}}), 8) << "the box has its upper faces";
  EXPECT_EQ(cells.at({{4.1, 1, 1}}), -1);
  EXPECT_EQ(cells.at({{-0.1, 1, 1}}), -1);
}

TEST(CellLookup, WeightsGiveBackALinearField) {
  const CellLookup cells(two_sizes());
  const Vec<3> x{{0.8, 1.2, 0.9}};
  const CellLookup::Corners c = cells.around(x);
  Vec<3> sum;
  double all = 0;
  for (std::size_t n = 0; n < 8; ++n) {
    ASSERT_GE(c.cell[n], 0);
    const double half = 0.5 * cells.width(c.cell[n]);
    sum += (cells.lower(c.cell[n]) + Vec<3>{{half, half, half}}) * c.weight[n];
    all += c.weight[n];
  }
  EXPECT_NEAR(all, 1, 1e-12);
  EXPECT_NEAR(norm(sum - x), 0, 1e-12);
}

TEST(CellLookup, RefusesFieldsOfThePlane) {
  UnstructuredGrid grid;
  const double lo[3] = {0, 0, 0}, hi[3] = {1, 1, 0};
  add_box_cell(grid, 2, lo, hi);
  EXPECT_THROW(CellLookup{grid}, InputError);
}

}  // namespace
}  // namespace recoil::space_test
