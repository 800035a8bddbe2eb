#pragma once

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"
#include "cutcell/moves_view.hpp"
#include "material/eos/isentrope.hpp"

/// How much volume a cell may take in its own state from a neighbour that has little (docs/decisions/0071,
/// 0072).
namespace recoil {

inline constexpr double least_state_fill = 0.02;  // of a cell; below it a fragment's state carries no volume
inline constexpr double least_left = 0.5;         // part of its density that what gives keeps
inline constexpr double heat_slack = 1e-2;        // of c0^2, by which what gives may become colder
inline constexpr double like_states = 100;        // times what is left may leave: taker and giver are alike
inline constexpr double no_volume = 1e-13;        // part of a cell that is rounding

/// How much colder [J/kg] what is left of a cell may become. Gases have no such scale: any.
inline double slack_of_heat(const Material& material) {
  if (is_gas(material.eos)) return infinite;
  const double sound = bulk_sound_speed(material);
  return heat_slack * sound * sound;
}

/// Specific internal energy [J/kg] of contents.
template <int Dim>
double internal_energy(const Contents<Dim>& q) {
  const Vec<Dim> u = velocity<Dim>(q);
  return q[Components<Dim>::energy] / q[0] - 0.5 * dot(u, u);
}

/// The most mass [kg] of `from` that may leave it in the state of `taker`, so that what is left becomes
/// colder by at most `slack` [J/kg]. Taking x of what is left away, at another velocity and energy, leaves it
/// with x (e_from - e_taker) - x (1 + x) |du|^2/2 more.
template <int Dim>
double most_mass_taken(const Contents<Dim>& taker, const Contents<Dim>& from, double slack) {
  const Vec<Dim> du = velocity<Dim>(taker) - velocity<Dim>(from);
  const double a = 0.5 * dot(du, du), b = a + internal_energy<Dim>(taker) - internal_energy<Dim>(from),
               root = std::sqrt(b * b + 4 * a * slack);
  if (slack == infinite || (b <= 0 && a == 0)) return infinite;
  const double x = b > 0 ? 2 * slack / (b + root) : (root - b) / (2 * a);
  return x < like_states ? x / (1 + x) * from[0] : infinite;
}

/// The most volume [m^Dim] that cell i takes from another one in its own state, so that it leaves that most
/// of its heat.
template <int Dim>
double most_by_heat(const MovesView<Dim>& p, const Index<Dim>& i, const Index<Dim>& from, double slack) {
  const Contents<Dim> own = p.contents(i), there = p.contents(from);
  if (!(there[0] > 0 && own[0] > 0)) return infinite;
  return most_mass_taken<Dim>(own, there, slack) * p.volume[p.window.at(i)] / own[0];
}

/// The same, so that it leaves that at least the part `least_left` of its mass.
template <int Dim>
double most_by_mass(const MovesView<Dim>& p, const Index<Dim>& i, const Index<Dim>& from) {
  const double own = p.contents(i)[0], there = p.contents(from)[0];
  return own > 0 && there > 0 ? (1 - least_left) * there * p.volume[p.window.at(i)] / own : infinite;
}

/// The same, so that it leaves that at least the part `least_left` of its density: most of it may be void.
template <int Dim>
double most_by_density(const MovesView<Dim>& p, const Index<Dim>& i, const Index<Dim>& from) {
  const double mass = p.contents(from)[0], left = least_left * mass / p.volume[p.window.at(from)],
               taken = p.contents(i)[0] / p.volume[p.window.at(i)];
  return mass > 0 && left < taken ? (1 - least_left) * mass / (taken - left) : infinite;
}

/// How much of what cell i wants of a neighbour it takes: its share, where other full cells beside that lack
/// so much that all together would leave it nothing.
template <int Dim>
double share_of(const MovesView<Dim>& p, const Index<Dim>& i, const Index<Dim>& giver, double wanted) {
  double others = 0;
  for (int d = 0; d < Dim; ++d)
    for (int side = -1; side <= 1; side += 2) {
      Index<Dim> j = giver;
      j[d] += side;
      const int k = p.window.at(j);
      if (!(j == i) && p.kind[k] == CellKind::full) others += std::max(0.0, p.full(j) - p.volume[k]);
    }
  const double has = std::max(0.0, p.volume[p.window.at(giver)]);
  return others > no_volume * p.full(i) && others + wanted > has ? wanted * has / (others + wanted) : wanted;
}

}  // namespace recoil
