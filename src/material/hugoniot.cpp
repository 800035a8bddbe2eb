#include "material/hugoniot.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>
#include <variant>

#include "core/error.hpp"
#include "material/radial_return.hpp"

namespace recoil {

namespace {

/// The root of a rising function in [lo, hi] by the Illinois variant of false position.
template <class F>
double rising_root(const F& f, double lo, double hi) {
  double flo = f(lo), fhi = f(hi);
  double x = lo;
  int kept = 0;
  for (int i = 0; i < 200 && hi - lo > 1e-15 * std::fabs(hi); ++i) {
    x = fhi > flo ? (lo * fhi - hi * flo) / (fhi - flo) : 0.5 * (lo + hi);
    if (!(x > lo && x < hi)) x = 0.5 * (lo + hi);
    const double fx = f(x);
    if (fx == 0) break;
    if (fx > 0) {
      hi = x, fhi = fx;
      if (kept == 1) flo *= 0.5;
      kept = 1;
    } else {
      lo = x, flo = fx;
      if (kept == -1) fhi *= 0.5;
      kept = -1;
    }
  }
  return x;
}

template <class Model>
Model without_rate(Model model) {
  if constexpr (std::is_same_v<Model, JohnsonCook>) model.c = 0;
  return model;
}

/// Where one jump starts: matter at rest, or behind the elastic precursor.
struct Front {
  double density, velocity, stress, energy;
};

template <class EosModel, class StrengthModel>
class Shock {
 public:
  Shock(const EosModel& eos, const StrengthModel& strength, const Material& m)
      : eos_(eos), strength_(without_rate(strength)), law_(m.thermal, m.eos) {
    rest_ = {eos.rho0, 0, 0, 0};
    limit_ = std::min(eos.largest_density(), 20 * eos.rho0) * (1 - 1e-9);
    const double initial_yield = strength_.yield(0, 0, m.thermal.initial_temperature);
    if (!(strength_.shear_modulus > 0) || !(initial_yield > 0)) return;
    const double strain = initial_yield / (2 * strength_.shear_modulus);
    elastic_density_ = eos.rho0 * std::exp(std::min(strain, 100.0));
    if (elastic_density_ >= limit_) return;  // never yields
    const ShockState e = jump(rest_, elastic_density_);
    elastic_ = {e.density, e.velocity, e.stress, e.energy};
    elastic_speed_ = e.shock_speed;
  }

  ShockState at_velocity(double velocity) const {
    const auto behind = [&](double rho) { return at_density(rho).velocity - velocity; };
    if (!(velocity > 0)) return jump(rest_, eos_.rho0);
    const double top = last_density();
    if (behind(top) < 0) fail(velocity);
    return at_density(rising_root(behind, eos_.rho0, top));
  }

  double largest_velocity() const { return at_density(last_density()).velocity; }

 private:
  ShockState at_density(double rho) const {
    if (!yields() || rho <= elastic_density_) return jump(rest_, rho);
    ShockState s = jump(elastic_, rho);
    if (s.shock_speed >= elastic_speed_) return jump(rest_, rho);  // one front
    s.has_precursor = true;
    s.precursor_speed = elastic_speed_;
    s.precursor_velocity = elastic_.velocity;
    s.precursor_stress = elastic_.stress;
    return s;
  }

  bool yields() const { return elastic_density_ > 0 && elastic_density_ < limit_; }

  /// The jump conditions of one front from `from` to density rho. Pressure is affine in energy.
  ShockState jump(const Front& from, double rho) const {
    ShockState s;
    s.density = rho;
    const double dv = 1 / from.density - 1 / rho;
    const double p0 = eos_.pressure(rho, 0), slope = eos_.pressure(rho, 1) - p0;
    const auto close = [&](double deviator) {
      const double known = p0 + deviator + slope * (from.energy + 0.5 * from.stress * dv);
      s.stress = known / (1 - 0.5 * slope * dv);
      s.energy = from.energy + 0.5 * (s.stress + from.stress) * dv;
    };
    close(0);
    load(s);
    // The temperature may follow the energy, and the energy the strength: a mild coupling.
    for (int i = 0; i < 30; ++i) {
      const double before = s.stress;
      close(deviator(s));
      if (std::fabs(s.stress - before) <= 1e-15 * std::fabs(s.stress)) break;
      if (law_.thermal().rule == Thermal::Rule::energy) load(s);
    }
    s.pressure = s.stress - deviator(s);
    const double du = std::sqrt(std::max((s.stress - from.stress) * dv, 0.0));
    s.velocity = from.velocity + du;
    s.shock_speed =
        du > 0 ? from.velocity + (s.stress - from.stress) / (from.density * du) : longitudinal(s.density, 0);
    const double c2 = eos_.sound_speed_squared(rho, s.pressure);
    s.bulk_speed = std::sqrt(std::max(c2, 0.0));
    s.release_speed = longitudinal(rho, s.pressure);
    return s;
  }

  double longitudinal(double rho, double p) const {
    const double c2 = eos_.sound_speed_squared(rho, p) + 4 * strength_.shear_modulus / (3 * rho);
    return std::sqrt(std::max(c2, 0.0));
  }

  /// -S_nn [Pa], at most 2/3 of the yield stress.
  double deviator(const ShockState& s) const {
    const double elastic = 2 * strength_.shear_modulus * std::log(s.density / eos_.rho0);
    return 2.0 / 3 * std::min(elastic, s.yield);
  }

