#include "problem/starting_velocity.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <cstddef>

#include "core/error.hpp"
#include "problem/shape.hpp"

namespace recoil {

namespace {

using config::first_components;

/// Velocity at the start of a body at x away from its centre or the axis [m/s].
template <int Dim>
Vec<Dim> radial_velocity_at(const config::Body& body, const Vec<Dim>& x, config::Geometry geometry) {
  Vec<Dim> away = x - first_components<Dim>(body.radial_centre);
  if (body.radial_from_axis) {
    away = {};
    away[0] = x[0];
  }
  const double distance = norm(away);
  if (distance == 0) return {};
  double speed = body.radial_velocity;
  if (body.radial_falls_from > 0 && distance > body.radial_falls_from) {
    using enum config::Geometry;
    const bool about_a_point =
        geometry == space || geometry == spherical || (geometry == axisymmetric && !body.radial_from_axis);
    speed *= std::pow(body.radial_falls_from / distance, about_a_point ? 2 : 1);
  }
  return (speed / distance) * away;
}

/// Velocity at the start of a body at x [m/s], but that of its formulas.
template <int Dim>
Vec<Dim> velocity_at(const config::Body& body, const Vec<Dim>& x, config::Geometry geometry) {
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
  if (body.radial_velocity != 0) u += radial_velocity_at(body, x, geometry);
  return u;
}

template <int Dim>
using Field = std::function<Vec<Dim>(const Vec<Dim>&)>;

/// A place inside the shape, as near to x as that may be: follows the distance down to a hundredth of a cell
/// below the surface. x itself where that leads nowhere.
template <int Dim>
Vec<Dim> into_shape(const std::function<double(const Vec<Dim>&)>& distance, const Vec<Dim>& x, double dx) {
  constexpr int most_steps = 8;
  const double step = 1e-4 * dx, depth = 0.01 * dx;
  Vec<Dim> at = x;
  for (int k = 0; k < most_steps; ++k) {
    const double s = distance(at);
    if (s < 0) return at;
    Vec<Dim> gradient;
    for (int d = 0; d < Dim; ++d) {
      Vec<Dim> ahead = at, behind = at;
      ahead[d] += step;
      behind[d] -= step;
      gradient[d] = (distance(ahead) - distance(behind)) / (2 * step);
    }
    const double square = dot(gradient, gradient);
    if (!(square > 0)) return x;
    at -= ((s + depth) / square) * gradient;
  }
  return distance(at) < 0 ? at : x;
}

/// The mean of f over those of the 2^Dim Gauss points of a cell of width dx about x that lie inside; where
/// none does, f at the nearest place inside.
template <int Dim, class F>
Vec<Dim> mean_inside(const F& f, const std::function<double(const Vec<Dim>&)>& distance, const Vec<Dim>& x,
                     double dx) {
  const double off = dx / std::sqrt(12);
  Vec<Dim> sum;
  int inside = 0;
  for (int corner = 0; corner < 1 << Dim; ++corner) {
    Vec<Dim> at = x;
    for (int d = 0; d < Dim; ++d) at[d] += (corner >> d & 1) != 0 ? off : -off;
    if (distance(at) >= 0) continue;
    sum += f(at);
    ++inside;
  }
  return inside > 0 ? (1.0 / inside) * sum : f(into_shape(distance, x, dx));
}

/// What the formulas of a body say; nothing where it has none.
template <int Dim>
Field<Dim> field_of(const config::Body& body, const config::Domain& domain, double dx) {
  if (!body.velocity_field.is_given()) return {};
  const auto value = [name = body.name,
                      formulas = config::evaluated(body.velocity_field, domain.geometry)](const Vec<Dim>& x) {
    config::Vector at{};
    for (int d = 0; d < Dim; ++d) at[static_cast<std::size_t>(d)] = x[d];
    const Vec<Dim> u = first_components<Dim>(formulas(at));
    if (std::isfinite(norm(u))) return u;
    throw InputError(fmt::format("error: the velocity-field of '{}' has no finite value at ({:.4g}) mm", name,
                                 fmt::join((1e3 * x).c, ", ")));
  };
  return [value, dx, distance = signed_distance<Dim>(body.shape, domain)](const Vec<Dim>& x) {
    return mean_inside(value, distance, x, dx);
  };
}

}  // namespace

template <int Dim>
Field<Dim> starting_velocity(const config::Body& body, const config::Domain& domain, double dx) {
  const Field<Dim> field = field_of<Dim>(body, domain, dx);
  if (body.spin == config::Vector{} && body.radial_velocity == 0 && !field)
    return [u = first_components<Dim>(body.velocity)](const Vec<Dim>&) { return u; };
  return [body, field, geometry = domain.geometry,
          own_place = within_shape<Dim>(body.shape, domain)](const Vec<Dim>& x) {
    const Vec<Dim> own = own_place(x);
    const Vec<Dim> u = velocity_at(body, own, geometry);
    return field ? u + field(own) : u;
  };
}

#define RECOIL_INSTANTIATE(Dim) \
  template Field<Dim> starting_velocity<Dim>(const config::Body&, const config::Domain&, double);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
