#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "parallel/exact_sums.hpp"
#include "state/body.hpp"

namespace recoil {

/// Where a body points, and how it turns, in the plane of x and y (planar, 3d). The axis of a body or of a
/// part of it is the one about which its moment of inertia in that plane is least. All angles in rad from the
/// x axis, counter-clockwise.
struct Attitude {
  double inclination = 0;  // of the axis of the whole body
  double front_half = 0;   // of the axis of the matter ahead of the centre of mass
  double front_third = 0;  // of the axis of the foremost third, by the length of a rod with the same moments
  double course = 0;       // direction of the velocity of the centre of mass
  double speed = 0;        // m/s, of the centre of mass
  double head_x = 0, head_y = 0;  // m/s, mean velocity of the foremost third
  double spin = 0;                // rad/s, angular momentum over moment of inertia, about the centre of mass
};

/// What the parts ahead are cut by; the same on all ranks.
struct AttitudeFrame {
  double mass = 0;  // kg (planar: per m)
  std::array<double, 2> centre{}, velocity{}, axis{};
  double length = 0;  // m, of a thin rod with the same largest second moment
  double spin = 0;
};

/// Sums that the parts ahead take: mass, moments and second moments of the half and of the third, momentum of
/// the third.
inline constexpr std::size_t attitude_sums = 14;

/// Centre, axis and spin of the whole body. Of the two directions of the axis that of the motion counts, or
/// +x of a body at rest. Collective.
template <int Dim>
AttitudeFrame find_frame(const State<Dim>& state, int body, const parallel::World& world);

/// Adds this rank's share of the parts ahead. Not collective.
template <int Dim>
void collect_attitude(const State<Dim>& state, int body, const AttitudeFrame& frame, int item,
                      ExactSums& sums);

/// On rank 0, after the reduction; NaN where there is no matter.
Attitude read_attitude(const AttitudeFrame& frame, std::span<const double> total);

}  // namespace recoil
