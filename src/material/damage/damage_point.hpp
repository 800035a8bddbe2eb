#pragma once

namespace recoil {

/// What makes the damage of a point of matter grow in one step.
struct DamagePoint {
  double damage = 0;         // before
  double principal = 0;      // Pa, largest principal stress, tension positive
  double pressure = 0;       // Pa
  double equivalent = 0;     // Pa, von Mises
  double strain_growth = 0;  // of the equivalent plastic strain in this step
  double temperature = 0;    // K
  double dt = 0;             // s
};

}  // namespace recoil
