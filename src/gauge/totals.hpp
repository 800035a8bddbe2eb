#pragma once

#include <cstdint>
#include <vector>

#include "parallel/team.hpp"
#include "parallel/world.hpp"
#include "state/body.hpp"

namespace recoil {

/// Sums over one body: per m2 in 1d, per m in planar geometry, per radian where axisymmetric.
template <int Dim>
struct BodyTotals {
  double mass = 0;            // kg
  Vec<Dim> momentum;          // kg m/s
  double kinetic = 0;         // J
  double energy = 0;          // J, kinetic and internal
  double volume = 0;          // m^3 (1d: m, planar: m^2)
  double speed = 0;           // kg m/s, sum of m |u|: the scale of momentum
  Vec<Dim> place;             // kg m, sum of m x; NaN along periodic axes
  Vec<3> angular_momentum;    // kg m2/s about the origin: x cross m u at the centres of cells; planar: the
                              // third; 0 in 1d, and of no meaning where axisymmetric; NaN about axes across
                              // a periodic one
  double plastic_strain = 0;  // largest, in fragments of at least 0.3 of a cell
  double failed = 0;          // kg of matter that has failed
  Vec<Dim> lowest, highest;   // m, extent; NaN where the body is nowhere, and along periodic axes
  std::int64_t cells = 0;     // with matter

  double internal() const { return energy - kinetic; }
  /// Takes in the sums of another body.
  BodyTotals& operator+=(const BodyTotals& b);
};

/// What all bodies hold, and what they have passed to each other and through the edges of the domain since
/// the start.
template <int Dim>
struct Totals {
  double time = 0;                      // s
  std::vector<BodyTotals<Dim>> bodies;  // of rigid ones that move as prescribed only the extent, else zeros
  std::vector<EdgeAccount<Dim>> edges;  // by body: what has left
  std::vector<double> released;         // by body: energy of detonation [J]
  std::vector<Account<Dim>> loads;      // by body: received from the loads on its surface
  std::vector<Vec<3>> load_moments;     // the same of the angular momentum about the origin
  std::vector<Account<Dim>> pairs;      // by pair_number: received by the lower-numbered body
  std::vector<Vec<3>> moments;          // the same of the angular momentum about the origin
};

/// Collective; the result is on rank 0, empty elsewhere. The bits do not depend on ranks or threads.
/// @param team shares the blocks of this rank between its threads; null: this thread only.
template <int Dim>
Totals<Dim> find_totals(const State<Dim>& state, const parallel::World& world,
                        parallel::Team* team = nullptr);

/// What body m has received over all its contacts since the start. Rigid partners count.
template <int Dim>
Account<Dim> received(const Totals<Dim>& totals, int m);

/// The same of its angular momentum about the origin [kg m2/s].
template <int Dim>
Vec<3> received_moment(const Totals<Dim>& totals, int m);

}  // namespace recoil
