#include "problem/start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "levelset/transport.hpp"
#include "problem/shape.hpp"

namespace recoil {

namespace {

template <int Dim>
Vec<Dim> first_components(const config::Vector& v) {
  Vec<Dim> x;
  for (int d = 0; d < Dim; ++d) x[d] = v[d];
  return x;
}

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

/// Velocity at the start of a body at x [m/s]: of its motion, of its turning, and away from a point or the
/// axis.
template <int Dim>
Vec<Dim> velocity_at(const config::Body& body, const Vec<Dim>& x) {
  Vec<Dim> u = first_components<Dim>(body.velocity);
  if constexpr (Dim > 1) {
    const Vec<Dim> r = x - first_components<Dim>(body.spin_centre);
    u[0] -= body.spin[2] * r[1];
    u[1] += body.spin[2] * r[0];
    if constexpr (Dim == 3) {
      u[0] += body.spin[1] * r[2];
      u[1] -= body.spin[0] * r[2];
      u[2] += body.spin[0] * r[1] - body.spin[1] * r[0];
    }
  }
  if (body.radial_velocity != 0) {
    Vec<Dim> away;
    if (body.radial_from_axis)
      away[0] = x[0];
    else
      away = x - first_components<Dim>(body.radial_centre);
    if (norm(away) > 0) u += (body.radial_velocity / norm(away)) * away;
  }
  return u;
}

template <int Dim>
void fill_block(const Grid<Dim>& grid, const Box<Dim>& cells, const config::Body& from,
                const std::function<double(const Vec<Dim>&)>& distance, const Material& material,
                BodyBlock<Dim>& b) {
  using C = Components<Dim>;
  const Box<Dim> layout = grid.layout();
  const auto n = static_cast<std::size_t>(layout.size());
  const double rho = density(material);
  for_each(cells, [&](const Index<Dim>& i) {
    const auto k = static_cast<std::size_t>(layout.at(i - cells.lo));
    const Vec<Dim> x = grid.centre(i);
    const double full = grid.full_volume(i);
    double v = b.phi[k] < -1.8 * grid.dx ? full
               : b.phi[k] > 1.8 * grid.dx
                   ? 0
                   : inside_part(distance, x, grid.dx, grid.axisymmetric) * grid.dx_power(Dim);
    if (std::abs(v - full) < 1e-12 * full) v = full;
    if (v < 1e-12 * full) v = 0;
    b.volume[k] = v;
    const Vec<Dim> u = velocity_at(from, x);
    b.contents[k] = v * rho;
    for (std::size_t d = 0; d < Dim; ++d) b.contents[(C::u + d) * n + k] = v * rho * u[static_cast<int>(d)];
    b.contents[C::energy * n + k] = v * rho * 0.5 * dot(u, u);
  });
}

template <int Dim>
void place_body(State<Dim>& state, int m, const config::Body& from,
                const std::function<double(const Vec<Dim>&)>& distance) {
  const Grid<Dim>& grid = state.grid();
  Body<Dim>& body = state.bodies[m];
  const double far = far_cells * grid.dx;
  const Box<Dim> layout = grid.layout();
  for (int slot = 0; slot < state.mesh.local(); ++slot) {
    const Box<Dim> cells = state.mesh.block(slot).cells;
    bool needed = false;
    for_each(cells.grown(2), [&](const Index<Dim>& i) {
      const double s = distance(grid.centre(i));
      needed = needed || (body.rigid ? std::abs(s) : s) < band_cells * grid.dx;
    });
    if (!needed) continue;
    enter_block(body, slot, grid);
    BodyBlock<Dim>& b = body.at(slot);
    for_each(cells, [&](const Index<Dim>& i) {
      b.phi[layout.at(i - cells.lo)] = std::clamp(distance(grid.centre(i)), -far, far);
    });
    b.phi_midstep = b.phi;
    if (!body.rigid) fill_block(grid, cells, from, distance, body.material, b);
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

/// A free body must be modelled whole: half of one would be pushed off its plane of symmetry.
template <int Dim>
void check_whole(const Grid<Dim>& grid, const std::string& name,
                 const std::function<double(const Vec<Dim>&)>& distance) {
  for (int d = 0; d < Dim; ++d)
    for (int side = 0; side < 2; ++side) {
      if (grid.edge[d][side] != Edge::reflect) continue;
      if (grid.axisymmetric && d == 0 && side == 0) continue;
      Box<Dim> layer = grid.domain();
      (side == 0 ? layer.hi : layer.lo)[d] = side == 0 ? layer.lo[d] + 1 : layer.hi[d] - 1;
      for_each(layer, [&](const Index<Dim>& i) {
        if (distance(grid.centre(i)) < -0.5 * grid.dx)
          throw InputError(
              fmt::format("error: the free rigid body '{}' is cut by a plane of symmetry, axis {}\n"
                          "   = help: model it whole, or take out its mass: then it keeps its velocity",
                          name, d));
      });
    }
}

template <int Dim>
RigidMotion<Dim> rigid_motion(const Grid<Dim>& grid, const config::Body& from,
                              const std::function<double(const Vec<Dim>&)>& distance) {
  RigidMotion<Dim> m;
  m.distance = distance;
  Vec<3> spin;
  for (int d = 0; d < 3; ++d) spin[d] = from.spin[d];
  set_moving(m, first_components<Dim>(from.velocity), spin);
  m.start_centre = m.centre = first_components<Dim>(from.spin_centre);
  if (!(from.mass > 0)) return m;
  check_whole(grid, from.name, distance);
  Vec<3> inertia;
  for (int d = 0; d < 3; ++d) inertia[d] = from.inertia[d];
  set_free(m, from.mass / (grid.axisymmetric ? 2 * std::numbers::pi : 1), inertia);
  return m;
}

template <int Dim>
void find_overlaps_in(const config::Case& c, config::Diagnostics& out) {
  const Grid<Dim> grid = make_grid<Dim>(c);
  std::vector<std::function<double(const Vec<Dim>&)>> distance;
  for (const auto& body : c.bodies) distance.push_back(signed_distance<Dim>(body.shape, c.domain));
  const std::size_t n = distance.size();
  std::vector<double> deepest(n * n, 0), phi(n);
  std::vector<Vec<Dim>> place(n * n);
  for_each(grid.domain(), [&](const Index<Dim>& i) {
    const Vec<Dim> x = grid.centre(i);
    for (std::size_t m = 0; m < n; ++m) phi[m] = distance[m](x);
    for (std::size_t m = 0; m < n; ++m)
      for (std::size_t q = m + 1; q < n; ++q) {
        const double overlap = -(phi[m] + phi[q]);
        if (std::max(phi[m], phi[q]) > 0.5 * grid.dx || overlap <= deepest[m * n + q]) continue;
        deepest[m * n + q] = overlap;
        place[m * n + q] = x;
      }
  });
  for (std::size_t m = 0; m < n; ++m)
    for (std::size_t q = m + 1; q < n; ++q) {
      if (deepest[m * n + q] <= 1e-6 * grid.dx) continue;
      std::string at;
      for (int d = 0; d < Dim; ++d) at += fmt::format("{}{:.4g}", d ? ", " : "", place[m * n + q][d] * 1e3);
      out.error(c.bodies[q].shape.place,
                fmt::format("bodies '{}' and '{}' overlap by {:.4g} mm near ({}) mm", c.bodies[m].name,
                            c.bodies[q].name, deepest[m * n + q] * 1e3, at),
                fmt::format("move or cut one of them; bodies may touch, as at a common face"));
    }
}

}  // namespace

template <int Dim>
Grid<Dim> make_grid(const config::Case& c) {
  Grid<Dim> g;
  g.dx = c.mesh.finest;
  g.axisymmetric = c.domain.geometry == config::Geometry::axisymmetric;
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
          "error: axis {} of the domain is {:.6g} cells long, but its closed ends need whole cells\n"
          "   = help: mesh.finest = \"{:.6g} mm\" gives {} cells",
          d, length, length * g.dx / std::round(length) * 1e3, std::round(length)));
  }
  g.block = choose_block<Dim>(g.cells, g.edge, c.mesh.block);
  return g;
}

