#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/scratch.hpp"
#include "cutcell/fill.hpp"
#include "state/body.hpp"

namespace recoil {

/// Failed matter may be as thin as this part of its density at rest, since most of it may be void; what is
/// thinner is of no use to fits and stencils.
inline constexpr double thinnest_failed = 1e-5;

/// Contents per volume of one cell to primitives.
template <int Dim, class EosModel>
Primitives<Dim> to_primitives(const EosModel& eos, const Contents<Dim>& q, double volume) {
  using C = Components<Dim>;
  Primitives<Dim> w{};
  const double rho = q[C::rho] / volume, per_mass = 1 / q[C::rho];
  double kinetic = 0;
  w[C::rho] = rho;
  for (int d = 0; d < Dim; ++d) {
    w[C::u + d] = q[C::u + d] * per_mass;
    kinetic += 0.5 * w[C::u + d] * w[C::u + d];
  }
  const double e = q[C::energy] * per_mass - kinetic;
  const auto& matter = frozen(eos, q[C::crushed] * per_mass);
  w[C::p] = matter.pressure(rho, e);
  for (std::size_t k = C::s; k < C::contents; ++k) w[k] = q[k] * per_mass;
  if constexpr (EosModel::barotropic) w[C::extra] = e - matter.energy(rho, w[C::p]);
  return w;
}

/// Chooses what every fragment of a block is good for (Role), from its volume. Once a step.
/// @throws PhysicsError for a density that the equation of state does not admit (1 - s Phi <= 0.1) in a
/// fragment of at least half a cell.
template <int Dim>
void choose_roles(const State<Dim>& state, Body<Dim>& body, int slot, Counters& counters);

/// What averages are taken of.
enum class AveragesOf : std::uint8_t {
  start,  ///< a step
  stage,  ///< the contents that a stage leaves
  mean,   ///< their Runge-Kutta mean with those of the start of the step
};

/// Primitives of the averages of all donors of a block, into BodyBlock::average. Within a step a fragment
/// whose volume or density allows none, or that has lost half of its volume to a mean, has the average that
/// it had at the start of the step, where its contents are kept. @throws PhysicsError for a state that is not
/// finite or has no density.
template <int Dim>
void average_primitives(const State<Dim>& state, Body<Dim>& body, int slot, Counters& counters,
                        AveragesOf what = AveragesOf::start);

/// Largest (sum over axes of |u_d| + sound c_L)/dx [1/s] over fragments of at least half a cell.
/// @param sound how often the speed of sound counts (sound_in_step)
template <int Dim>
double fastest_signal(const State<Dim>& state, const Body<Dim>& body, int slot, double sound,
                      Counters& counters);

/// The contents of one cell.
template <int Dim>
Contents<Dim> contents_of(const BodyBlock<Dim>& b, int cell) {
  const std::size_t n = b.volume.size();
  Contents<Dim> q;
  for (std::size_t c = 0; c < q.size(); ++c) q[c] = b.contents[c * n + cell];
  return q;
}

}  // namespace recoil
