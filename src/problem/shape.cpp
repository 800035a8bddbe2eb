#include "problem/shape.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <variant>
#include <vector>

#include "core/index.hpp"

namespace recoil {

namespace {

template <int Dim>
using Distance = std::function<double(const Vec<Dim>&)>;

/// A cell is decided where the surface is farther than its corners; else it is halved, down to 1/64.
template <int Dim>
double refine(const std::function<double(const Vec<Dim>&)>& distance, const Vec<Dim>& centre, double width,
              int depth, int radial_power) {
  const double s = distance(centre), r = std::abs(centre[0]);
  const double weight = radial_power == 0 ? 1 : radial_power == 1 ? r : r * r + width * width / 12;
  if (std::abs(s) >= 0.5 * width * std::sqrt(static_cast<double>(Dim))) return s < 0 ? weight : 0;
  if (depth == 0) return weight * std::clamp(0.5 - s / width, 0.0, 1.0);
  double sum = 0;
  for (int c = 0; c < 1 << Dim; ++c) {
    Vec<Dim> x = centre;
    for (int d = 0; d < Dim; ++d) x[d] += ((c >> d & 1) != 0 ? 0.25 : -0.25) * width;
    sum += refine(distance, x, 0.5 * width, depth - 1, radial_power);
  }
  return sum / (1 << Dim);
}

/// f(x moved by -1, 0 or 1 periods along each axis).
template <int Dim, class F>
void for_each_image(const Vec<Dim>& x, const Vec<Dim>& period, F&& f) {
  Box<Dim> sides;
  for (int d = 0; d < Dim; ++d) {
    sides.lo[d] = period[d] > 0 ? -1 : 0;
    sides.hi[d] = period[d] > 0 ? 2 : 1;
  }
  for_each(sides, [&](const Index<Dim>& side) {
    Vec<Dim> image = x;
    for (int d = 0; d < Dim; ++d) image[d] += side[d] * period[d];
    f(image);
  });
}

/// x moved by whole periods to where the body is: within half a period of its middle.
template <int Dim>
Vec<Dim> near_body(Vec<Dim> x, const Periods<Dim>& periods) {
  for (int d = 0; d < Dim; ++d)
    if (periods.length[d] > 0)
      x[d] -= periods.length[d] * std::round((x[d] - periods.middle[d]) / periods.length[d]);
  return x;
}

template <int Dim>
Distance<Dim> distance_without_images(const config::Shape& shape, const config::Domain& domain) {
  return [shape = config::continued(shape, domain), domain](const Vec<Dim>& x) {
    return config::distance_to(shape, x, domain);
  };
}

template <int Dim>
Distance<Dim> distance_with_images(const config::Shape& shape, const config::Domain& domain);

template <int Dim>
std::vector<Distance<Dim>> distances_of(const std::vector<config::Shape>& parts,
                                        const config::Domain& domain) {
  std::vector<Distance<Dim>> all;
  for (const config::Shape& part : parts) all.push_back(distance_with_images<Dim>(part, domain));
  return all;
}

/// The distance to a union of parts. None: everything is far away.
template <int Dim>
double least_of(const std::vector<Distance<Dim>>& parts, const Vec<Dim>& x) {
  double least = 1e300;
  for (const auto& part : parts) least = std::min(least, part(x));
  return least;
}

/// Parts that are put together or cut out have images of their own: one may reach across the period, another
/// not.
template <int Dim>
Distance<Dim> distance_with_images(const config::Shape& shape, const config::Domain& domain) {
  if (const auto* all = std::get_if<config::Union>(&shape.form))
    return [parts = distances_of<Dim>(all->parts, domain)](const Vec<Dim>& x) { return least_of(parts, x); };
  if (const auto* all = std::get_if<config::Lattice>(&shape.form))
    return [parts = distances_of<Dim>(all->copies, domain)](const Vec<Dim>& x) { return least_of(parts, x); };
  if (const auto* rest = std::get_if<config::Difference>(&shape.form))
    return [parts = distances_of<Dim>(rest->parts, domain)](const Vec<Dim>& x) {
      double most = parts.front()(x);
      for (std::size_t k = 1; k < parts.size(); ++k) most = std::max(most, -parts[k](x));
      return most;
    };
  const Periods<Dim> periods = periods_of<Dim>(shape, domain);
  if (periods.length == Vec<Dim>{}) return distance_without_images<Dim>(shape, domain);
  const Distance<Dim> one = distance_without_images<Dim>(shape, without_ends(domain, periods.length));
  return [one, periods](const Vec<Dim>& x) {
    const Vec<Dim> near = near_body(x, periods);
    double least = one(near);
    for_each_image(near, periods.length, [&](const Vec<Dim>& image) { least = std::min(least, one(image)); });
    return least;
  };
}

}  // namespace

template <int Dim>
Distance<Dim> signed_distance(const config::Shape& shape, const config::Domain& domain) {
  const auto periodic = [](const auto& ends) { return ends[0] == config::Boundary::periodic; };
  return std::ranges::any_of(domain.boundary, periodic) ? distance_with_images<Dim>(shape, domain)
                                                        : distance_without_images<Dim>(shape, domain);
}

template <int Dim>
config::Domain without_ends(config::Domain domain, const Vec<Dim>& period) {
  constexpr double far = 1e3;  // periods
  for (int d = 0; d < Dim; ++d) {
    if (period[d] == 0) continue;
    const auto e = static_cast<std::size_t>(d);
    domain.lo[e] -= far * period[d];
    domain.hi[e] += far * period[d];
    domain.boundary[e] = {config::Boundary::outflow, config::Boundary::outflow};
  }
  return domain;
}

template <int Dim>
Periods<Dim> periods_of(const config::Shape& shape, const config::Domain& domain) {
  const config::Bounds bounds = config::bounds_of(shape, domain);
  Periods<Dim> periods;
  for (int d = 0; d < Dim; ++d) {
    const auto e = static_cast<std::size_t>(d);
    if (domain.boundary[e][0] != config::Boundary::periodic) continue;
    const double length = domain.hi[e] - domain.lo[e], near = 1e-9 * length;
    const bool across = bounds.lo[e] <= domain.lo[e] + near && bounds.hi[e] >= domain.hi[e] - near;
    if (across || bounds.hi[e] - bounds.lo[e] > length + near) continue;
    periods.length[d] = length;
    periods.middle[d] = 0.5 * (bounds.lo[e] + bounds.hi[e]);
  }
  return periods;
}

template <int Dim>
std::function<Vec<Dim>(const Vec<Dim>&)> within_shape(const config::Shape& shape,
                                                      const config::Domain& domain) {
  const Periods<Dim> periods = periods_of<Dim>(shape, domain);
  if (periods.length == Vec<Dim>{}) return [](const Vec<Dim>& x) { return x; };
  return [one = distance_without_images<Dim>(shape, without_ends(domain, periods.length)),
          periods](const Vec<Dim>& x) {
    Vec<Dim> nearest = near_body(x, periods);
    for_each_image(nearest, periods.length, [&](const Vec<Dim>& image) {
      if (one(image) < one(nearest)) nearest = image;
    });
    return nearest;
  };
}

template <int Dim>
double inside_part(const std::function<double(const Vec<Dim>&)>& distance, const Vec<Dim>& centre, double dx,
                   int radial_power) {
  return refine(distance, centre, dx, Dim == 3 ? 4 : 6, radial_power);
}

#define RECOIL_INSTANTIATE(Dim)                                                                            \
  template Distance<Dim> signed_distance<Dim>(const config::Shape&, const config::Domain&);                \
  template Periods<Dim> periods_of<Dim>(const config::Shape&, const config::Domain&);                      \
  template config::Domain without_ends<Dim>(config::Domain, const Vec<Dim>&);                              \
  template std::function<Vec<Dim>(const Vec<Dim>&)> within_shape<Dim>(const config::Shape&,                \
                                                                      const config::Domain&);              \
  template double inside_part<Dim>(const std::function<double(const Vec<Dim>&)>&, const Vec<Dim>&, double, \
                                   int);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
