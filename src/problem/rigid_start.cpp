#include "problem/rigid_start.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <numbers>

#include "problem/centroid.hpp"
#include "problem/shape.hpp"

namespace recoil {

namespace {

using config::first_components;

template <int Dim>
using Distance = std::function<double(const Vec<Dim>&)>;

/// Whether a body lies in a line of cells along an axis from one end of the domain to the other.
template <int Dim>
bool fills_axis(const Grid<Dim>& grid, const Distance<Dim>& distance, int axis) {
  Box<Dim> layer = grid.domain();
  layer.hi[axis] = layer.lo[axis] + 1;
  bool fills = false;
  for_each(layer, [&](Index<Dim> i) {
    for (; !fills && i[axis] < grid.cells[axis]; ++i[axis])
      if (distance(grid.centre(i)) >= 0) return;
    fills = true;
  });
  return fills;
}

/// After how much of its way the body meets the domain again [m]. Of one that never moves the shape has the
/// images; one that fills an axis continues beyond both ends of it, and would meet itself there.
template <int Dim>
Vec<Dim> period_of(const Grid<Dim>& grid, const RigidMotion<Dim>& m, bool free) {
  Vec<Dim> period;
  if (!free && never_moves(m)) return period;
  for (int d = 0; d < Dim; ++d)
    if (grid.periodic(d) && !fills_axis(grid, m.distance, d)) period[d] = grid.cells[d] * grid.dx;
  return period;
}

/// The centre of mass if the case gives it, else that of the shape in the domain, and of all of it along
/// periods.
template <int Dim>
Vec<Dim> middle_of(const config::Body& body, const config::Domain& domain, const RigidMotion<Dim>& m) {
  if (body.has_centre_of_mass) return first_components<Dim>(body.centre_of_mass);
  const config::Bounds bounds = config::bounds_of(body.shape, domain);
  Vec<Dim> lo, hi;
  for (int d = 0; d < Dim; ++d) {
    const auto e = static_cast<std::size_t>(d);
    lo[d] = std::clamp(bounds.lo[e], domain.lo[e] - m.period[d], domain.hi[e] + m.period[d]);
    hi[d] = std::clamp(bounds.hi[e], domain.lo[e] - m.period[d], domain.hi[e] + m.period[d]);
  }
  return centroid(m.distance, lo, hi, config::radial_power(domain.geometry));
}

}  // namespace

template <int Dim>
RigidMotion<Dim> prescribed_motion(const config::Body& body, const config::Case& c, const Grid<Dim>& grid) {
  RigidMotion<Dim> m;
  m.distance = signed_distance<Dim>(body.shape, c.domain);
  set_moving(m, first_components<Dim>(body.velocity), first_components<3>(body.spin));
  if (!body.velocity_history.empty()) {
    m.history.emplace();
    for (const config::TimedVelocity& t : body.velocity_history) {
      m.history->times.push_back(t.time);
      m.history->values.push_back(first_components<Dim>(t.velocity));
    }
    m.velocity = m.mean_velocity = m.history->at(0);
  }
  m.start_centre = m.centre = first_components<Dim>(body.spin_centre);
  m.period = period_of(grid, m, body.mass > 0);
  if (m.period != Vec<Dim>{}) m.distance = signed_distance<Dim>(body.shape, without_ends(c.domain, m.period));
  m.start_middle = middle_of(body, c.domain, m);
  return m;
}

template <int Dim>
RigidMotion<Dim> rigid_motion(const config::Body& body, const config::Case& c, const Grid<Dim>& grid) {
  RigidMotion<Dim> m = prescribed_motion<Dim>(body, c, grid);
  if (!(body.mass > 0)) return m;
  Vec<3> inertia;
  for (int d = 0; d < 3; ++d) inertia[d] = body.inertia[static_cast<std::size_t>(d)];
  set_free(m, body.mass / (grid.has_radius() ? 2 * std::numbers::pi : 1), inertia);
  return m;
}

#define RECOIL_INSTANTIATE(Dim)                                                              \
  template RigidMotion<Dim> prescribed_motion<Dim>(const config::Body&, const config::Case&, \
                                                   const Grid<Dim>&);                        \
  template RigidMotion<Dim> rigid_motion<Dim>(const config::Body&, const config::Case&, const Grid<Dim>&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
