#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "dynamics/convex_eno.hpp"
#include "dynamics/flux.hpp"

namespace recoil {

/// Flux and contents, per volume, of one cell along `Axis`, and its fastest signal |u| + c_L.
template <int Dim>
struct CellFlux {
  std::array<double, Components<Dim>::contents> contents, flux;
  double speed = 0;
};

/// The conserved quantities of a cell and what they flow with.
/// @param at place of the cell in the arrays of `in`.
template <int Dim, int Axis, bool Shear>
CellFlux<Dim> cell_flux(const AnyEos& eos, const Row<Dim>& in, std::ptrdiff_t at) {
  using C = Components<Dim>;
  const auto value = [&](int c) { return in.primitive[static_cast<std::size_t>(c) * in.cells + at]; };
  const double rho = value(C::rho), u = value(C::u + Axis);
  double energy = eos.energy(rho, value(C::p), value(C::crushed));
  if (eos.barotropic) energy += value(C::extra);
  CellFlux<Dim> f;
  f.contents[C::rho] = rho;
  for (int d = 0; d < Dim; ++d) {
    f.contents[C::u + d] = rho * value(C::u + d);
    energy += 0.5 * value(C::u + d) * value(C::u + d);
  }
  f.contents[C::energy] = rho * energy;
  for (int c = C::s; c < C::contents; ++c) f.contents[c] = rho * value(c);
  for (std::size_t c = 0; c < f.flux.size(); ++c) f.flux[c] = u * f.contents[c];
  f.flux[C::u + Axis] -= in.stress[at];
  f.flux[C::energy] -= in.stress[at] * u;
  for (int t = 0; t < Dim && Shear; ++t) {
    if (t == Axis) continue;
    const double tau = value(C::s + C::stress(Axis, t));
    f.flux[C::u + t] -= tau;
    f.flux[C::energy] -= tau * value(C::u + t);
  }
  f.speed = std::abs(u) + in.impedance[at] / rho;
  return f;
}

/// As face_fluxes() of dynamics/flux.hpp, by convex ENO3 of the split fluxes (f + a q)/2 and (f - a q)/2 of
/// each conserved quantity, with a the larger signal speed of the two cells beside the face (local
/// Lax-Friedrichs). The velocities are the means of both one-sided reconstructions.
/// @returns 0: there is nothing to fall back to.
template <int Dim, int Axis, bool Shear>
int face_fluxes_llf(const AnyEos& eos, const Row<Dim>& in, const FaceFlux<Dim>& out) {
  using C = Components<Dim>;
  for (int i = 0; i < in.count; ++i) {
    std::array<CellFlux<Dim>, 6> cell;  // three on each side
    for (int k = 0; k < 6; ++k)
      cell[k] = cell_flux<Dim, Axis, Shear>(eos, in, in.first + i + (k - 3) * in.step);
    const double a = std::max(cell[2].speed, cell[3].speed);
    const auto to = static_cast<std::size_t>(out.first + i);
    for (std::size_t c = 0; c < C::contents; ++c) {
      const auto up = [&](std::size_t k) { return 0.5 * (cell[k].flux[c] + a * cell[k].contents[c]); };
      const auto down = [&](std::size_t k) { return 0.5 * (cell[k].flux[c] - a * cell[k].contents[c]); };
      out.flux[c * out.faces + to] = convex_eno3(up(0), up(1), up(2), up(3), up(4)) +
                                     convex_eno3(down(5), down(4), down(3), down(2), down(1));
    }
    for (std::size_t d = 0; d < Dim; ++d) {
      const double* u = in.primitive + (C::u + d) * in.cells + in.first + i;
      const std::ptrdiff_t st = in.step;
      out.velocity[d * out.faces + to] = 0.5 * (convex_eno3(u[-3 * st], u[-2 * st], u[-st], u[0], u[st]) +
                                                convex_eno3(u[2 * st], u[st], u[0], u[-st], u[-2 * st]));
    }
  }
  return 0;
}

}  // namespace recoil
