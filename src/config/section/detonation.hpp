#pragma once

#include <vector>

#include "config/declare/entry.hpp"

namespace recoil::config {

/// Where and when an explosive is lit.
struct Detonation {
  std::vector<Vector> points;  // m; none: the body does not detonate
  Vector direction{};          // of a plane front; 0: spherical ones
  double time = 0;             // s

  static constexpr const char* doc =
      "A detonation that runs through an explosive with the velocity of its material (programmed burn).";
  static Entries<Detonation> keys();
};

}  // namespace recoil::config
