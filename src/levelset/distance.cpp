#include "levelset/distance.hpp"

#include <algorithm>
#include <cmath>

namespace recoil {

namespace {

constexpr double pseudo_step = 0.45;  // of the smallest distance used

double minmod(double a, double b) { return a * b <= 0 ? 0 : std::abs(a) < std::abs(b) ? a : b; }

/// Distance from a cell to the zero of the level set towards its neighbour, by a parabola; -1 where there is
/// none. Values: two before, the cell, the neighbour, one after.
double zero_towards(double before, double here, double there, double after, double h) {
  if (here * there > 0) return -1;
  const double curvature = minmod(before - 2 * here + there, here - 2 * there + after);
  const double least = 1e-9 * h;
  if (std::abs(curvature) > 1e-6 * h) {
    const double q = 0.5 * curvature - here - there;
    const double root = std::sqrt(std::max(0.0, q * q - 4 * here * there));
    const double s = h * (0.5 + (here - there - (here > there ? root : -root)) / curvature);
    if (s >= 0 && s <= h) return std::max(s, least);
  }
  const double drop = std::abs(here - there);
  return std::max(drop > 1e-300 ? h * here / (here - there) : 0.5 * h, least);
}

/// One-sided slope from the cell (value p[0]) to its neighbour st away, second order, with the zero at
/// distance `zero` where the surface lies between (zero > 0). sign +1: towards higher index.
double slope(const double* p, int st, double zero, double h, double& nearest) {
  const double here = p[st] - 2 * p[0] + p[-st], there = p[2 * st] - 2 * p[st] + p[0];
  const double curvature = minmod(here, there) / (h * h);
  if (zero > 0) {
    nearest = std::min(nearest, zero);
    return -p[0] / zero - 0.5 * zero * curvature;
  }
  return (p[st] - p[0]) / h - 0.5 * h * curvature;
}

template <int Dim>
double relaxed(const double* p0, const double* p, const std::array<int, Dim>& stride, double h) {
  const double sign = p0[0] > 0 ? 1 : -1;
  double square = 0, nearest = h;
  for (int d = 0; d < Dim; ++d) {
    const int st = stride[static_cast<std::size_t>(d)];
    const double up = zero_towards(p0[-st], p0[0], p0[st], p0[2 * st], h);
    const double down = zero_towards(p0[st], p0[0], p0[-st], p0[-2 * st], h);
    const double high = slope(p, st, up, h, nearest), low = -slope(p, -st, down, h, nearest);
    const double a = sign > 0 ? std::max(low, 0.0) : std::min(low, 0.0);
    const double b = sign > 0 ? std::min(high, 0.0) : std::max(high, 0.0);
    square += std::max(a * a, b * b);
  }
  const double value = p[0] - pseudo_step * nearest * sign * (std::sqrt(square) - 1);
  return value * sign <= 0 ? 0.5 * p[0] : value;
}

template <int Dim>
bool in_band(const double* p, const std::array<int, Dim>& stride, double h) {
  if (std::abs(p[0]) < band_cells * h) return true;
  const double inside = (band_cells - 0.9) * h;
  for (int d = 0; d < Dim; ++d) {
    const int st = stride[static_cast<std::size_t>(d)];
    if (std::abs(p[st]) < inside || std::abs(p[-st]) < inside) return true;
  }
  return false;
}

}  // namespace

template <int Dim>
Foot<Dim> foot_point(const Grid<Dim>& grid, const Box<Dim>& window, const double* phi, const Index<Dim>& i) {
  Foot<Dim> f;
  f.normal = phi_normal(window, phi, i, grid.dx);
  f.distance = phi[window.at(i)];
  f.point = grid.centre(i) - f.distance * f.normal;
  const double rest = interpolate(grid, window, phi, f.point);
  if (std::abs(rest) < 0.5 * grid.dx) {
    f.point -= rest * f.normal;
    f.distance += rest;
  }
  return f;
}

template <int Dim>
void redistance(const State<Dim>& state, Body<Dim>& body, int slot, int sweeps, double frozen,
                Scratch& scratch) {
  const double h = state.grid().dx, far = far_cells * h;
  const Window<Dim> w(state.mesh, slot, 2 * sweeps);
  const auto n = static_cast<std::size_t>(w.size());
  double* p0 = scratch.take<double>(n);
  w.gather([&](int s) { return body.present(s) ? body.at(s).phi.data() : nullptr; }, far, Beyond::extend, p0);
  double *p = scratch.take<double>(n), *next = scratch.take<double>(n);
  std::copy(p0, p0 + n, p);
  std::copy(p0, p0 + n, next);
  std::array<int, Dim> stride{};
  for (int d = 0; d < Dim; ++d) stride[static_cast<std::size_t>(d)] = w.stride(d);
  for (int sweep = 1; sweep <= sweeps; ++sweep) {
    for_each(w.inner().grown(2 * (sweeps - sweep)), [&](const Index<Dim>& i) {
      const int k = w.at(i);
      if (p0[k] == 0 || std::abs(p0[k]) < frozen * h || !in_band<Dim>(p0 + k, stride, h)) return;
      next[k] = std::clamp(relaxed<Dim>(p0 + k, p + k, stride, h), -far, far);
    });
    std::copy(next, next + n, p);
  }
  double* out = body.at(slot).phi_next.data();
  for_each(w.inner(), [&](const Index<Dim>& i) { out[w.cell(i)] = p[w.at(i)]; });
}

#define RECOIL_INSTANTIATE(Dim)                                                                            \
  template Foot<Dim> foot_point<Dim>(const Grid<Dim>&, const Box<Dim>&, const double*, const Index<Dim>&); \
  template void redistance<Dim>(const State<Dim>&, Body<Dim>&, int, int, double, Scratch&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
