#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "parallel/world.hpp"
#include "state/body.hpp"

/// The pieces into which a body has broken.
///
/// Matter **holds** where it has not failed, or has failed but fills at least half of its cell without a void
/// (`least_void`). It is **rubble** where it has failed, has a void and fills at least half of its cell; less
/// failed matter than that, as stands in a crack that has opened, holds nothing. Cells of one body that share
/// a face are connected where both hold or both are rubble, and the mean of their level sets, its value in
/// the middle of the face, lies inside the body. A cell that is connected to none (a sliver at a surface,
/// what stands in a crack) goes to the neighbour that is fuller than itself, the fullest of them. What is
/// connected is a fragment; one with any matter that holds is a piece, any other a heap of rubble. Fragments
/// of a body that touch again are one, as they weld (theory: fracture).
namespace recoil {

/// Part of the volume of failed matter from which on its void parts what is beside it.
inline constexpr double least_void = 1e-3;

/// One fragment. Sums are per m2 in 1d, per m in planar geometry, per radian where axisymmetric.
template <int Dim>
struct Fragment {
  int body = 0;
  bool piece = false;        // else a heap of rubble
  std::int64_t first = 0;    // smallest number of its cells, the same for any ranks and blocks
  std::int64_t cells = 0;    // that hold any of it
  double mass = 0;           // kg
  double failed = 0;         // kg of matter that has failed
  double volume = 0;         // m^3 (1d: m, planar: m^2), without voids
  double kinetic = 0;        // J, of all its cells
  Vec<Dim> position;         // m, centre of mass
  Vec<Dim> velocity;         // m/s, momentum over mass
  Vec<Dim> lowest, highest;  // m, its extent
  double diameter = 0;       // m, of the sphere (planar: circle; 1d, spherical: its thickness) of this volume
};

/// All fragments of a state: of each body the pieces, the heaviest first, then the rubble; of equal masses
/// the one with the smallest first cell. Their masses and the other sums are rounded once
/// (core/exact_sum.hpp), so that numbers and order do not depend on ranks, threads or blocks.
template <int Dim>
struct Fragments {
  std::vector<Fragment<Dim>> list;  // on rank 0
  std::vector<int> heaviest;        // by body, on all ranks: number of its heaviest piece; -1: it has none
  /// By body, slot of an own block and place in its layout: number in the list, or -1. Empty where the body
  /// is not.
  std::vector<std::vector<std::vector<int>>> number;

  int at(int body, int slot, int cell) const {
    const auto& all = number[static_cast<std::size_t>(body)][static_cast<std::size_t>(slot)];
    return all.empty() ? -1 : all[static_cast<std::size_t>(cell)];
  }
};

/// What connects two cells of one body that share a face.
enum class Connected : std::uint8_t {
  by_matter,    // both hold or both are rubble, and the level set has no void between them: see above
  by_level_set  // the level set has no void between them, whatever has failed
};

/// Looks at all deformable bodies. Collective; allocates: not for every step of a long run.
template <int Dim>
Fragments<Dim> find_fragments(const State<Dim>& state, const parallel::World& world,
                              Connected how = Connected::by_matter);

}  // namespace recoil
