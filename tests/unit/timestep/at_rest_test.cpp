#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <numbers>

#include "run.hpp"

namespace recoil::at_rest_test {
namespace {

constexpr double mm = 1e-3;

/// An elastic body of low Poisson ratio, where surfaces damp short waves least.
Material stiff_in_shear() {
  Material m;
  m.eos = LinearEos{4000, 60e9};
  m.strength = Elastic{80e9};
  return m;
}

/// A body in the void that starts with velocities of 1 m/s along an axis, whose sign changes from cell to
/// cell along the first axis: waves of two cells' length. Those inside die out within some ten steps, those
/// along its surface remain.
template <int Dim>
class ShortWaves : public TestRun<Dim> {
 public:
  ShortWaves(const config::Case& c, int moving) : TestRun<Dim>(c, {stiff_in_shear()}) {
    each_cell([&](BodyBlock<Dim>& b, std::size_t k, const Index<Dim>& i) {
      const double mass = b.contents[k], speed = i[0] % 2 == 0 ? 1 : -1;
      b.contents[(K::u + moving) * b.volume.size() + k] += mass * speed;
      b.contents[K::energy * b.volume.size() + k] += 0.5 * mass * speed * speed;
    });
  }

  /// How much the kinetic energy grows once the waves inside have died out. Four spans follow each other, of
  /// `dying`, `window`, `dying`, `window` steps: the largest of the last span over that of the second.
  double growth(int dying, int window) {
    loudest(dying);
    const double early = loudest(window);
    loudest(dying);
    return loudest(window) / early;
  }

 private:
  using K = Components<Dim>;

  /// Largest kinetic energy within the next steps [J].
  double loudest(int steps) {
    double most = 0;
    for (int k = 0; k < steps; ++k) {
      this->steps(1);
      most = std::max(most, kinetic_energy());
    }
    return most;
  }
  template <class F>
  void each_cell(F&& f) {
    for (int s = 0; s < this->state.mesh.local(); ++s) {
      auto& b = this->state.bodies[0].at(s);
      if (!b.present) continue;
      const Box<Dim> own = this->state.mesh.block(s).cells;
      for_each(own, [&](const Index<Dim>& i) {
        const auto k = static_cast<std::size_t>(this->state.grid().layout().at(i - own.lo));
        if (b.contents[k] > 0) f(b, k, i);
      });
    }
  }
  double kinetic_energy() {
    double sum = 0;
    each_cell([&](BodyBlock<Dim>& b, std::size_t k, const Index<Dim>&) {
      for (int d = 0; d < Dim; ++d) {
        const double momentum = b.contents[(K::u + d) * b.volume.size() + k];
        sum += 0.5 * momentum * momentum / b.contents[k];
      }
    });
    return sum;
  }
};

/// A box in the void, with a margin around it [m], on a mesh that is shifted by a part of a cell.
config::Case box_in_void(config::Geometry geometry, const config::Box& box, double margin, double offset) {
  auto lo = box.lo, hi = box.hi;
  for (std::size_t d = 0; d < 3; ++d) {
    lo[d] -= margin;
    hi[d] += margin;
  }
  auto c = case_of(domain_of(geometry, lo, hi), 0.25 * mm, {body_of("box", {box})});
  c.mesh.offset = offset;
  return c;
}

/// With means over the whole reach of a fit the energy grows by a factor of 120 in 1000 steps
/// (docs/decisions/0066).
TEST(ShortWavesAlongSurfaces, OfAPlateDieOut) {
  config::Box plate{.lo = vector_of(-3 * mm, -1.5 * mm), .hi = vector_of(3 * mm, 1.5 * mm)};
  ShortWaves<2> run(box_in_void(config::Geometry::planar, plate, 1.5 * mm, 0.5), 1);
  EXPECT_LT(run.growth(500, 500), 1);
}

TEST(ShortWavesAlongSurfaces, OfASlantedPlateDieOut) {
  config::Box plate{.lo = vector_of(-3 * mm, -1.5 * mm), .hi = vector_of(3 * mm, 1.5 * mm)};
  plate.rotation = 26.57 * std::numbers::pi / 180;
  ShortWaves<2> run(box_in_void(config::Geometry::planar, plate, 1.5 * mm, 0), 1);
  EXPECT_LT(run.growth(500, 500), 1);
}

TEST(ShortWavesAlongSurfaces, OfACubeDieOut) {
  const double half = 1 * mm;
  config::Box cube{.lo = vector_of(-half, -half, -half), .hi = vector_of(half, half, half)};
  ShortWaves<3> run(box_in_void(config::Geometry::space, cube, 0.75 * mm, 0.5), 2);
  EXPECT_LT(run.growth(500, 100), 1);
}

}  // namespace
}  // namespace recoil::at_rest_test
