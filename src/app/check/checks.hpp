#pragma once

#include <string>

#include "app/load_case.hpp"

/// The parts of check_logic(). Each adds to `loaded.found`.
namespace recoil::app {

/// Where a key of the case stands, or `otherwise`. @param dotted "body.flyer.velocity"
config::Place place_of(const LoadedCase& loaded, const std::string& dotted, const config::Place& otherwise);

/// A case with more cells than this machine has memory for is an error, and loaded.too_large.
void check_size(LoadedCase& loaded);

/// A fixed step beyond the stable one, and runs of more steps than anybody waits for.
void check_steps(LoadedCase& loaded);

/// Parts of the domain with the finest cells that lie outside of it, keys that mean nothing without levels.
void check_levels(LoadedCase& loaded);

/// Names of fields, intervals beyond the end, sources that the bibliography does not know, and
/// check_expectations().
void check_output(LoadedCase& loaded);

/// Constants that are wrong more often than not, and the doubts that the materials themselves state.
void check_materials(LoadedCase& loaded);

/// Gases whose pressures have no common zero, and free surfaces of gases.
void check_gases(LoadedCase& loaded);

/// Nothing that moves, bodies that fly apart, impacts that no equation of state reaches.
void check_motion(LoadedCase& loaded);

/// Formulas of velocities that have no finite value somewhere in their body, among samples.
void check_velocity_fields(LoadedCase& loaded);

/// Loads that never act on their body, have no finite value somewhere on it, among samples, or that the
/// scheme does not know.
void check_loads(LoadedCase& loaded);

/// Plates without damage that releases will pull harder than their material bears.
void check_tension(LoadedCase& loaded);

/// Bodies that an open edge of the domain cuts, free rigid bodies that a plane of symmetry cuts, and bodies
/// that meet their mirror image there.
void check_edges(LoadedCase& loaded);

/// Smallest extent of a shape [m]: of parts that cannot tell, the diameter of the largest ball that fits in,
/// by sampling; of a union that of its thinnest part. 1e300: endless.
double least_thickness(const config::Shape& shape, const config::Case& c);

}  // namespace recoil::app
