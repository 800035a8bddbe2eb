#pragma once

#include <vector>

#include "config/case.hpp"
#include "state/body.hpp"

namespace recoil {

/// The cells of a case: finest = dx; the mesh is shifted by mesh.offset of a cell along every axis that is
/// open at both ends. @throws InputError where a closed axis does not hold whole cells.
template <int Dim>
Grid<Dim> make_grid(const config::Case& c);

/// Cells of the blocks that hold matter at t = 0, by level; the same number as make_state() gives, but for
/// blocks that are cut because a neighbour is much finer.
template <int Dim>
std::vector<double> cells_at_start(const config::Case& c);

/// The picture at t = 0: level sets from the shapes, volumes by fine sub-sampling, matter at rest density and
/// zero pressure with the body's velocity and spin.
/// @param materials one for each body of the case; those of rigid bodies are not used.
/// Collective.
template <int Dim>
State<Dim> make_state(const config::Case& c, const std::vector<Material>& materials,
                      const parallel::World& world);

}  // namespace recoil
