#pragma once

#include <array>

#include "core/vec.hpp"

namespace recoil {

/// A box of space [m], lo < hi on every axis.
struct SpaceBox {
  Vec<3> lo{}, hi{};
};

/// The points x with normal . x = distance [m]; the normal has length 1.
struct SpacePlane {
  Vec<3> normal{{0, 0, 1}};
  double distance = 0;
};

/// Bodies in space, as a view of them needs them. All lengths [m].
class Scene {
 public:
  Scene() = default;
  Scene(const Scene&) = default;
  Scene& operator=(const Scene&) = default;
  virtual ~Scene() = default;

  /// The part of space that is known; bodies end at its faces.
  virtual SpaceBox box() const = 0;
  /// Width of the finest cells: surfaces have no details below it.
  virtual double cell() const = 0;
  /// At most the distance to the nearest surface, negative inside of a body; it changes its sign at surfaces.
  virtual double distance(const Vec<3>& x) const = 0;
  /// Number of the body to which the point belongs, or which is the nearest.
  virtual int body(const Vec<3>& x) const = 0;
  /// The field there, of that body's matter; NaN where it has none around.
  virtual double value(const Vec<3>& x, int body) const = 0;
};

/// The same with what planes of symmetry reflect.
class MirroredScene : public Scene {
 public:
  /// @param at_low,at_high whether the lower or upper face of the scene's box is a plane of symmetry; of an
  /// axis with both the lower one counts.
  MirroredScene(const Scene& scene, std::array<bool, 3> at_low, std::array<bool, 3> at_high)
      : scene_(scene), low_(at_low), high_(at_high) {}

  SpaceBox box() const override {
    const SpaceBox own = scene_.box();
    SpaceBox all = own;
    for (int d = 0; d < 3; ++d) {
      if (low_[d]) all.lo[d] = 2 * own.lo[d] - own.hi[d];
      if (high_[d] && !low_[d]) all.hi[d] = 2 * own.hi[d] - own.lo[d];
    }
    return all;
  }
  double cell() const override { return scene_.cell(); }
  double distance(const Vec<3>& x) const override { return scene_.distance(folded(x)); }
  int body(const Vec<3>& x) const override { return scene_.body(folded(x)); }
  double value(const Vec<3>& x, int body) const override { return scene_.value(folded(x), body); }

 private:
  Vec<3> folded(Vec<3> x) const {
    const SpaceBox own = scene_.box();
    for (int d = 0; d < 3; ++d) {
      if (low_[d] && x[d] < own.lo[d]) x[d] = 2 * own.lo[d] - x[d];
      if (high_[d] && !low_[d] && x[d] > own.hi[d]) x[d] = 2 * own.hi[d] - x[d];
    }
    return x;
  }

  const Scene& scene_;
  std::array<bool, 3> low_, high_;
};

}  // namespace recoil
