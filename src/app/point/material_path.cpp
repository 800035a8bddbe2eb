#include "app/point/material_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace recoil::app {

namespace {

Tensor stretching(double along, double across) {
  return {Vec<3>{{along, 0, 0}}, Vec<3>{{0, across, 0}}, Vec<3>{{0, 0, across}}};
}

/// Where the stress on the sides counts as none: a part of the bulk modulus.
constexpr double free_of_stress = 1e-12;

/// The rate of side strain [1/s] that leaves no stress on the sides after dt, by the secant rule from a
/// guess: the stress grows with it, in the elastic range at 2 (K + G/3) per strain.
double free_side_rate(const MaterialPoint& point, double along, double dt, double guess) {
  const Material& m = point.material();
  const double c = bulk_sound_speed(m), bulk = density(m) * c * c;
  const auto stress_on_sides = [&](double across) {
    MaterialPoint trial = point;
    trial.advance(stretching(along, across), dt);
    return trial.stress()[1][1];
  };
  double x0 = guess, f0 = stress_on_sides(x0);
  double x1 = x0 - f0 / (2 * (bulk + shear_modulus(m) / 3) * dt);
  for (int k = 0; k < 60; ++k) {
    if (std::abs(f0) <= free_of_stress * bulk) return x0;
    const double f1 = stress_on_sides(x1);
    const double next = f1 == f0 ? x1 : x1 - f1 * (x1 - x0) / (f1 - f0);
    x0 = x1, f0 = f1, x1 = next;
  }
  if (std::abs(f0) <= 1e3 * free_of_stress * bulk) return x0;
  throw PhysicsError(
      fmt::format("{}: no strain of the sides frees them of stress: {:.3g} Pa are left", m.name, f0));
}

PathPoint place(const MaterialPoint& point, double time, double strain, double side) {
  return {time, strain, side, point.internal_energy(), point.state()};
}

void check(const PathOrder& o) {
  if (!(o.rate > 0) || !std::isfinite(o.rate)) throw InputError("the strain rate of a path is above 0");
  if (o.steps < 1) throw InputError("a path takes at least one step to each strain");
  if (o.strains.empty()) throw InputError("a path needs a strain to go to");
  if (!std::ranges::all_of(o.strains, [](double s) { return std::isfinite(s); }))
    throw InputError("strains are finite numbers");
}

}  // namespace

std::vector<PathPoint> follow_path(const Material& material, const PathOrder& o) {
  check(o);
  MaterialPoint point(material, o.pressure, o.temperature);
  std::vector<PathPoint> path{place(point, 0, 0, 0)};
  double side = 0, time = 0, from = 0, across = 0;
  for (const double to : o.strains) {
    const double dt = std::abs(to - from) / (o.rate * o.steps), along = to > from ? o.rate : -o.rate;
    if (to == from) continue;
    across = -0.3 * along;
    for (int k = 1; k <= o.steps; ++k) {
      Tensor l = stretching(along, 0);
      if (o.kind == PathKind::uniaxial_stress) {
        across = free_side_rate(point, along, dt, across);
        l = stretching(along, across);
        side += across * dt;
      } else if (o.kind == PathKind::simple_shear) {
        l = {Vec<3>{{0, along, 0}}, {}, {}};
      }
      point.advance(l, dt);
      path.push_back(place(point, time + k * dt, from + (to - from) * k / o.steps, side));
    }
    time += o.steps * dt;
    from = to;
  }
  return path;
}

}  // namespace recoil::app
