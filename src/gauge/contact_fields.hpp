#pragma once

#include <cstdint>
#include <vector>

#include "parallel/world.hpp"
#include "state/body.hpp"

namespace recoil {

/// What has become of a fragment of surface.
enum class ContactState {
  free = 0,      ///< touches nothing and faces nothing that it has touched
  touching = 1,  ///< pressed against a body, at the same tangential velocity
  slipping = 2,  ///< pressed against a body that slides along it
  opened = 3     ///< touches nothing now, but faces, within 8 cells, a body that its own has touched
};

/// Contact as seen from the surface of one body in one cell.
struct SurfaceContact {
  ContactState state = ContactState::free;
  double gap = 0;       ///< m, to the nearest other body; NaN: none within 8 cells
  double traction = 0;  ///< Pa, normal, at most 0
};

/// For every body a bit for each other one with which it has exchanged momentum since the start. Collective.
template <int Dim>
std::vector<std::uint32_t> have_touched(const State<Dim>& state, const parallel::World& world);

/// Contact on the surface of body m in a cell (place in the layout of its block) that this surface cuts.
/// Slipping: the tangential velocities of the two surfaces differ by more than 1e-5 of the speed of sound.
/// @param touched of have_touched(), for body m.
template <int Dim>
SurfaceContact surface_contact(const State<Dim>& state, int slot, int m, int cell, std::uint32_t touched);

}  // namespace recoil
