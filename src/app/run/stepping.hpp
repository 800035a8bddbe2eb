#pragma once

#include "config/case.hpp"
#include "timestep/step.hpp"

namespace recoil::app {

/// How a case wants its steps.
inline Stepping stepping_of(const config::Case& c) {
  return {c.time.cfl, c.time.fixed_dt, c.method.kappa,
          c.method.stages == "one" ? StepStages::one : StepStages::three};
}

/// How often the speed of sound counts in the length of the steps of a case.
inline double sound_in_step(const config::Case& c) {
  const config::Geometry geometry = c.domain.geometry;
  return recoil::sound_in_step(config::dimension(geometry), stepping_of(c).stages,
                               config::radial_power(geometry));
}

}  // namespace recoil::app
