#pragma once

#include <vector>

#include "core/vec.hpp"
#include "format/unstructured_grid.hpp"
#include "state/body.hpp"
#include "state/rigid_motion.hpp"

namespace recoil {

/// Where a rigid body is at the time of a dump, and how it moves. Components that a geometry lacks are 0.
struct RigidPlace {
  int body = 0;           // number in the case
  Vec<3> start_centre;    // the point that it turns about, at the start [m]
  RigidPose<3> pose;      // that point now [m], and the rotation since the start
  Vec<3> velocity, spin;  // of that point [m/s]; rad/s
};

/// Of all rigid bodies, prescribed and free, in the order of the case. Every process knows them.
template <int Dim>
std::vector<RigidPlace> rigid_places(const State<Dim>& state);

/// The arrays of a dump that hold them, one row for each body; none where there is no rigid body.
std::vector<NamedArray> rigid_arrays(const std::vector<RigidPlace>& places);

/// Reads them back; empty for dumps of older versions, which have none. @throws InputError where arrays are
/// missing or do not fit together.
std::vector<RigidPlace> rigid_places_in(const UnstructuredGrid& grid);

}  // namespace recoil
