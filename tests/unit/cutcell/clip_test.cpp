#include "cutcell/clip.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "../core/dimensions.hpp"
#include "../core/random.hpp"

namespace recoil::clip_test {
namespace {

/// Matter where normal . x < offset, in the unit cell.
template <int Dim>
Corners<Dim> plane(const Vec<Dim>& normal, double offset) {
  Corners<Dim> v{};
  for (std::size_t c = 0; c < v.size(); ++c) {
    v[c] = -offset;
    for (int d = 0; d < Dim; ++d) v[c] += normal[d] * static_cast<double>(c >> d & 1U);
  }
  return v;
}

/// Volume of {n . x < offset} in the unit cube, n > 0, by the simplices that the corners cut off.
template <int Dim>
double exact_volume(const Vec<Dim>& n, double offset) {
  double sum = 0, factor = 1;
  for (int d = 0; d < Dim; ++d) factor *= (d + 1) * n[d];
  for (unsigned corner = 0; corner < 1U << Dim; ++corner) {
    double rest = offset;
    int sign = 1;
    for (int d = 0; d < Dim; ++d)
      if ((corner >> d & 1U) != 0) {
        rest -= n[d];
        sign = -sign;
      }
    if (rest > 0) sum += sign * std::pow(rest, Dim);
  }
  return sum / factor;
}

/// The same for any signs: axes with a negative component are turned round.
template <int Dim>
double exact_volume_of_any(Vec<Dim> n, double offset) {
  for (int d = 0; d < Dim; ++d)
    if (n[d] < 0) {
      offset -= n[d];
      n[d] = -n[d];
    }
  return exact_volume(n, offset);
}

template <int Dim>
Corners<Dim> negated(Corners<Dim> v) {
  for (double& x : v) x = -x;
  return v;
}

template <class D>
struct Clipping : testing::Test {
  static constexpr int dim = D::value;
  /// Calls f(normal, offset, values at the corners) for random planes that cut the cell.
  template <class F>
  static void for_random_planes(F&& f) {
    Random random(5);
    for (int n = 0; n < 500; ++n) {
      const auto normal = unit(random.vector<dim>(-1, 1));
      double offset = 0;
      for (int d = 0; d < dim; ++d) offset += normal[d] * random(0.02, 0.98);  // through a point of the cell
      f(normal, offset, plane<dim>(normal, offset));
    }
  }
};
TYPED_TEST_SUITE(Clipping, Dimensions);

TYPED_TEST(Clipping, FullAndEmptyCells) {
  constexpr int dim = TestFixture::dim;
  Corners<dim> v{};
  v.fill(-0.3);
  EXPECT_EQ(clip<dim>(v).fraction, 1);
  EXPECT_EQ(clip<dim>(v).crossings, 0);
  for (int d = 0; d < dim; ++d) EXPECT_NEAR(clip<dim>(v).centroid[d], 0.5, 1e-15);
  for (int d = 0; d < dim; ++d) EXPECT_EQ(clip_face<dim>(v, d, 1).fraction, 1);
  EXPECT_EQ(clip<dim>(negated<dim>(v)).fraction, 0);
  for (int d = 0; d < dim; ++d) EXPECT_EQ(clip_face<dim>(negated<dim>(v), d, 0).fraction, 0);
}

TYPED_TEST(Clipping, VolumesUnderPlanesAreExact) {
  constexpr int dim = TestFixture::dim;
  TestFixture::for_random_planes([](const Vec<dim>& n, double offset, const Corners<dim>& v) {
    const double exact = exact_volume_of_any(n, offset);
    // The formula cancels where a component of the normal is small.
    double tolerance = 1e-14;
    for (int d = 0; d < dim; ++d) tolerance /= std::min(1.0, std::abs(n[d]));
    ASSERT_NEAR(clip<dim>(v).fraction, exact, tolerance + 1e-14);
  });
}

TYPED_TEST(Clipping, PieceAndRestMakeTheCell) {
  constexpr int dim = TestFixture::dim;
  TestFixture::for_random_planes([](const Vec<dim>&, double, const Corners<dim>& v) {
    const auto fragment = clip<dim>(v), rest = clip<dim>(negated<dim>(v));
    ASSERT_NEAR(fragment.fraction + rest.fraction, 1, 1e-13);
    ASSERT_LT(norm(fragment.middle - rest.middle), 1e-13);
    for (int d = 0; d < dim; ++d) {
      const double moment = fragment.fraction * fragment.centroid[d] + rest.fraction * rest.centroid[d];
      ASSERT_NEAR(moment, 0.5, 1e-12);
      for (int side = 0; side < 2; ++side)
        ASSERT_NEAR(clip_face<dim>(v, d, side).fraction + clip_face<dim>(negated<dim>(v), d, side).fraction,
                    1, 1e-13);
    }
  });
}

TYPED_TEST(Clipping, CentroidsLieWhereSamplesSay) {
  constexpr int dim = TestFixture::dim;
  constexpr int fine = dim == 1 ? 2000 : dim == 2 ? 200 : 40;
  int planes = 0;
  TestFixture::for_random_planes([&](const Vec<dim>& n, double offset, const Corners<dim>& v) {
    if (++planes > 40 || clip<dim>(v).fraction < 0.02) return;
    Box<dim> samples;
    for (int d = 0; d < dim; ++d) samples.hi[d] = fine;
    Vec<dim> sum;
    int count = 0;
    for_each(samples, [&](const Index<dim>& i) {
      Vec<dim> x;
      for (int d = 0; d < dim; ++d) x[d] = (i[d] + 0.5) / fine;
      if (dot(n, x) >= offset) return;
      sum += x;
      ++count;
    });
    ASSERT_LT(norm(clip<dim>(v).centroid - sum * (1.0 / count)), dim == 3 ? 0.01 : 0.004);
  });
}

/// The outward faces of a fragment close: what they lack is the area vector of the surface, along the plane's
/// normal.
TYPED_TEST(Clipping, FacesCloseAlongTheNormal) {
  constexpr int dim = TestFixture::dim;
  TestFixture::for_random_planes([](const Vec<dim>& n, double offset, const Corners<dim>& v) {
    Vec<dim> area;
    for (int d = 0; d < dim; ++d)
      area[d] = clip_face<dim>(v, d, 0).fraction - clip_face<dim>(v, d, 1).fraction;
    ASSERT_LT(norm(area - dot(area, n) * n), 1e-12);
    ASSERT_GE(dot(area, n), -1e-13);
    const auto fragment = clip<dim>(v);
    ASSERT_GT(fragment.crossings, 0);
    ASSERT_NEAR(dot(n, fragment.middle), offset, 1e-13);
    // V = 1/Dim closed-int x . n dA
    double sum = offset * dot(area, n);
    for (int d = 0; d < dim; ++d) sum += clip_face<dim>(v, d, 1).fraction;
    ASSERT_NEAR(fragment.fraction, sum / dim, 1e-13);
  });
}

/// A cell and its neighbour see the same values at their common face.
TYPED_TEST(Clipping, FaceCentroidsLieInTheirFaces) {
  constexpr int dim = TestFixture::dim;
  TestFixture::for_random_planes([](const Vec<dim>& n, double offset, const Corners<dim>& v) {
    for (int d = 0; d < dim; ++d)
      for (int side = 0; side < 2; ++side) {
        const auto face = clip_face<dim>(v, d, side);
        ASSERT_EQ(face.centroid[d], side);
        if (face.fraction < 1e-6) continue;
        ASSERT_LT(dot(n, face.centroid), offset + 1e-12);
      }
  });
}

TEST(ClipSquare, OppositeNegativeCornersAreJoined) {
  const Corners<2> v{-1, 1, 1, -1};
  const auto c = clip<2>(v);
  EXPECT_EQ(c.crossings, 4);
  EXPECT_NEAR(c.fraction, 0.75, 1e-15);
  EXPECT_NEAR(c.centroid[0], 0.5, 1e-15);
  EXPECT_NEAR(c.middle[1], 0.5, 1e-15);
}

TEST(ClipCube, ACornerIsATetrahedron) {
  const Vec<3> normal{{1, 2, 4}};
  const auto c = clip<3>(plane<3>(normal, 0.8));
  EXPECT_NEAR(c.fraction, 0.8 * 0.4 * 0.2 / 6, 1e-15);
  EXPECT_EQ(c.crossings, 3);
  const Vec<3> centroid{{0.2, 0.1, 0.05}};
  EXPECT_LT(norm(c.centroid - centroid), 1e-14);
}

}  // namespace
}  // namespace recoil::clip_test
