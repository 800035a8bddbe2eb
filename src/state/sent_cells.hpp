#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "parallel/world.hpp"
#include "state/body.hpp"

/// Which cells of its blocks a process sends, where those that touch them read not all within their reach:
/// contents, averages and walls are nine tenths of what the fields of a cell take, and are read near surfaces
/// only (docs/decisions/0055).
namespace recoil {

/// The contents of which cells.
enum class ContentsSent : std::uint8_t {
  all,
  between_steps,           // what gauges and stand-ins read: the nearest ones
  around_small_fragments,  // what redistribution reads: ReadAround::around_small
  of_cut_cells,            // of the end-of-step geometry: what the exchange along surfaces reads
  around_moves             // what the other moves of volume read
};
/// The averages of which cells.
enum class AveragesSent : std::uint8_t { all, asked };
/// What of the walls of cut cells.
enum class WallsSent : std::uint8_t {
  all,
  donors,  // whether they have a fit
  motion,  // that, how the matter moves there, and how the wall has moved
  asked    // that, and all of the walls that were asked for
};

/// Cells of all bodies in own blocks, by place in the layout; an empty list: none.
struct MarkedCells {
  std::vector<std::vector<std::uint8_t>> lists{};
  std::size_t bodies = 0;

  std::vector<std::uint8_t>& of(int slot, std::size_t body) {
    return lists[static_cast<std::size_t>(slot) * bodies + body];
  }
  const std::vector<std::uint8_t>& of(int slot, std::size_t body) const {
    return lists[static_cast<std::size_t>(slot) * bodies + body];
  }
};

/// What another process has asked for of own blocks, by slot and body: marks of the cells that donate to its
/// fits, and of the cut cells whose walls its ghosts follow.
struct AskedCells {
  MarkedCells donors{}, walls{};
};

/// How far around its blocks a process reads, and what of it.
struct ReadAround {
  int cells = widest_halo;
  ContentsSent contents = ContentsSent::all;
  AveragesSent averages = AveragesSent::all;
  WallsSent walls = WallsSent::all;
  const MarkedCells* around_small = nullptr;  // found by mark_around_small() in this step
  const AskedCells* asked = nullptr;          // by the process that this goes to
};

/// How far from its blocks a process reads these contents [cells].
constexpr int reach_of(ContentsSent which) {
  // Lone fragments within 3 cells go to an own cell, with the mean of their neighbourhoods, which reach 2
  // cells and take a slope from one more.
  if (which == ContentsSent::around_small_fragments) return 6;
  if (which == ContentsSent::around_moves) return 2;  // a cell around those that may send to own ones
  return which == ContentsSent::between_steps ? 4 : widest_halo;
}
/// How far from a small fragment redistribution reads contents [cells].
inline constexpr int around_small_cells = 3;

/// By place in the layout of an own block: whether the contents of a cell go to the processes whose blocks
/// touch it, however far away these are. Empty: of all cells.
template <int Dim>
std::vector<std::uint8_t> cells_with_sent_contents(const State<Dim>& state, const Body<Dim>& body, int slot,
                                                   const ReadAround& read);

/// What fits and ghosts of own blocks read of a process's blocks, as a message to it; and the same where it
/// arrives.
template <int Dim>
parallel::Bytes ask_for_cells(const State<Dim>& state, const typename Mesh<Dim>::Peer& peer);
template <int Dim>
AskedCells take_asked_cells(const State<Dim>& state, const typename Mesh<Dim>::Peer& peer,
                            const parallel::Bytes& bytes);

/// Writes and reads WallsSent::motion of a wall.
template <int Dim>
void pack_motion(const Wall<Dim>& wall, parallel::Bytes& bytes);
template <int Dim>
Wall<Dim> unpack_motion(parallel::Unpacker& from);

}  // namespace recoil
