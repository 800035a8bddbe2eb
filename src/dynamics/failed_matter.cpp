#include "dynamics/failed_matter.hpp"

#include <algorithm>
#include <variant>

#include "dynamics/stress_invariants.hpp"

namespace recoil {

namespace {

constexpr double mostly_failed = 0.9;  // damage from which on what had failed stays so in tension
constexpr double over_failed = 1e-6;   // damage outside of 0 to 1 by less is rounding, not counted

}  // namespace

double solid_fraction(const Eos& eos, double rho, double e, double crushed) {
  return std::visit([&](const auto& m) { return rho / released_density(frozen(m, crushed), rho, e); }, eos);
}

template <int Dim>
void relieve_averages(const State<Dim>& state, Body<Dim>& body, int slot) {
  using C = Components<Dim>;
  BodyBlock<Dim>& b = body.at(slot);
  const Box<Dim> cells = state.mesh.block(slot).cells, layout = state.grid(slot).layout();
  const auto n = static_cast<std::size_t>(layout.size());
  std::visit(
      [&]<class EosModel>(const EosModel& eos) {
        // Void that has closed has no energy of its own any more.
        if constexpr (!EosModel::barotropic) std::fill_n(b.average.begin() + C::extra * n, n, 0.0);
        for_each(cells, [&](const Index<Dim>& i) {
          const auto k = static_cast<std::size_t>(layout.at(i - cells.lo));
          double& damage = b.average[C::damage * n + k];
          if ((b.role[k] & donates) == 0 || !(damage >= failed_damage)) return;
          damage = std::min(damage, 1.0);  // what it has beyond 1 within a step stays in its cell
          Primitives<Dim> w;
          for (std::size_t c = 0; c < w.size(); ++c) w[c] = b.average[c * n + k];
          if (!relieve<Dim>(eos, w)) return;
          for (std::size_t c = 0; c < w.size(); ++c) b.average[c * n + k] = w[c];
        });
      },
      body.material.eos);
}

template <int Dim>
double FailingCell<Dim>::internal_energy() {
  using C = Components<Dim>;
  const double mass = at(C::rho);
  double momentum2 = 0;
  for (int d = 0; d < Dim; ++d) momentum2 += at(C::u + d) * at(C::u + d);
  return (at(C::energy) - 0.5 * momentum2 / mass) / mass;
}

template <int Dim>
double FailingCell<Dim>::pressure() {
  using C = Components<Dim>;
  return recoil::pressure(body_.material.eos, at(C::rho) / volume_, internal_energy(),
                          at(C::crushed) / at(C::rho));
}

template <int Dim>
bool FailingCell<Dim>::relieve(bool may_have_failed) {
  using C = Components<Dim>;
  const double mass = at(C::rho), least = may_have_failed ? mostly_failed : failed_damage;
  if (!(mass > 0 && volume_ > 0) || damage() < least || !(pressure() < 0)) return false;
  for (int c = C::s; c < C::ep; ++c) at(c) = 0;
  at(C::damage) = std::max(at(C::damage), mass);
  return true;
}

template <int Dim>
void FailingCell<Dim>::bear_less(double pressure) {
  using C = Components<Dim>;
  const double mass = at(C::rho),
               own = std::sqrt(equivalent_stress_squared<Dim>(q_ + C::s * stride_, stride_)) / mass;
  const double most = body_.material.failed.limit(pressure);
  if (!(own > most)) return;
  for (int c = C::s; c < C::ep; ++c) at(c) *= most / own;
}

template <int Dim>
DamagePoint FailingCell<Dim>::point() {
  using C = Components<Dim>;
  const double mass = at(C::rho), rho = mass / volume_;
  const double* s = q_ + C::s * stride_;
  const double square = equivalent_stress_squared<Dim>(s, stride_) / (mass * mass);
  DamagePoint p{.damage = damage(), .pressure = pressure(), .equivalent = std::sqrt(square)};
  p.principal = largest_principal_deviator<Dim>(s, stride_) / mass - p.pressure;
  const double e = internal_energy() - distortion_energy(square, shear_modulus(body_.material), rho);
  p.temperature = body_.temperature(rho, e, at(C::temperature_rise) / mass);
  return p;
}

template <int Dim>
int FailingCell<Dim>::grow(double dt, double strain_growth, double most) {
  if (!(at(Components<Dim>::rho) > 0 && volume_ > 0)) return 0;
  DamagePoint now;
  if (damage() < most && !fails_at_once(body_.material.damage)) now = point();
  now.strain_growth = strain_growth;
  now.dt = dt;
  return grow(now, most);
}

template <int Dim>
int FailingCell<Dim>::grow(const DamagePoint& by, double most) {
  using C = Components<Dim>;
  const double mass = at(C::rho);
  if (!(mass > 0 && volume_ > 0)) return 0;
  const double before = damage();
  const double kept = std::clamp(before, 0.0, most);
  const int clamped = before < -over_failed || before > most + over_failed ? 1 : 0;
  double after = kept;
  if (kept < most && !fails_at_once(body_.material.damage)) {
    DamagePoint now = by;
    now.damage = kept;
    after = std::min(most,
                     kept + std::visit([&](const auto& m) { return m.growth(now); }, body_.material.damage));
  }
  at(C::damage) = after * mass;
  if (after >= failed_damage && !damage_dependent(body_.material.strength)) bear_less(pressure());
  return clamped;
}

template <int Dim>
bool FailingCell<Dim>::fail_at_once() {
  if (!(at(Components<Dim>::rho) > 0 && volume_ > 0) || has_failed()) return false;
  return fail_at_once(point());
}

template <int Dim>
bool FailingCell<Dim>::fail_at_once(const DamagePoint& now) {
  using C = Components<Dim>;
  if (!(at(C::rho) > 0 && volume_ > 0) || has_failed()) return false;
  if (!(std::visit([&](const auto& m) { return m.growth(now); }, body_.material.damage) > 0)) return false;
  at(C::damage) = at(C::rho);
  if (!damage_dependent(body_.material.strength)) bear_less(pressure());
  return true;
}

template <int Dim>
void FailingCell<Dim>::note(double full, double strain_growth, double* drive) {
  using C = Components<Dim>;
  if (!(at(C::rho) > 0 && volume_ > 0)) return;
  DamagePoint now = point();
  now.strain_growth = strain_growth;
  if (has_failed() && now.pressure < 0) now.pressure = now.principal = now.equivalent = 0;
  const DamageDrive::Values values = DamageDrive::of(now, volume_ / full);
  for (std::size_t c = 0; c < values.size(); ++c) drive[c * stride_] = values[c];
}

template void relieve_averages<1>(const State<1>&, Body<1>&, int);
template void relieve_averages<2>(const State<2>&, Body<2>&, int);
template void relieve_averages<3>(const State<3>&, Body<3>&, int);
template class FailingCell<1>;
template class FailingCell<2>;
template class FailingCell<3>;

}  // namespace recoil
