#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/approach.hpp"
#include "config/case.hpp"
#include "material/hugoniot.hpp"
#include "material/material.hpp"

namespace recoil::app {

/// Two bodies whose flat faces meet along an axis.
struct PlatePair {
  int flyer = 0, target = 0;  // numbers of the bodies: the faster one flies
  int axis = 0;
  double direction = 1;  // of the flyer's motion relative to the target, along the axis: 1 or -1
  double gap = 0;        // m, between the faces
  double closing = 0;    // m/s
  double flyer_thickness = 0, target_thickness = 0;  // m; infinite for half-spaces
  double half_width = 0;                             // m, of what they share across the axis; 1d: infinite
  bool flyer_rear_free = true, target_rear_free = true;  // nothing touches the rear face
};

/// Every pair of plates, boxes or cylinders of the case that face each other and close in. Only faces at
/// right angles to an axis, with a gap of zero or more and no body between them.
std::vector<PlatePair> find_plate_pairs(const config::Case& c);

enum class Parting {
  by_flyer_release,   // the release from the flyer's rear pulls: it is thrown back
  by_target_release,  // it stays until the release from the target's rear comes
  neutral,            // equal impedances: unloaded by the flyer's release without a pull
  open,               // not known: a rear face is not free
  by_sides,           // not known: releases from the sides come first
  never               // bonded
};

/// What one-dimensional wave theory says about a pair, without the rate term of the strength.
struct PlatePrediction {
  PlatePair pair;
  bool flyer_rigid = false, target_rigid = false;
  double contact = 0;   // s, faces meet
  double velocity = 0;  // m/s, of the interface, along the axis, in the frame of the case
  double stress = 0;    // Pa, compressive
  ShockState flyer_shock, target_shock;
  Parting parting = Parting::open;
  double opens = 0;             // s; infinite where it does not, or where that is not known
  bool opens_is_bound = false;  // the release from the target's rear comes before: at the latest then
  double sides = 0;  // s, releases from the sides reach the middle: the rest holds before; may be infinite
  double flyer_rear_after = 0;  // m/s, of the flyer's rear face once it is unloaded, along the axis

  /// At the target's rear face, times from the start of the run.
  std::optional<double> precursor_arrival;
  double precursor_surface_velocity = 0;  // m/s, more than before
  double shock_arrival = 0;               // s
  double plateau_surface_velocity = 0;    // m/s, more than before
  bool plateau_is_bound = false;          // a release catches up with the shock before: at most that velocity
  double release_arrival = 0;             // s, head of the release from the flyer's rear
  double overtaking_depth = 0;            // m, where that head meets the shock
};

/// @throws PhysicsError where no shock state exists.
PlatePrediction predict(const PlatePair& pair, const config::Case& c, const std::vector<Material>& materials);

/// As `recoil check` prints it.
std::string describe(const PlatePrediction& p, const config::Case& c);

/// The impact state of two bodies at the place where they touch first, along the normal there. Curved and
/// oblique contacts keep it for a moment only.
struct TouchPrediction {
  Approach approach;
  double stress = 0;                     // Pa, compressive
  ShockState first_shock, second_shock;  // empty of rigid bodies
};

/// Of those pairs that meet in the time of the run and are no plates, each for its first meeting.
std::vector<TouchPrediction> predict_touches(const config::Case& c, const std::vector<Material>& materials,
                                             const std::vector<PlatePair>& plates);
std::string describe(const TouchPrediction& p, const config::Case& c);

/// Bodies whose impacts are left out for the state in which they start, and why: a sentence for each.
std::vector<std::string> not_predicted(const config::Case& c);

/// By how much a free surface moves faster than the matter behind the shock once that is unloaded [m/s]:
/// first elastically to the other side of the yield surface, then plastically.
double unloading_velocity(const ShockState& state, const Material& material);

/// Speed of the head of a release, in the matter's own coordinate [m/s].
inline double release_head_speed(const ShockState& s, const Material& m) {
  return s.release_speed * s.density / density(m);
}

}  // namespace recoil::app
