#pragma once

#include "material/eos/jwl.hpp"

namespace recoil {

/// The steady detonation of an explosive.
struct ChapmanJouguet {
  double velocity = 0;  // m/s, of the front
  double pressure = 0;  // Pa
  double density = 0;   // kg/m3
  double particle = 0;  // m/s, of the products behind the front
};

/// The Chapman-Jouguet state: of all states that products reach from the explosive at rest by the jump
/// conditions, with the energy of detonation in them, that with the slowest front.
ChapmanJouguet chapman_jouguet(const Jwl& products);

}  // namespace recoil
