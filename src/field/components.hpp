#pragma once

#include <array>
#include <cstddef>

namespace recoil {

/// Numbers of the components of a body's matter. Contents (extensive) and primitives share their places:
///   contents   rho, rho u [Dim], rho E, rho S [stresses], rho ep, rho theta, rho D        (times volume)
///   primitives rho,     u [Dim], p,         S [stresses],     ep,     theta,     D,     extra
/// S is the deviator; its out-of-plane part follows from the trace: 1-D holds xx; planar xx, yy, xy;
/// axisymmetric rr, zz, rz; 3-D xx, yy, xy, xz, yz. `theta` is the temperature rise by plastic work [K]
/// (temperature_rise), or of porous matter, which has no use for it, alpha0 - alpha, the part of its
/// distension that it has lost (crushed); D is the damage, 1 where matter has failed. D stands last of the
/// contents, so that kernels may leave it out where matter cannot fail. `extra` is e - e_eos(rho, p) [J/kg],
/// used by equations of state whose pressure does not know e, and by failed matter with voids.
template <int Dim>
struct Components {
  static constexpr int stresses = Dim == 1 ? 1 : Dim == 2 ? 3 : 5;
  static constexpr int rho = 0;
  static constexpr int u = 1;        // momentum in contents
  static constexpr int p = 1 + Dim;  // total energy in contents
  static constexpr int energy = p;
  static constexpr int s = 2 + Dim;
  static constexpr int ep = s + stresses;
  static constexpr int temperature_rise = ep + 1;
  static constexpr int crushed = temperature_rise;
  static constexpr int damage = temperature_rise + 1;
  static constexpr int contents = damage + 1;
  static constexpr int extra = contents;
  static constexpr int primitives = contents + 1;

  /// Place of S_ij among the stresses, or -1 for S_zz in 3-D, which is -(S_xx + S_yy).
  static constexpr int stress(int i, int j) {
    if (i > j) return stress(j, i);
    if constexpr (Dim == 3) {
      constexpr int table[3][3] = {{0, 2, 3}, {2, 1, 4}, {3, 4, -1}};
      return table[i][j];
    } else {
      return i == j ? i : 2;
    }
  }
};

/// Contents or rates of one cell.
template <int Dim>
using Contents = std::array<double, Components<Dim>::contents>;
/// Primitive state of one cell.
template <int Dim>
using Primitives = std::array<double, Components<Dim>::primitives>;

/// Sign with which a component continues across a reflecting face of an axis: bit d of flips set.
template <int Dim>
constexpr int component_sign(int component, unsigned flips) {
  using C = Components<Dim>;
  for (int d = 0; d < Dim; ++d)
    if (component == C::u + d) return (flips >> d & 1U) != 0 ? -1 : 1;
  for (int i = 0; i < Dim; ++i)
    for (int j = i + 1; j < Dim; ++j)
      if (component == C::s + C::stress(i, j)) return ((flips >> i ^ flips >> j) & 1U) != 0 ? -1 : 1;
  return 1;
}

}  // namespace recoil
