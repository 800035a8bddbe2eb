#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "dynamics/block_work.hpp"
#include "dynamics/face_rows.hpp"
#include "dynamics/failed_matter.hpp"
#include "dynamics/flux.hpp"

/// Faces beside failed matter (theory: fracture).
namespace recoil::detail {

/// A face whose sides part: each moves with a velocity of its own.
template <int Dim>
struct PartedFace {
  Index<Dim> face;
  int at = 0;         // its place among the faces
  Vec<Dim> velocity;  // of the upper side less that of the lower one, which stands at the face
};

/// One side of a face, as its cell has it.
template <int Dim>
struct CellSide {
  Primitives<Dim> value;
  double stress = 0, sound = 0, shear = 0;  // sigma_nn, c_L, shear modulus

  double impedance() const { return value[0] * sound; }
};

template <int Dim, int Axis>
CellSide<Dim> side_of(const AnyEos& eos, const StateBounds& bounds, const Work<Dim>& w, std::ptrdiff_t k) {
  using C = Components<Dim>;
  CellSide<Dim> s;
  for (std::size_t c = 0; c < s.value.size(); ++c) s.value[c] = w.primitive[c * w.wide + k];
  s.stress = w.stress[k];
  s.shear = w.shear[k];
  s.sound = bounds.longitudinal_speed(
      s.value[C::rho], eos.wave_speed_squared(s.value[C::rho], s.value[C::p], s.value[C::crushed]), s.shear);
  return s;
}

/// Velocity of a side that nothing holds: u -+ sigma/Z, v -+ tau/Z_s. @param out +1 for the lower side of the
/// face, -1 for the upper one.
template <int Dim, int Axis, bool Shear>
Vec<Dim> parting_velocity(const CellSide<Dim>& s, double out) {
  using C = Components<Dim>;
  Vec<Dim> u;
  for (int d = 0; d < Dim; ++d) {
    u[d] = s.value[C::u + d];
    if (d == Axis)
      u[d] -= out * s.stress / s.impedance();
    else if (Shear)
      u[d] -= out * s.value[C::s + C::stress(Axis, d)] / std::sqrt(s.value[C::rho] * s.shear);
  }
  return u;
}

/// Specific internal energy of a side, that of its voids with it.
template <int Dim>
double energy_of(const AnyEos& eos, const Primitives<Dim>& w) {
  using C = Components<Dim>;
  return eos.energy(w[C::rho], w[C::p], w[C::crushed]) + w[C::extra];
}

/// What one side sends through a face with the speed `mass`/area, without stress.
template <int Dim>
void add_free_flow(const AnyEos& eos, const Primitives<Dim>& w, const Vec<Dim>& u, double mass,
                   const FaceFlux<Dim>& out) {
  using C = Components<Dim>;
  if (mass == 0) return;
  *out.flux_of(C::rho) += mass;
  for (int d = 0; d < Dim; ++d) *out.flux_of(C::u + d) += mass * u[d];
  *out.flux_of(C::energy) += mass * (energy_of<Dim>(eos, w) + 0.5 * dot(u, u));
  for (std::size_t c = C::s; c < C::contents; ++c) *out.flux_of(c) += mass * w[c];
}

/// The face between two cells by their averages: HLLC with the energy of voids.
template <int Dim, int Axis, bool Shear>
void solve_by_averages(const AnyEos& eos, const Work<Dim>& w, const CellSide<Dim>& low,
                       const CellSide<Dim>& high, std::ptrdiff_t at, const FaceFlux<Dim>& out) {
  using C = Components<Dim>;
  FaceValues<Dim> left, right;
  for (std::size_t c = 0; c < low.value.size(); ++c) {
    left.value[c][0] = low.value[c];
    right.value[c][0] = high.value[c];
  }
  left.stress[0] = low.stress;
  right.stress[0] = high.stress;
  solve_faces<Dim, Axis, Shear>(eos, w.row(at, w.window.stride(Axis), 1), left, 0, right, 0, out);
  if (!eos.barotropic)
    *out.flux_of(C::energy) +=
        *out.flux_of(C::rho) * (*out.velocity_along(Axis) >= 0 ? low : high).value[C::extra];
}

/// Whether the face that has been solved bears tension.
template <int Dim, int Axis>
bool bears_tension(const FaceFlux<Dim>& out) {
  using C = Components<Dim>;
  return *out.flux_of(C::rho) * *out.velocity_along(Axis) - *out.flux_of(C::u + Axis) > 0;
}

/// Whether a void is in reach of a face's stencil.
template <int Dim>
bool reaches_void(const Work<Dim>& w, std::ptrdiff_t at, std::ptrdiff_t step) {
  bool any = false;
  for (int s = -3; s < 3; ++s) any = any || w.failed[at + s * step] == with_void;
  return any;
}

/// Whether a face is solved by the averages of its two cells, and needs no others.
template <int Dim>
bool between_voids(const Work<Dim>& w, std::ptrdiff_t at, std::ptrdiff_t step) {
  return w.failed && (w.role[at] & w.role[at - step] & valued) != 0 && reaches_void(w, at, step);
}

/// Solves the faces beside failed matter again: by the averages of the cells where a void is in reach of the
/// stencil; without any stress, each side on its own, where failed matter would bear tension.
/// @param parted out: the faces of the second kind; @returns how many.
template <int Dim, int Axis, bool Shear>
int solve_failed_faces(const AnyEos& eos, const Work<Dim>& w, const Faces<Dim>& out,
                       PartedFace<Dim>* parted) {
  using C = Components<Dim>;
  const StateBounds bounds(eos);
  const std::ptrdiff_t step = w.window.stride(Axis);
  int count = 0;
  for_each(out.box, [&](const Index<Dim>& i) {
    const int face = out.box.at(i);
    if (out.area[face] == 0) return;
    const std::ptrdiff_t at = w.window.at(i);
    const bool voids = reaches_void(w, at, step);
    const bool failed = w.failed[at] != intact || w.failed[at - step] != intact;
    if (!voids && !failed) return;
    const bool has_low = !w.role || (w.role[at - step] & valued) != 0,
               has_high = !w.role || (w.role[at] & valued) != 0;
    if (!has_low && !has_high) return;
    const FaceFlux<Dim> flux = out.flux_at(face);
    if (!voids && !bears_tension<Dim, Axis>(flux)) return;
    const auto low = side_of<Dim, Axis>(eos, bounds, w, has_low ? at - step : at),
               high = side_of<Dim, Axis>(eos, bounds, w, has_high ? at : at - step);
    solve_by_averages<Dim, Axis, Shear>(eos, w, low, high, at, flux);
    if (!failed || !bears_tension<Dim, Axis>(flux)) return;
    const Vec<Dim> u = parting_velocity<Dim, Axis, Shear>(low, 1),
                   v = parting_velocity<Dim, Axis, Shear>(high, -1);
    for (std::size_t c = 0; c < C::contents; ++c) *flux.flux_of(c) = 0;
    add_free_flow<Dim>(eos, low.value, u, low.value[C::rho] * std::max(u[Axis], 0.0), flux);
    add_free_flow<Dim>(eos, high.value, v, high.value[C::rho] * std::min(v[Axis], 0.0), flux);
    for (int d = 0; d < Dim; ++d) *flux.velocity_along(d) = u[d];
    parted[count++] = {i, face, v - u};
  });
  return count;
}

/// The cell above a face that has parted moves with its own side of it.
template <int Dim, int Axis>
void part_gradient(const Faces<Dim>& in, const PartedFace<Dim>& parted, Work<Dim>& w) {
  if (!w.cells.contains(parted.face)) return;
  const int k = w.cells.at(parted.face);
  for (int d = 0; d < Dim; ++d) {
    w.gradient[(d * Dim + Axis) * w.n + k] -= in.area[parted.at] * parted.velocity[d];
    if (w.grid.has_radius() && Axis == 0)
      w.radial[d * w.n + k] += w.grid.low_face_part(parted.face[0]) * parted.velocity[d];
  }
}

}  // namespace recoil::detail
