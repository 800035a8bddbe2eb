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

}  // namespace

void check_edges(LoadedCase& loaded) {
  const config::Case& c = loaded.contents;
  const std::vector<std::string> axes = config::axes_of(c.domain.geometry);
  for (const Body& body : c.bodies) {
    if (body.rigid || body.takes_up_fragments()) continue;
    for (DomainEdge edge; edge.axis < axes.size(); ++edge.axis)
      for (edge.side = 0; edge.side < 2; ++edge.side) {
        if (c.domain.boundary[edge.axis][edge.side] != config::Boundary::outflow) continue;
        const double reach = reach_beyond(body, c.domain, edge);
        if (!std::isfinite(reach) || !(reach > 1e-3 * c.mesh.finest)) continue;
        const double end = edge.side == 0 ? c.domain.lo[edge.axis] - reach : c.domain.hi[edge.axis] + reach;
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
