#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "field/components.hpp"
#include "material/damage/damage.hpp"
#include "material/damage/damage_drive.hpp"
#include "state/body.hpp"

/// Failed matter: what has a damage of failed_damage or more bears no tension. Where the equation of state
/// would pull, the matter stands at p = 0 without any stress, and part of its cell is a void. Nothing is
/// moved or taken away: the conserved contents alone are the state, and a void closes by itself as soon as
/// the pressure of the contents is positive again. See docs/theory.md, fracture.
namespace recoil {

/// Takes the tension off a state that has failed: p = 0, S = 0, and `extra` keeps its energy.
/// @returns whether there was any: the state has a void.
template <int Dim, class EosModel>
bool relieve(const EosModel& eos, Primitives<Dim>& w) {
  using C = Components<Dim>;
  if (!(w[C::damage] >= failed_damage && w[C::p] < 0)) return false;
  const auto& matter = frozen(eos, w[C::crushed]);
  double e = matter.energy(w[C::rho], w[C::p]);
  if constexpr (EosModel::barotropic) e += w[C::extra];
  w[C::p] = 0;
  for (int c = C::s; c < C::ep; ++c) w[c] = 0;
  w[C::extra] = e - matter.energy(w[C::rho], 0);
  return true;
}

/// The density [kg/m3] at which matter of the energy e [J/kg] is free of pressure; `from` is a density at
/// which it would be in tension. By false position (Illinois), which one step ends where p is linear in rho;
/// an equation of state whose tension falls again towards low density has its root above all the same.
template <class EosModel>
double released_density(const EosModel& eos, double from, double e) {
  constexpr double wider = 1.05, most = 3;  // of rho0
  double lo = from, hi = std::max(from, eos.rho0), p_lo = eos.pressure(lo, e), p_hi = eos.pressure(hi, e);
  while (p_hi < 0 && hi < most * eos.rho0) {
    lo = hi, p_lo = p_hi;
    hi *= wider, p_hi = eos.pressure(hi, e);
  }
  if (!(p_lo < 0) || !(p_hi >= 0)) return from;
  for (int k = 0; k < 60 && p_hi != 0 && hi - lo > 1e-13 * hi; ++k) {
    const double at = lo + (hi - lo) * (p_lo / (p_lo - p_hi)), p = eos.pressure(at, e);
    if (p < 0) {
      lo = at, p_lo = p, p_hi *= 0.5;
    } else {
      hi = at, p_hi = p, p_lo *= 0.5;
    }
  }
  return hi;
}

/// Part of its volume that is not void where matter of the density rho and energy e, with its distension less
/// by `crushed`, has failed: 1 without void.
double solid_fraction(const Eos& eos, double rho, double e, double crushed);

/// relieve() for the averages of one body in one block (BodyBlock::average).
template <int Dim>
void relieve_averages(const State<Dim>& state, Body<Dim>& body, int slot);

/// The contents of one cell of a body that can fail, in the course of return_to_yield(): `q` [contents],
/// `stride` apart, of a fragment of volume v.
template <int Dim>
class FailingCell {
 public:
  FailingCell(const Body<Dim>& body, double* q, std::size_t stride, double v)
      : body_(body), q_(q), stride_(stride), volume_(v) {}

  /// Takes the stress off failed matter that would be in tension. @returns whether it was so.
  /// @param may_have_failed recoil::may_have_failed(). Intact matter that has come to a cell of failed matter
  /// does not close its voids: in tension it stays failed as long as it mostly is. Else a hundredth of intact
  /// matter would put the whole cell, voids and all, under a tension of 10 GPa and more.
  bool relieve(bool may_have_failed = false);
  /// Lets damage grow over dt [s] in which the plastic strain grew by `strain_growth`, and failed matter
  /// yield under what it still bears. @returns 1 where a damage outside of 0 to `most` was set to the bound.
  int grow(double dt, double strain_growth, double most = 1);
  /// The same by a given state, such as a mean of cells, with its length of time.
  int grow(const DamagePoint& by, double most = 1);
  bool has_failed() { return damage() >= failed_damage; }
  /// Of matter whose damage model has no rate, at the end of a step. @returns whether it fails now.
  bool fail_at_once();
  bool fail_at_once(const DamagePoint& now);
  /// Writes what its damage would grow by to `drive` [DamageDrive::components], as far apart as the contents;
  /// nothing where there is no matter.
  /// @param full volume of the whole cell [m^Dim].
  void note(double full, double strain_growth, double* drive);

 private:
  double& at(int c) { return q_[static_cast<std::size_t>(c) * stride_]; }
  double damage() { return at(Components<Dim>::damage) / at(Components<Dim>::rho); }
  double internal_energy();  // J/kg
  double pressure();         // Pa
  void bear_less(double pressure);
  DamagePoint point();

  const Body<Dim>& body_;
  double* q_;
  std::size_t stride_;
  double volume_;
};

}  // namespace recoil
