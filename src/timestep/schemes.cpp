#include "timestep/schemes.hpp"

#include "core/error.hpp"
#include "timestep/ghost_fluid_step.hpp"
#include "timestep/seed_step.hpp"

namespace recoil {

template <int Dim>
Advance<Dim> step_of(const std::string& scheme) {
  if (scheme == "ghost-fluid") return &advance_ghost_fluid<Dim>;
  if (scheme == "seed") return &advance_seed<Dim>;
  require(scheme == "conservative", "no such scheme");
  return &advance<Dim>;
}

template Advance<1> step_of<1>(const std::string&);
template Advance<2> step_of<2>(const std::string&);
template Advance<3> step_of<3>(const std::string&);

}  // namespace recoil
