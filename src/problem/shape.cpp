#include "problem/shape.hpp"

#include <algorithm>
#include <cmath>

namespace recoil {

namespace {

/// A cell is decided where the surface is farther than its corners; else it is halved, down to 1/64.
template <int Dim>
double refine(const std::function<double(const Vec<Dim>&)>& distance, const Vec<Dim>& centre, double width,
              int depth, bool axisymmetric) {
  const double s = distance(centre), weight = axisymmetric ? std::abs(centre[0]) : 1;
  if (std::abs(s) >= 0.5 * width * std::sqrt(static_cast<double>(Dim))) return s < 0 ? weight : 0;
  if (depth == 0) return weight * std::clamp(0.5 - s / width, 0.0, 1.0);
  double sum = 0;
  for (int c = 0; c < 1 << Dim; ++c) {
    Vec<Dim> x = centre;
    for (int d = 0; d < Dim; ++d) x[d] += ((c >> d & 1) != 0 ? 0.25 : -0.25) * width;
    sum += refine(distance, x, 0.5 * width, depth - 1, axisymmetric);
  }
  return sum / (1 << Dim);
}

}  // namespace

template <int Dim>
std::function<double(const Vec<Dim>&)> signed_distance(const config::Shape& shape,
                                                       const config::Domain& domain) {
  return [shape = config::continued(shape, domain), domain](const Vec<Dim>& x) {
    return config::distance_to(shape, x, domain);
  };
}

template <int Dim>
double inside_part(const std::function<double(const Vec<Dim>&)>& distance, const Vec<Dim>& centre, double dx,
                   bool axisymmetric) {
  return refine(distance, centre, dx, Dim == 3 ? 4 : 6, axisymmetric);
}

#define RECOIL_INSTANTIATE(Dim)                                                                            \
  template std::function<double(const Vec<Dim>&)> signed_distance<Dim>(const config::Shape&,               \
                                                                       const config::Domain&);             \
  template double inside_part<Dim>(const std::function<double(const Vec<Dim>&)>&, const Vec<Dim>&, double, \
                                   bool);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