template <int Dim>
State<Dim> make_state(const config::Case& c, const std::vector<Material>& materials,
                      const parallel::World& world) {
  if (c.bodies.size() > most_bodies)
    throw InputError(fmt::format("error: {} bodies, at most {} are possible", c.bodies.size(), most_bodies));
  const Grid<Dim> grid = make_grid<Dim>(c);
  std::vector<std::function<double(const Vec<Dim>&)>> distance;
  for (const auto& body : c.bodies) distance.push_back(signed_distance<Dim>(body.shape, c.domain));
  const auto weight = [&](const Box<Dim>& cells) {
    // Work follows matter: what the middle of the block is inside of, or near.
    Vec<Dim> middle;
    double half = 0;
    for (int d = 0; d < Dim; ++d) {
      middle[d] = grid.origin[d] + 0.5 * (cells.lo[d] + cells.hi[d]) * grid.dx;
      half = std::max(half, 0.5 * cells.extent(d) * grid.dx);
    }
    int w = 1;
    for (std::size_t m = 0; m < distance.size(); ++m)
      if (!c.bodies[m].rigid && distance[m](middle) < half) w += 20;
    return w;
  };
  State<Dim> state{Mesh<Dim>(grid, world, weight), {}, {}, {}};
  for (std::size_t m = 0; m < c.bodies.size(); ++m) {
    Body<Dim> body;
    body.name = c.bodies[m].name;
    body.blocks.resize(static_cast<std::size_t>(state.mesh.slots()));
    if (c.bodies[m].rigid) {
      body.rigid = rigid_motion(grid, c.bodies[m], distance[m]);
    } else {
      body.material = materials[m];
      body.temperature = TemperatureLaw(body.material.thermal, body.material.eos);
    }
    state.bodies.push_back(std::move(body));
    place_body(state, static_cast<int>(m), c.bodies[m], distance[m]);
  }
  const auto n = c.bodies.size();
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = a + 1; b < n; ++b)
      state.contact.push_back(contact_law(c.contact.between(c.bodies[a].name, c.bodies[b].name)));
  state.ledger.resize(static_cast<std::size_t>(state.mesh.local()));
  state.contacts.resize(state.ledger.size());
  for (auto& l : state.ledger) {
    l.pairs.resize(n * (n - 1) / 2);
    l.edges.resize(n);
    l.failures.resize(n);
  }
  return state;
}

void find_overlaps(const config::Case& c, config::Diagnostics& out) {
  switch (config::dimension(c.domain.geometry)) {
    case 1:
      return find_overlaps_in<1>(c, out);
    case 2:
      return find_overlaps_in<2>(c, out);
    default:
      return find_overlaps_in<3>(c, out);
  }
}

#define RECOIL_INSTANTIATE(Dim)                                                          \
  template Grid<Dim> make_grid<Dim>(const config::Case&);                                \
  template State<Dim> make_state<Dim>(const config::Case&, const std::vector<Material>&, \
                                      const parallel::World&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
