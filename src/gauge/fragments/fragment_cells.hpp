#pragma once

#include <cstdint>
#include <vector>

#include "parallel/world.hpp"
#include "state/body.hpp"

namespace recoil {

/// What the matter of one body in a cell is to its fragments (fragments.hpp).
enum class Hold : std::uint8_t {
  none,    // there is none
  holds,   // connected to what holds beside it
  rubble,  // failed, with a void: connected to rubble
  loose    // failed, less than half a cell: connected to nothing
};

/// One body in one block.
struct FragmentBlock {
  std::vector<Hold> hold;            // by place in the layout; all empty where the body is not
  std::vector<double> fill, phi;     // solid part of the cell; level set [m]
  std::vector<double> solid;         // part of the matter's volume that is not void
  std::vector<std::int64_t> number;  // of the cell (cell_number()); once labelled the smallest of its set
};

/// A number for each cell of each body that does not depend on ranks and blocks; of one body they rise along
/// the first axis first.
template <int Dim>
std::int64_t cell_number(const Mesh<Dim>& mesh, int slot, int body, const Index<Dim>& cell);

/// By body and slot: own blocks, and the outer cells of copies of other processes' blocks. Collective.
template <int Dim>
std::vector<std::vector<FragmentBlock>> fragment_cells(const State<Dim>& state, const parallel::World& world);

/// Brings `number` of the copies' outer cells up to date. Collective.
template <int Dim>
void exchange_numbers(const State<Dim>& state, const parallel::World& world,
                      std::vector<std::vector<FragmentBlock>>& cells);

}  // namespace recoil
