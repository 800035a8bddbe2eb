#pragma once

#include <optional>
#include <string>
#include <vector>

#include "config/section/detonation.hpp"
#include "config/section/velocity_field.hpp"
#include "config/section/velocity_history.hpp"
#include "config/shape/shape.hpp"

namespace recoil::config {

/// Matter with a surface of its own, of a material or rigid.
struct Body {
  std::string name;
  std::string material;  // a library name or a [material.NAME] of this case; empty: rigid
  bool rigid = false;
  double mass = 0;          // of a free rigid body [kg; kg/m planar; kg/m2 1d]; 0: keeps its velocity
  Vector inertia{};         // kg m2 (planar: kg m, [2] only), about the centre of mass, along the axes
  Vector centre_of_mass{};  // m, where it is given
  bool has_centre_of_mass = false;  // else that of its shape counts
  Shape shape;                      // a union of none where it takes up fragments
  std::string fragments_of;         // the body whose fragments it takes up; empty: it has a shape of its own
  Vector velocity{};                // m/s
  Vector spin{};                    // rad/s about spin_centre; planar: [2] only
  Vector spin_centre{};             // m
  double radial_velocity = 0;       // m/s, away from radial_centre
  Vector radial_centre{};           // m
  bool radial_from_axis = false;    // away from r = 0 instead (axisymmetric, spherical)
  double radial_falls_from = 0;     // m, the distance from which radial_velocity falls; 0: it does not
  VelocityField velocity_field;     // added to the velocities above
  std::vector<TimedVelocity> velocity_history;  // of a rigid body; empty: it keeps its velocity
  Detonation detonation;
  std::optional<double> pressure;     // Pa, at the start; none: 0
  std::optional<double> temperature;  // K, at the start; none: that of the material
  Place place = {}, material_place = {}, fragments_place = {};

  static constexpr const char* doc =
      "A body: matter with a surface of its own. Either a material, or rigid = true, or fragments-of.";
  static Entries<Body> keys();
  void check(const TableReading& reading);
  bool takes_up_fragments() const { return !fragments_of.empty(); }
};

/// Reads every [body.NAME] below the table `body`; `in` learns their names. A body that takes up fragments
/// gets the material and the state at the start of the one that breaks.
void read_bodies(const Node& table, std::vector<Body>& bodies, CaseReading& in);

}  // namespace recoil::config
