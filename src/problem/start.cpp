#include "problem/start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "config/geometry.hpp"
#include "core/error.hpp"
#include "levelset/transport.hpp"
#include "material/starting_state.hpp"
#include "problem/loads.hpp"
#include "problem/rigid_start.hpp"
#include "problem/shape.hpp"
#include "problem/starting_velocity.hpp"

namespace recoil {

namespace {

using config::first_components;

Edge edge_of(config::Boundary b) {
  switch (b) {
    case config::Boundary::outflow:
      return Edge::outflow;
    case config::Boundary::periodic:
      return Edge::periodic;
    default:
      return Edge::reflect;
  }
}

template <int Dim>
void fill_block(const Grid<Dim>& grid, const Box<Dim>& cells,
                const std::function<double(const Vec<Dim>&)>& distance,
                const std::function<Vec<Dim>(const Vec<Dim>&)>& velocity, const StartingState& state,
                BodyBlock<Dim>& b) {
  using C = Components<Dim>;
  const Box<Dim> layout = grid.layout();
  const auto n = static_cast<std::size_t>(layout.size());
  const double rho = state.density;
  for_each(cells, [&](const Index<Dim>& i) {
    const auto k = static_cast<std::size_t>(layout.at(i - cells.lo));
    const Vec<Dim> x = grid.centre(i);
    const double full = grid.full_volume(i);
    double v = b.phi[k] < -1.8 * grid.dx ? full
               : b.phi[k] > 1.8 * grid.dx
                   ? 0
                   : inside_part(distance, x, grid.dx, grid.radial_power) * grid.dx_power(Dim);
    if (std::abs(v - full) < 1e-12 * full) v = full;
    if (v < 1e-12 * full) v = 0;
    if (v == 0) return;
    b.volume[k] = v;
    const Vec<Dim> u = velocity(x);
    b.contents[k] = v * rho;
    for (std::size_t d = 0; d < Dim; ++d) b.contents[(C::u + d) * n + k] = v * rho * u[static_cast<int>(d)];
    b.contents[C::energy * n + k] = v * rho * (0.5 * dot(u, u) + state.energy);
    b.contents[C::temperature_rise * n + k] = v * rho * state.heat;
  });
}

template <int Dim>
void place_body(State<Dim>& state, int m, const config::Body& from, const config::Domain& domain,
                const std::function<double(const Vec<Dim>&)>& distance) {
  Body<Dim>& body = state.bodies[m];
  const double far = far_cells * state.grid().dx;
  const Box<Dim> layout = state.grid().layout();
  const StartingState matter =
      body.rigid ? StartingState{}
                 : state_at_start(body.material, from.pressure, from.temperature, from.name);
  for (int slot = 0; slot < state.mesh.local(); ++slot) {
    const Grid<Dim>& grid = state.grid(slot);
    const Box<Dim> cells = state.mesh.block(slot).cells;
    const bool finest = state.mesh.block(slot).level == 0;  // others hold no surface
    bool needed = false;
    for_each(finest ? cells.grown(2) : cells, [&](const Index<Dim>& i) {
      const double s = distance(grid.centre(i));
      needed = needed || (finest ? (body.rigid ? std::abs(s) : s) < far : !body.rigid && s < 0);
    });
    if (!needed) continue;
    enter_block(body, slot, state.grid());
    BodyBlock<Dim>& b = body.at(slot);
    for_each(cells, [&](const Index<Dim>& i) {
      b.phi[layout.at(i - cells.lo)] = std::clamp(distance(grid.centre(i)), -far, far);
    });
    b.phi_midstep = b.phi;
    if (body.rigid) continue;
    fill_block(grid, cells, distance, starting_velocity<Dim>(from, domain, grid.dx), matter, b);
  }
}

ContactLaw contact_law(const config::ContactChoice& choice) {
  using From = config::ContactChoice::Mode;
  using enum ContactLaw::Mode;
  return {choice.mode == From::bonded     ? bonded
          : choice.mode == From::friction ? friction
                                          : separable,
          choice.friction};
}

/// None where the body is not lit. What it is made of has been checked (app/check).
template <int Dim>
std::optional<DetonationFront<Dim>> detonation_front(const config::Body& from, const config::Domain& domain,
                                                     const Material& material) {
  const Jwl* explosive = std::get_if<Jwl>(&material.eos);
  if (!explosive || from.detonation.points.empty()) return {};
  DetonationFront<Dim> front;
  for (const config::Vector& p : from.detonation.points) front.points.push_back(first_components<Dim>(p));
  front.direction = first_components<Dim>(from.detonation.direction);
  front.time = from.detonation.time;
  front.velocity = explosive->detonation_velocity;
  front.energy = explosive->detonated_energy();
  const Periods<Dim> periods = periods_of<Dim>(from.shape, domain);
  front.middle = periods.middle;
  for (int d = 0; d < Dim; ++d) {
    const auto e = static_cast<std::size_t>(d);
    if (domain.boundary[e][0] != config::Boundary::periodic) continue;
    front.period[d] = domain.hi[e] - domain.lo[e];
    front.across[d] = periods.length[d] > 0 ? 0 : 1;
  }
  return front;
}

/// A block's middle, and half of its diagonal and of its longest edge [m].
template <int Dim>
struct Ball {
  Vec<Dim> middle;
  double radius = 0, widest = 0;
};

template <int Dim>
Ball<Dim> ball_around(const Grid<Dim>& finest, const Place<Dim>& place) {
  const Grid<Dim> grid = finest.at_level(place.level);
  const Box<Dim> cells = grid.cells_of(place.at);
  Ball<Dim> ball;
  for (int d = 0; d < Dim; ++d) {
    const double half = 0.5 * cells.extent(d) * grid.dx;
    ball.middle[d] = grid.origin[d] + 0.5 * (cells.lo[d] + cells.hi[d]) * grid.dx;
    ball.radius += half * half;
    ball.widest = std::max(ball.widest, half);
  }
  ball.radius = std::sqrt(ball.radius);
  return ball;
}

/// Whether a block is cut at the start: a surface, or a block beside one with a surface, may be in it.
template <int Dim>
bool starts_finer(const config::Case& c, const std::vector<std::function<double(const Vec<Dim>&)>>& distance,
                  const Grid<Dim>& grid, const Place<Dim>& place) {
  const Ball<Dim> ball = ball_around(grid, place);
  int widest = 0;
  for (int d = 0; d < Dim; ++d) widest = std::max(widest, grid.block[d]);
  const double near = ball.radius + std::sqrt(static_cast<double>(Dim)) * (widest + far_cells + 2) * grid.dx;
  for (std::size_t m = 0; m < distance.size(); ++m)
    if (!c.bodies[m].rigid && std::abs(distance[m](ball.middle)) < near) return true;
  return false;
}

}  // namespace

namespace {

static_assert(config::MeshChoice::least_block >= widest_halo, "blocks reach only into those beside them");

/// Makes the domain larger at open ends until it holds whole cells of the coarsest level.
template <int Dim>
void fit_levels(Grid<Dim>& g, int levels, const std::vector<std::string>& axes) {
  const int widest = 1 << (levels - 1);
  for (int d = 0; d < Dim; ++d) {
    const int lacking = (widest - g.cells[d] % widest) % widest;
    if (lacking == 0) continue;
    const auto& edge = g.edge[static_cast<std::size_t>(d)];
    if (edge[0] != Edge::outflow && edge[1] != Edge::outflow)
      throw InputError(fmt::format(
          "error: the domain has {} of the finest cells along {}, but its closed ends need whole "
          "cells of all {} levels\n   = help: a multiple of {} cells, such as {}, or fewer levels",
          g.cells[d], axes[static_cast<std::size_t>(d)], levels, widest, g.cells[d] + lacking));
    g.cells[d] += lacking;
    if (edge[1] != Edge::outflow) g.origin[d] -= lacking * g.dx;
  }
}

}  // namespace

template <int Dim>
Grid<Dim> make_grid(const config::Case& c) {
  Grid<Dim> g;
  g.dx = c.mesh.finest;
  g.radial_power = config::radial_power(c.domain.geometry);
  const std::vector<std::string> axes = config::axes_of(c.domain.geometry);
  for (int d = 0; d < Dim; ++d) {
    const auto e = static_cast<std::size_t>(d);
    for (std::size_t side = 0; side < 2; ++side) g.edge[e][side] = edge_of(c.domain.boundary[e][side]);
    const double length = (c.domain.hi[e] - c.domain.lo[e]) / g.dx;
    const bool open = g.edge[e][0] == Edge::outflow && g.edge[e][1] == Edge::outflow;
    const double shift = open ? c.mesh.offset : 0;
    g.origin[d] = c.domain.lo[e] - shift * g.dx;
    if (g.edge[e][0] == Edge::outflow &&
        g.edge[e][1] == Edge::reflect)  // the closed end is where the domain says
      g.origin[d] = c.domain.hi[e] - std::ceil(length - 1e-9) * g.dx;
    g.cells[d] = static_cast<int>(std::ceil(length + shift - 1e-9));
    const bool both_closed = g.edge[e][0] != Edge::outflow && g.edge[e][1] != Edge::outflow;
    if (both_closed && std::abs(length - std::round(length)) > 1e-6)
      throw InputError(fmt::format(
          "error: the domain is {:.6g} cells long along {}, but its closed ends need whole cells\n"
          "   = help: mesh.finest = \"{:.6g} mm\" gives {} cells",
          length, axes[e], length * g.dx / std::round(length) * 1e3, std::round(length)));
  }
  if (c.mesh.levels > 1 && c.method.scheme != "conservative")
    throw InputError(
        "error: a mesh of several levels (mesh.levels) needs method.scheme = \"conservative\"\n"
        "   = help: the schemes of ghost fluids have cells of one size: remove mesh.levels");
  fit_levels(g, c.mesh.levels, axes);
  g.block = choose_block<Dim>(g.cells, g.edge, c.mesh.block, c.mesh.levels);
  return g;
}

template <int Dim>
std::vector<double> cells_at_start(const config::Case& c) {
  const Grid<Dim> grid = make_grid<Dim>(c);
  std::vector<std::function<double(const Vec<Dim>&)>> distance;
  for (const auto& body : c.bodies) distance.push_back(signed_distance<Dim>(body.shape, c.domain));
  std::vector<double> cells(static_cast<std::size_t>(c.mesh.levels));
  const std::function<void(const Place<Dim>&)> visit = [&](const Place<Dim>& place) {
    const Grid<Dim> own = grid.at_level(place.level);
    if (!Box<Dim>{{}, own.blocks()}.contains(place.at)) return;
    const Ball<Dim> ball = ball_around(grid, place);
    bool holds = false;
    for (std::size_t m = 0; m < distance.size(); ++m)
      holds = holds || (!c.bodies[m].rigid && distance[m](ball.middle) < ball.widest);
    if (place.level > 0 && starts_finer<Dim>(c, distance, grid, place)) {
      for (unsigned child = 0; child < 1U << Dim; ++child) visit(place.finer(child));
    } else if (holds) {
      cells[static_cast<std::size_t>(place.level)] += own.cells_of(place.at).size();
    }
  };
  const int coarsest = c.mesh.levels - 1;
  for_each(Box<Dim>{{}, grid.at_level(coarsest).blocks()}, [&](const Index<Dim>& at) {
    visit(Place<Dim>{coarsest, at});
  });
  return cells;
}

template <int Dim>
State<Dim> make_state(const config::Case& c, const std::vector<Material>& materials,
                      const parallel::World& world) {
  if (c.bodies.size() > most_bodies)
    throw InputError(fmt::format("error: {} bodies, at most {} are possible", c.bodies.size(), most_bodies));
  const Grid<Dim> grid = make_grid<Dim>(c);
  std::vector<std::function<double(const Vec<Dim>&)>> distance;
  for (const auto& body : c.bodies) distance.push_back(signed_distance<Dim>(body.shape, c.domain));
  const auto weight = [&](const Place<Dim>& place) {
    // Work follows matter: what the middle of the block is inside of, or near.
    const Ball<Dim> ball = ball_around(grid, place);
    int w = 1;
    for (std::size_t m = 0; m < distance.size(); ++m)
      if (!c.bodies[m].rigid && distance[m](ball.middle) < ball.widest) w += 20;
    return w;
  };
  State<Dim> state{
      Mesh<Dim>(
          grid, c.mesh.levels, world,
          [&](const Place<Dim>& place) { return starts_finer<Dim>(c, distance, grid, place); }, weight),
      {},
      {},
      {}};
  for (std::size_t m = 0; m < c.bodies.size(); ++m) {
    Body<Dim> body;
    body.name = c.bodies[m].name;
    body.blocks.resize(static_cast<std::size_t>(state.mesh.slots()));
    if (c.bodies[m].rigid) {
      body.rigid = rigid_motion<Dim>(c.bodies[m], c, grid);
      if (body.rigid->period != Vec<Dim>{})  // with its images across the edges
        distance[m] = [rigid = *body.rigid](const Vec<Dim>& x) {
          return distance_at(rigid, pose_after(rigid, 0), x);
        };
    } else {
      body.material = materials[m];
      body.temperature = temperature_law(body.material);
      body.detonation = detonation_front<Dim>(c.bodies[m], c.domain, body.material);
    }
    const auto source = std::ranges::find(c.bodies, c.bodies[m].fragments_of, &config::Body::name);
    if (source != c.bodies.end()) body.fragments_of = static_cast<int>(source - c.bodies.begin());
    state.bodies.push_back(std::move(body));
    place_body(state, static_cast<int>(m), c.bodies[m], c.domain, distance[m]);
  }
  const auto n = c.bodies.size();
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = a + 1; b < n; ++b)
      state.contact.push_back(contact_law(c.contact.between(c.bodies[a].name, c.bodies[b].name)));
  state.loads = surface_loads<Dim>(c);
  state.ledger.resize(static_cast<std::size_t>(state.mesh.local()));
  state.contacts.resize(state.ledger.size());
  for (auto& l : state.ledger) {
    l.pairs.resize(n * (n - 1) / 2);
    l.edges.resize(n);
    l.failures.resize(n);
    l.released.resize(n);
    l.loads.resize(state.loads.empty() ? 0 : n);
  }
  return state;
}

#define RECOIL_INSTANTIATE(Dim)                                                          \
  template Grid<Dim> make_grid<Dim>(const config::Case&);                                \
  template std::vector<double> cells_at_start<Dim>(const config::Case&);                 \
  template State<Dim> make_state<Dim>(const config::Case&, const std::vector<Material>&, \
                                      const parallel::World&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