  /// Yield stress, plastic strain and temperature at s.density (and s.energy). Uniaxial strain makes
  /// ep + Y/(3 G) = (2/3) ln(rho/rho0) hold all along the loading: it is the radial return of a trial
  /// stress 2 G ln(rho/rho0). Heating by plastic work needs the way: Heun steps in ln rho.
  void load(ShockState& s) const {
    const double total = std::log(s.density / eos_.rho0);
    const auto strain = [&](double part, double temperature) {
      const double q = 2 * strength_.shear_modulus * part;
      return q > 0 ? plastic_increment(strength_, q, 0, temperature, 1) : 0.0;
    };
    const double q = 1.5 * deviator(s);  // of the round before
    s.temperature =
        law_(s.density, s.energy - distortion_energy(q * q, strength_.shear_modulus, s.density), 0);
    s.plastic_strain = strain(total, s.temperature);
    if (s.plastic_strain > 0 && law_.thermal().rule == Thermal::Rule::plastic_work)
      heat_along(s, total, strain);
    s.yield = strength_.yield(s.plastic_strain, 0, s.temperature);
  }

  template <class Strain>
  void heat_along(ShockState& s, double total, const Strain& strain) const {
    constexpr int steps = 64;
    const double start = std::log(elastic_density_ / eos_.rho0);
    double t = law_(eos_.rho0, 0, 0), ep = 0, y = strength_.yield(0, 0, t);
    for (int k = 1; k <= steps; ++k) {
      const double part = start + (total - start) * k / steps;
      const double middle = eos_.rho0 * std::exp(part - 0.5 * (total - start) / steps);
      double next_t = t, next_ep = ep, next_y = y;
      for (int i = 0; i < 3; ++i) {
        next_ep = strain(part, next_t);
        next_y = strength_.yield(next_ep, 0, next_t);
        next_t = t + plastic_heating(law_.thermal(), 0.5 * (y + next_y), std::max(next_ep - ep, 0.0), middle);
      }
      t = next_t, ep = next_ep, y = next_y;
    }
    s.temperature = t;
    s.plastic_strain = ep;
  }

  /// The largest density that a shock can reach: the guard of the equation of state, or where the
  /// denominator of the jump conditions vanishes.
  double last_density() const {
    double lo = eos_.rho0, hi = limit_;
    const auto fine = [&](double rho) {
      const ShockState s = at_density(rho);
      const double slope = eos_.pressure(rho, 1) - eos_.pressure(rho, 0);
      return 0.5 * slope * (1 / eos_.rho0 - 1 / rho) < 0.99 && std::isfinite(s.velocity);
    };
    if (fine(hi)) return hi;
    for (int i = 0; i < 60; ++i) {
      const double mid = 0.5 * (lo + hi);
      (fine(mid) ? lo : hi) = mid;
    }
    return lo;
  }

  [[noreturn]] void fail(double velocity) const {
    throw PhysicsError("no shock state at a particle velocity of " + std::to_string(velocity) +
                       " m/s: the equation of state does not reach it");
  }

  EosModel eos_;
  StrengthModel strength_;
  TemperatureLaw law_;
  Front rest_{}, elastic_{};
  double elastic_density_ = 0;  // kg/m3; 0: no strength
  double elastic_speed_ = 0;    // m/s
  double limit_ = 0;            // kg/m3
};

/// Calls f(shock), a Shock<...> of the material's models.
template <class F>
auto with_shock(const Material& m, const F& f) {
  return std::visit([&](const auto& eos, const auto& strength) { return f(Shock(eos, strength, m)); }, m.eos,
                    m.strength);
}

}  // namespace

ShockState shock_at_velocity(const Material& material, double velocity) {
  return with_shock(material, [&](const auto& shock) { return shock.at_velocity(velocity); });
}

double largest_velocity(const Material& material) {
  return with_shock(material, [&](const auto& shock) { return shock.largest_velocity(); });
}

Impact match_impact(const Material& flyer, const Material& target, double closing) {
  return with_shock(flyer, [&](const auto& a) {
    return with_shock(target, [&](const auto& b) {
      const auto pull = [&](double u) { return b.at_velocity(u).stress - a.at_velocity(closing - u).stress; };
      // Within what both of them reach.
      const double lo = std::max(0.0, closing - a.largest_velocity() * (1 - 1e-9));
      const double hi = std::min(closing, b.largest_velocity() * (1 - 1e-9));
      if (!(lo < hi) || pull(lo) > 0 || pull(hi) < 0)
        throw PhysicsError("no shock state at a closing velocity of " + std::to_string(closing) +
                           " m/s: the equations of state do not reach it");
      Impact impact;
      impact.velocity = rising_root(pull, lo, hi);
      impact.target = b.at_velocity(impact.velocity);
      impact.flyer = a.at_velocity(closing - impact.velocity);
      impact.stress = impact.target.stress;
      return impact;
    });
  });
}

bool flyer_leaves(const Impact& impact, const Material& flyer, const Material& target) {
  const auto impedance = [](const ShockState& s, const Material& m) {
    return s.velocity > 0 ? s.stress / s.velocity : density(m) * longitudinal_speed(m);
  };
  return impedance(impact.flyer, flyer) < impedance(impact.target, target) * (1 - 1e-9);
}

double unloading_time(const ShockState& state, const Material& material, double thickness) {
  return thickness / state.shock_speed + thickness / bulk_sound_speed(material);
}

}  // namespace recoil
