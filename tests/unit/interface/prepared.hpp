#pragma once

#include <cstddef>
#include <vector>

#include "../cutcell/bodies.hpp"
#include "dynamics/primitives.hpp"
#include "interface/donors.hpp"
#include "interface/fit.hpp"

namespace recoil {

/// Bodies cut, filled with one state each, averaged, and with their fits chosen: ready for the walls of a
/// stage.
template <int Dim>
struct Prepared {
  State<Dim> state;
  Counters counters;

  Prepared(const Grid<Dim>& grid, const std::vector<Distance<Dim>>& shapes,
           const std::vector<Primitives<Dim>>& fill, const Material& material = samples::copper())
      : state(make_test_state<Dim>(grid, shapes, material)) {
    cut_all(state, Surfaces::shared);
    for (int m = 0; m < state.count(); ++m) fill_body(state, m, per_volume<Dim>(material, fill[m]));
    prepare();
  }
  /// After the volumes, contents or the kind of a body have changed.
  void prepare() {
    cut_all(state, Surfaces::shared);
    for_each_body([&](Body<Dim>& body, int s, Scratch&) {
      choose_roles(state, body, s, counters);
      average_primitives(state, body, s, counters);
    });
    for_each_body(
        [&](Body<Dim>& body, int s, Scratch& scratch) { choose_donors(state, body, s, counters, scratch); });
  }
  template <class F>
  void for_each_body(F&& f) {
    Scratch scratch;
    for (int s = 0; s < state.mesh.local(); ++s)
      for (auto& body : state.bodies) {
        if (body.rigid) continue;
        const Scratch::Frame frame(scratch);
        f(body, s, scratch);
      }
  }
  void evaluate() {
    for_each_body(
        [&](Body<Dim>& body, int s, Scratch& scratch) { evaluate_fits(state, body, s, counters, scratch); });
  }
  /// Calls f(wall, cut cell, index) for the walls of a body.
  template <class F>
  void for_each_wall(int body, F&& f) {
    for (int s = 0; s < state.mesh.local(); ++s) {
      auto& b = state.bodies[body].at(s);
      for (std::size_t m = 0; m < b.walls.size(); ++m)
        f(b.walls[m], b.geometry.cuts[m],
          state.mesh.block(s).cells.lo + state.grid().layout().index(b.geometry.cuts[m].cell));
    }
  }
};

/// Matter at rest density without stress, moving.
template <int Dim>
Primitives<Dim> moving(const Material& material, const Vec<Dim>& u) {
  Primitives<Dim> w{};
  w[0] = density(material);
  for (int d = 0; d < Dim; ++d) w[Components<Dim>::u + d] = u[d];
  return w;
}

}  // namespace recoil
