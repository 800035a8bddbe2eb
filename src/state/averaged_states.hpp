#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "state/body.hpp"

namespace recoil {

/// Where and when states of one body were averaged with their neighbours.
struct AveragedStates {
  struct Line {
    std::int64_t count = 0;
    double first = std::numeric_limits<double>::infinity(), last = -1;  // s
    std::array<double, 3> place{};                                      // m, of the last one
  };
  std::size_t bodies = 0;
  std::vector<Line> lines;  // by local slot and body

  Line& at(int slot, std::size_t body) { return lines[static_cast<std::size_t>(slot) * bodies + body]; }
  const Line& at(int slot, std::size_t body) const {
    return lines[static_cast<std::size_t>(slot) * bodies + body];
  }
};

template <int Dim>
void make_room(AveragedStates& all, const State<Dim>& state) {
  all.bodies = state.bodies.size();
  all.lines.resize(static_cast<std::size_t>(state.mesh.local()) * all.bodies);
}

/// Notes `count` states of a body in a block that are marked (Role::has_bad_contents).
template <int Dim>
void note_averaged(AveragedStates& all, const State<Dim>& state, const Body<Dim>& body, int slot,
                   std::int64_t count) {
  const auto m = static_cast<std::size_t>(&body - state.bodies.data());
  AveragedStates::Line& line = all.lines[static_cast<std::size_t>(slot) * all.bodies + m];
  line.count += count;
  line.first = line.first < state.time ? line.first : state.time;
  line.last = state.time;
  const auto& role = body.at(slot).role;
  for (std::size_t k = 0; k < role.size(); ++k) {
    if ((role[k] & has_bad_contents) == 0) continue;
    const Index<Dim> i =
        state.mesh.block(slot).cells.lo + state.grid(slot).layout().index(static_cast<int>(k));
    const Vec<Dim> x = state.grid(slot).centre(i);
    for (int d = 0; d < Dim; ++d) line.place[d] = x[d];
    return;
  }
}

}  // namespace recoil
