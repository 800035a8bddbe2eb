#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "../core/random.hpp"
#include "../material/samples.hpp"
#include "../mesh/grids.hpp"
#include "cutcell/geometry.hpp"

/// States put together by hand: bodies by their distance functions, contents as the test wants them.
namespace recoil {

template <int Dim>
using Distance = std::function<double(const Vec<Dim>&)>;

template <int Dim>
Distance<Dim> ball(const Vec<Dim>& centre, double radius) {
  return [=](const Vec<Dim>& x) { return norm(x - centre) - radius; };
}

/// Matter where (x - point) . normal < 0; the normal need not be of length 1.
template <int Dim>
Distance<Dim> half_space(const Vec<Dim>& point, const Vec<Dim>& normal) {
  return [=](const Vec<Dim>& x) { return dot(x - point, unit(normal)); };
}

template <int Dim>
Vec<Dim> middle_of(const Grid<Dim>& grid) {
  Vec<Dim> x;
  for (int d = 0; d < Dim; ++d) x[d] = grid.origin[d] + 0.5 * grid.cells[d] * grid.dx;
  return x;
}

/// Bodies in every block, with their level sets and nothing in them.
template <int Dim>
State<Dim> make_test_state(const Grid<Dim>& grid, const std::vector<Distance<Dim>>& shapes,
                           const Material& material = samples::copper()) {
  State<Dim> state{make_test_mesh(grid), {}, {}, {}};
  const double far = far_cells * grid.dx;
  for (const auto& shape : shapes) {
    Body<Dim> body;
    body.name = "body" + std::to_string(state.count());
    body.material = material;
    body.temperature = temperature_law(material);
    body.blocks.resize(static_cast<std::size_t>(state.mesh.slots()));
    for (int s = 0; s < state.mesh.local(); ++s) {
      enter_block(body, s, grid);
      body.at(s).reach = body.at(s).matter = state.mesh.block(s).cells;
      for_each(state.mesh.block(s).cells, [&](const Index<Dim>& i) {
        const auto k = static_cast<std::size_t>(grid.layout().at(i - state.mesh.block(s).cells.lo));
        body.at(s).phi[k] = std::clamp(shape(grid.centre(i)), -far, far);
      });
      body.at(s).phi_midstep = body.at(s).phi;
      body.at(s).phi_next = body.at(s).phi;
    }
    state.bodies.push_back(std::move(body));
  }
  const auto n = state.bodies.size();
  state.contact.resize(n * (n - 1) / 2);
  state.ledger.resize(static_cast<std::size_t>(state.mesh.local()));
  state.contacts.resize(state.ledger.size());
  for (auto& l : state.ledger) {
    l.pairs.resize(n * (n - 1) / 2);
    l.edges.resize(n);
    l.failures.resize(n);
  }
  return state;
}

template <int Dim>
void cut_all(State<Dim>& state, Surfaces surfaces = Surfaces::own) {
  for (int s = 0; s < state.mesh.local(); ++s)
    for (const PhiAt when : {PhiAt::now, PhiAt::midstep}) {
      Scratch scratch;
      find_geometry(state, s, surfaces, when, scratch);
    }
}

/// Calls f(block's data, global index, place in the block's arrays) for every cell of a body.
template <int Dim, class F>
void for_each_piece(State<Dim>& state, int body, F&& f) {
  const Box<Dim> layout = state.grid().layout();
  for (int s = 0; s < state.mesh.local(); ++s) {
    const Box<Dim> cells = state.mesh.block(s).cells;
    BodyBlock<Dim>& b = state.bodies[body].at(s);
    for_each(cells, [&](const Index<Dim>& i) { f(b, i, static_cast<std::size_t>(layout.at(i - cells.lo))); });
  }
}

template <int Dim>
void set_piece(BodyBlock<Dim>& b, std::size_t k, double volume, const Contents<Dim>& per_volume) {
  b.volume[k] = volume;
  for (std::size_t c = 0; c < per_volume.size(); ++c)
    b.contents[c * b.volume.size() + k] = volume * per_volume[c];
}

/// V of a fragment by the end-of-step geometry.
template <int Dim>
double volume_by_phi(const Grid<Dim>& grid, const BodyBlock<Dim>& b, const Index<Dim>& i, std::size_t k) {
  switch (b.end_geometry.kind[k]) {
    case CellKind::empty:
      return 0;
    case CellKind::full:
      return grid.full_volume(i);
    default:
      return b.end_geometry.cuts[b.end_geometry.index[k]].volume;
  }
}

/// Fills a body by the end-of-step geometry with one state.
template <int Dim>
void fill_body(State<Dim>& state, int body, const Contents<Dim>& per_volume) {
  for_each_piece(state, body, [&](BodyBlock<Dim>& b, const Index<Dim>& i, std::size_t k) {
    set_piece(b, k, volume_by_phi(state.grid(), b, i, k), per_volume);
  });
}

/// Contents per volume of copper or another Mie-Grueneisen material in this state.
template <int Dim>
Contents<Dim> per_volume(const Material& material, const Primitives<Dim>& w) {
  using C = Components<Dim>;
  Contents<Dim> q{};
  const double rho = w[C::rho];
  double energy = std::visit([&](const auto& eos) { return eos.energy(rho, w[C::p]); }, material.eos);
  q[C::rho] = rho;
  for (std::size_t d = 0; d < Dim; ++d) {
    q[C::u + d] = rho * w[C::u + d];
    energy += 0.5 * w[C::u + d] * w[C::u + d];
  }
  q[C::energy] = rho * energy;
  for (std::size_t c = C::s; c < C::contents; ++c) q[c] = rho * w[c];
  return q;
}

/// A state with no component zero.
template <int Dim>
Primitives<Dim> some_primitives(const Material& material, std::uint64_t seed = 11) {
  using C = Components<Dim>;
  Random random(seed);
  Primitives<Dim> w{};
  w[C::rho] = density(material) * random(0.98, 1.05);
  for (int d = 0; d < Dim; ++d) w[C::u + d] = random(-300, 300);
  w[C::p] = random(0.5e9, 3e9);
  for (int c = 0; c < C::stresses; ++c) w[C::s + c] = random(-1e8, 1e8);
  w[C::ep] = random(0.1, 0.3);
  w[C::temperature_rise] = random(10, 50);
  w[C::damage] = random(0.2, 0.6);
  return w;
}

/// Sums over all cells: contents, then the volume.
template <int Dim>
std::vector<double> totals(State<Dim>& state, int body) {
  std::vector<double> sum(Components<Dim>::contents + 1);
  for_each_piece(state, body, [&](BodyBlock<Dim>& b, const Index<Dim>&, std::size_t k) {
    for (std::size_t c = 0; c + 1 < sum.size(); ++c) sum[c] += b.contents[c * b.volume.size() + k];
    sum.back() += b.volume[k];
  });
  return sum;
}

/// Calls f(slot, scratch) for all blocks, then puts the body's updates in place.
template <int Dim, class F>
void update_all(State<Dim>& state, int body, F&& f) {
  Scratch scratch;
  for (int s = 0; s < state.mesh.local(); ++s) {
    const Scratch::Frame frame(scratch);
    f(s, scratch);
  }
  for (int s = 0; s < state.mesh.local(); ++s) apply_updates(state.bodies[body].at(s));
}

}  // namespace recoil
