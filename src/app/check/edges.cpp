#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "app/check/checks.hpp"
#include "config/geometry.hpp"
#include "config/shape/slabs.hpp"
#include "core/index.hpp"
#include "core/vec.hpp"
#include "material/eos/isentrope.hpp"
#include "problem/shape.hpp"
#include "problem/start.hpp"

namespace recoil::app {

namespace {

using config::Body;
using config::Domain;
using config::endless;

struct DomainEdge {
  std::size_t axis = 0, side = 0;
};

/// How far a body reaches beyond an edge [m], to 1/100 of the domain, by points in front of the edge;
/// endless: to the other end of a domain's length, and then surely on purpose.
template <int Dim>
double sampled_reach(const Body& body, const Domain& domain, DomainEdge edge) {
  constexpr int along = 100, across = Dim == 3 ? 40 : 400;
  const auto corner = config::first_components<Dim>(domain.lo);
  const Vec<Dim> size = config::first_components<Dim>(domain.hi) - corner;
  Box<Dim> points;
  for (int d = 0; d < Dim; ++d) points.hi[d] = d == static_cast<int>(edge.axis) ? along : across;
  double reach = 0;
  for_each(points, [&](const Index<Dim>& i) {
    Vec<Dim> x;
    for (int d = 0; d < Dim; ++d) x[d] = corner[d] + size[d] * (i[d] + 0.5) / points.hi[d];
    const int a = static_cast<int>(edge.axis);
    const double beyond = size[a] * (i[a] + 0.5) / along;
    x[a] = edge.side == 0 ? domain.lo[edge.axis] - beyond : domain.hi[edge.axis] + beyond;
    if (config::distance_to(body.shape, x, domain) < 0)
      reach = std::max(reach, i[a] + 1 == along ? endless : beyond);
  });
  return reach;
}

double reach_beyond(const Body& body, const Domain& domain, DomainEdge edge) {
  const config::Extent e = extent_of(body.shape, domain.geometry);
  if (e.plain)
    return edge.side == 0 ? domain.lo[edge.axis] - e.lo[edge.axis] : e.hi[edge.axis] - domain.hi[edge.axis];
  switch (config::dimension(domain.geometry)) {
    case 1:
      return sampled_reach<1>(body, domain, edge);
    case 2:
      return sampled_reach<2>(body, domain, edge);
    default:
      return sampled_reach<3>(body, domain, edge);
  }
}

/// When a body that flies at a plane of symmetry meets its mirror image [s], before anything else gets there;
/// endless: it does not, or that cannot be told from its extent.
double meets_itself(const config::Case& c, const Body& body, DomainEdge edge) {
  const config::Extent e = extent_of(body.shape, c.domain.geometry);
  const double speed = (edge.side == 0 ? -1 : 1) * body.velocity[edge.axis];
  const auto distance = [&](const config::Extent& of) {
    return edge.side == 0 ? of.lo[edge.axis] - c.domain.lo[edge.axis]
                          : c.domain.hi[edge.axis] - of.hi[edge.axis];
  };
  const bool apart = e.plain && distance(e) > 1e-2 * c.mesh.finest;
  if (!apart || !(speed > 0)) return endless;
  const bool alone = std::ranges::none_of(c.bodies, [&](const Body& other) {
    if (&other == &body || other.takes_up_fragments()) return false;
    const config::Extent o = extent_of(other.shape, c.domain.geometry);
    return !o.plain || distance(o) < distance(e);
  });
  return alone ? distance(e) / speed : endless;
}

/// A body and its mirror image are one level set: where they meet they weld.
void check_mirror_images(LoadedCase& loaded) {
  const config::Case& c = loaded.contents;
  const std::vector<std::string> axes = config::axes_of(c.domain.geometry);
  for (std::size_t m = 0; m < c.bodies.size(); ++m) {
    const Body& body = c.bodies[m];
    if (body.rigid || body.takes_up_fragments() || is_gas(loaded.materials[m].eos)) continue;
    for (DomainEdge edge; edge.axis < axes.size(); ++edge.axis)
      for (edge.side = 0; edge.side < 2; ++edge.side) {
        if (c.domain.boundary[edge.axis][edge.side] != config::Boundary::symmetry) continue;
        const double time = meets_itself(c, body, edge);
        if (time >= c.time.end) continue;
        const std::string& axis = axes[edge.axis];
        const double at = (edge.side == 0 ? c.domain.lo : c.domain.hi)[edge.axis] * 1e3;
        loaded.found.warning(
            place_of(loaded, "body." + body.name + ".velocity", body.place),
            fmt::format(
                "'{}' meets its mirror image in the plane of symmetry {} = {:.4g} mm at {:.4g} us, and will "
                "weld with it",
                body.name, axis, at, time * 1e6),
            fmt::format(
                "to let it part again: a rigid half-space with its surface at {} = {:.4g} mm, inside a "
                "domain that reaches beyond",
                axis, at));
      }
  }
}

/// Whether a body lies in the cells at an edge.
template <int Dim>
bool reaches_edge(const config::Case& c, const Body& body, DomainEdge edge) {
  const Grid<Dim> grid = make_grid<Dim>(c);
  const auto distance = signed_distance<Dim>(body.shape, c.domain);
  const int d = static_cast<int>(edge.axis);
  Box<Dim> layer = grid.domain();
  (edge.side == 0 ? layer.hi : layer.lo)[d] = edge.side == 0 ? layer.lo[d] + 1 : layer.hi[d] - 1;
  bool reaches = false;
  for_each(layer,
           [&](const Index<Dim>& i) { reaches = reaches || distance(grid.centre(i)) < -0.5 * grid.dx; });
  return reaches;
}

bool reaches_edge(const config::Case& c, const Body& body, DomainEdge edge) {
  switch (config::dimension(c.domain.geometry)) {
    case 1:
      return reaches_edge<1>(c, body, edge);
    case 2:
      return reaches_edge<2>(c, body, edge);
    default:
      return reaches_edge<3>(c, body, edge);
  }
}

/// A free body must be modelled whole: half of one would be pushed off its plane of symmetry.
void check_free_bodies(LoadedCase& loaded) {
  const config::Case& c = loaded.contents;
  const std::vector<std::string> axes = config::axes_of(c.domain.geometry);
  for (const Body& body : c.bodies)
    for (DomainEdge edge; edge.axis < axes.size(); ++edge.axis)
      for (edge.side = 0; edge.side < 2; ++edge.side) {
        const bool is_free = body.rigid && body.mass > 0;
        if (!is_free || c.domain.boundary[edge.axis][edge.side] != config::Boundary::symmetry) continue;
        if (!reaches_edge(c, body, edge)) continue;
        loaded.found.error(
            body.shape.place,
            fmt::format("the free rigid body '{}' is cut by the plane of symmetry {} = {:.4g} mm", body.name,
                        axes[edge.axis], (edge.side == 0 ? c.domain.lo : c.domain.hi)[edge.axis] * 1e3),
            "model it whole, or take out its mass: then it keeps its velocity");
      }
}

}  // namespace

void check_edges(LoadedCase& loaded) {
  check_free_bodies(loaded);
  check_mirror_images(loaded);
  const config::Case& c = loaded.contents;
  const std::vector<std::string> axes = config::axes_of(c.domain.geometry);
  for (const Body& body : c.bodies) {
    if (body.rigid || body.takes_up_fragments()) continue;
    for (DomainEdge edge; edge.axis < axes.size(); ++edge.axis)
      for (edge.side = 0; edge.side < 2; ++edge.side) {
        if (c.domain.boundary[edge.axis][edge.side] != config::Boundary::outflow) continue;
        const double reach = reach_beyond(body, c.domain, edge);
        if (!std::isfinite(reach) || !(reach > 1e-3 * c.mesh.finest)) continue;
        double end = edge.side == 0 ? c.domain.lo[edge.axis] - reach : c.domain.hi[edge.axis] + reach;
        if (edge.axis == 0 && config::has_radius(c.domain.geometry)) end = std::max(end, 0.0);
        loaded.found.warning(
            body.shape.place,
            fmt::format("'{}' is cut off at the {} end of {}, an outflow edge: {:.3g} mm of it lies beyond",
                        body.name, edge.side == 0 ? "low" : "high", axes[edge.axis], reach * 1e3),
            fmt::format(
                "let {} of the domain reach to {:.4g} mm and more, or end the body at the edge if it shall "
                "go on there",
                axes[edge.axis], end * 1e3));
      }
  }
}

}  // namespace recoil::app
