#pragma once

#include "interface/surface_view.hpp"

namespace recoil {

/// What stands opposite to a surface point.
template <int Dim>
struct Opposite {
  int body = -1;            // -1: nothing within dx
  double gap = 0;           // [m], its level set at the point
  Vec<Dim> normal;          // out of that body
  Primitives<Dim> value{};  // its fitted state, continued to the point; not of a rigid one

  /// Whether the surface with outward normal n faces it.
  bool faces(const Vec<Dim>& n) const { return body >= 0 && dot(n, normal) < -0.7; }
};

/// What find_opposite() looks at: cells up to three around the block.
inline constexpr Sight opposite_sight{3, PhiAt::midstep, true, true};

/// The body other than m that is nearest to a surface point x of cell i.
/// @param view of opposite_sight.
template <int Dim>
Opposite<Dim> find_opposite(const SurfaceView<Dim>& view, int m, const Vec<Dim>& x, const Index<Dim>& i);

/// Velocity [m/s] of what stands opposite, at the surface point x: the rigid body's there, spin included, or
/// that of the fitted state.
template <int Dim>
Vec<Dim> velocity_of(const SurfaceView<Dim>& view, const Opposite<Dim>& opposite, const Vec<Dim>& x);

/// Direction of the contact of a surface with outward normal n: away from the partner if that is rigid, else
/// between the two normals.
template <int Dim>
Vec<Dim> contact_normal(const SurfaceView<Dim>& v, const Opposite<Dim>& o, const Vec<Dim>& n) {
  return v.body(o.body).rigid ? -o.normal : unit(n - o.normal);
}

}  // namespace recoil
