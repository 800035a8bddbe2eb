#pragma once

#include <array>
#include <memory>
#include <optional>

#include "core/vec.hpp"
#include "field/components.hpp"
#include "gauge/point_state.hpp"
#include "material/material.hpp"
#include "state/body.hpp"

namespace recoil::app {

/// Rows of a velocity gradient, L_ij = du_i/dx_j [1/s]; also of a stress [Pa].
using Tensor = std::array<Vec<3>, 3>;

/// Matter at one point that is deformed as told: equations (1), (4) and (5) of docs/theory.md with
/// rho de/dt = sigma:D, and the return to yield, the growth of damage and the crushing of pores of the runs.
/// Second order in the step.
class MaterialPoint {
 public:
  /// At pressure [Pa] and temperature [K]; without both at rest. @throws InputError where the equation of
  /// state has no such state.
  MaterialPoint(const Material& material, std::optional<double> pressure, std::optional<double> temperature);

  /// Deforms it at the gradient `l` for dt [s]. @throws PhysicsError where the equation of state ends.
  void advance(const Tensor& l, double dt);

  PointState<3> state() const { return point_state<3>(*body_, contents_, volume_); }
  double internal_energy() const;  // J/kg, of elastic distortion included
  Tensor stress() const;           // Pa, positive in tension
  const Material& material() const { return body_->material; }

 private:
  void check_density() const;

  std::shared_ptr<const Body<3>> body_;  // without blocks; copies of a point share it
  double volume_ = 1;                    // of a fragment that had 1 m3 at the start
  Contents<3> contents_{};
};

}  // namespace recoil::app
