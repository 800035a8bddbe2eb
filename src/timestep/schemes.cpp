#include "timestep/schemes.hpp"

#include "core/error.hpp"
#include "timestep/ghost_fluid_step.hpp"
#include "timestep/seed_step.hpp"

namespace recoil {

template <int Dim>
Scheme<Dim> scheme_of(const std::string& name) {
  if (name == "ghost-fluid") return {&prepare_whole_cell_start<Dim>, &advance_ghost_fluid<Dim>};
  if (name == "seed") return {&prepare_whole_cell_start<Dim>, &advance_seed<Dim>};
  require(name == "conservative", "no such scheme");
  return {&prepare_start<Dim>, &advance<Dim>};
}

template Scheme<1> scheme_of<1>(const std::string&);
template Scheme<2> scheme_of<2>(const std::string&);
template Scheme<3> scheme_of<3>(const std::string&);

}  // namespace recoil
