#pragma once

#include <string>

namespace recoil {

/// Relative errors of the balances of one body, or of `total`: the largest at any time that was looked at.
struct Drift {
  std::string name;
  double mass = 0;      ///< of the mass
  double momentum = 0;  ///< of the largest sum of m |u| so far; the worst axis
  double energy = 0;    ///< of the largest total energy so far
};

}  // namespace recoil
