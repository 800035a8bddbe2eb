#pragma once

#include <vector>

#include "timestep/step.hpp"

namespace recoil {

/// Where the cells are the finest. Always so: in blocks near the surfaces of deformable bodies and 11 cells
/// around these, in matter that is damaged, and in the blocks beside that.
template <int Dim>
struct Refinement {
  double bend = 0.1;  // of the velocity, over three cells, in parts of that at which the matter yields
  long every = 4;     // steps between two looks
  struct Region {
    Vec<Dim> lo, hi;  // m
  };
  std::vector<Region> regions;  // always finest
};

/// Makes blocks finer or coarser by one level where so wanted (the level, by own slot; Mesh::adapted) and
/// takes the state there: sums of mass, momentum and energy of each body stay. @returns whether any has
/// changed. Collective.
template <int Dim>
bool adapt(State<Dim>& state, Engine& engine, const std::vector<int>& wanted);

/// Fits the levels of the mesh to the state: blocks are cut where they must be, and joined where nothing has
/// happened. To be called between steps. Nothing is done between two looks, unless a surface has come near a
/// block that lies beside coarser ones. @returns whether the mesh is another one now. Collective.
template <int Dim>
bool regrid(State<Dim>& state, Engine& engine, const Refinement<Dim>& rules);

}  // namespace recoil
