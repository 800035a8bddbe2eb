#pragma once

#include <string>
#include <vector>

#include "material/material.hpp"

namespace recoil {

/// A constant that contradicts another one or what matter usually does. Not an error: the user may know.
struct Suspicion {
  std::string message;  // "specific heat 477 J/(kg K) is 3.5 times that of Dulong and Petit"
  std::string help;     // what was compared with what
};

/// Looks for constants of a material that are wrong more often than not: exchanged columns of a table
/// (specific heat), a wrong factor of ten (yield), moduli that contradict each other, a start above melting.
std::vector<Suspicion> lint(const Material& material);

}  // namespace recoil
