#pragma once

#include <cstddef>
#include <span>

#include "parallel/exact_sums.hpp"
#include "state/body.hpp"

namespace recoil {

/// A point that moves with the surface of a body.
template <int Dim>
struct SurfacePoint {
  int body = 0;
  Vec<Dim> at;      // m
  Vec<Dim> normal;  // out of the body; zero: not known yet
};

/// Velocity and normal of the surface at such a point.
template <int Dim>
struct SurfaceReading {
  bool found = false;
  Vec<Dim> velocity;  // m/s
  Vec<Dim> normal;
};

/// Sums that a surface reading takes.
template <int Dim>
inline constexpr std::size_t surface_sums = 2 * (1 + 2 * Dim);

/// Adds the walls near the point, of this rank's blocks: cut cells within 2 dx, or else 4 dx, of which the
/// middle of the surface is r away count with exp(-2 r^2/dx^2) (|A_I|/dx^(Dim-1) + 0.02). Where the normal is
/// known, surfaces that face the other way (the far side of a thin body) do not count. After a step.
/// Fragments of the body count that other bodies have taken up, images beyond reflecting edges, and what lies
/// across the edge of a period.
template <int Dim>
void probe_surface(const State<Dim>& state, const SurfacePoint<Dim>& point, int item, ExactSums& sums);

/// The same from the matter near the point and the level set, where there are no walls yet: at the start.
template <int Dim>
void probe_surface_at_rest(const State<Dim>& state, const SurfacePoint<Dim>& point, int item,
                           ExactSums& sums);

template <int Dim>
SurfaceReading<Dim> read_surface(std::span<const double> sums);

/// Moves the point by its normal velocity for a time dt [s], and gives it the surface's normal. Where it
/// leaves across the edge of a period it comes in on the other side.
template <int Dim>
void follow_surface(const Grid<Dim>& grid, SurfacePoint<Dim>& point, const SurfaceReading<Dim>& reading,
                    double dt);

}  // namespace recoil
