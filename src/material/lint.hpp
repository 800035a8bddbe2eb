#pragma once

#include <string>
#include <vector>

#include "material/material.hpp"

namespace recoil {

/// A constant that contradicts another one or what matter usually does.
struct Suspicion {
  std::string message;   // "specific heat 477 J/(kg K) is 3.5 times that of Dulong and Petit"
  std::string help;      // what was compared with what
  std::string key;       // the constant, as a file calls it: "eos.density"
  bool certain = false;  // no solid is like that; otherwise the user may know
};

/// Looks for constants of a material that are wrong more often than not: exchanged columns of a table
/// (specific heat), a wrong unit (density, yield), moduli that contradict each other, a start above melting.
std::vector<Suspicion> lint(const Material& material);

}  // namespace recoil
