#include "material/hugoniot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <variant>

#include "core/error.hpp"
#include "core/rising_root.hpp"
#include "material/radial_return.hpp"

namespace recoil {

namespace {

/// At the rates of a model's own constants: the rate of a shock is not known.
Strength without_rate(Strength strength) {
  if (auto* johnson_cook = std::get_if<JohnsonCook>(&strength)) johnson_cook->c = 0;
  if (auto* ceramic = std::get_if<JohnsonHolmquist>(&strength)) ceramic->c = 0;
  return strength;
}

/// Where one jump starts: matter at rest, or behind the elastic precursor.
struct Front {
  double density, velocity, stress, energy;
};

class Shock {
 public:
  explicit Shock(const Material& m)
      : eos_(m.eos),
        strength_(without_rate(m.strength)),
        law_(temperature_law(m)),
        rho0_(density(m)),
        shear_modulus_(shear_modulus(m)) {
    rest_ = {rho0_, 0, 0, 0};
    limit_ = std::min(largest_density(eos_), 20 * rho0_) * (1 - 1e-9);
    elastic_density_ = first_limit(find_elastic_limit(m.thermal.initial_temperature), find_crush_limit());
    if (!yields()) return;
    const ShockState e = jump(rest_, elastic_density_);
    elastic_ = {e.density, e.velocity, e.stress, e.energy};
    elastic_speed_ = e.shock_speed;
  }

  ShockState at_velocity(double velocity) const {
    const auto behind = [&](double rho) { return at_density(rho).velocity - velocity; };
    if (!(velocity > 0)) return jump(rest_, rho0_);
    if (has_pores() && !(velocity <= elastic_.velocity)) return porous_at_velocity(velocity);
    const double top = last_density();
    if (behind(top) < 0) fail(velocity);
    return at_density(rising_root(behind, rho0_, top));
  }

  double largest_velocity() const {
    if (!has_pores()) return at_density(last_density()).velocity;
    double low = elastic_.velocity, high = 1;
    for (; high < fastest && reaches(rest_, high); high *= 2) low = high;
    for (int i = 0; i < 60 && high < fastest; ++i) {
      const double middle = 0.5 * (low + high);
      (reaches(rest_, middle) ? low : high) = middle;
    }
    return low;
  }

 private:
  static constexpr double fastest = 1e5;  // m/s that is asked for of porous matter

  bool has_pores() const { return std::holds_alternative<Porous>(eos_); }

  /// Behind a front of the speed `ahead` against the matter that it runs into, which brings it to `velocity`:
  /// density and energy by the jump conditions, stress by the equation of state.
  ShockState porous_behind(const Front& from, double velocity, double ahead) const {
    const double du = velocity - from.velocity;
    ShockState s;
    s.velocity = velocity;
    s.shock_speed = from.velocity + ahead;
    s.density = from.density / (1 - du / ahead);
    s.energy = from.energy + 0.5 * du * du + from.stress * (1 / from.density - 1 / s.density);
    s.pressure = pressure_of(s.density, s.energy);
    for (int i = 0; i < 4; ++i) load(s);  // the temperature depends on the strength, and the strength on it
    s.stress = s.pressure + deviator(s);
    complete(s);
    return s;
  }
  /// The least speed of such a front, at which it compresses to the end of the equation of state.
  double least_ahead(const Front& from, double velocity) const {
    return (velocity - from.velocity) / (1 - from.density / limit_);
  }
  /// What momentum asks for less the stress that there is [Pa]: rises with the speed of the front.
  double missing_stress(const Front& from, double velocity, double ahead) const {
    return from.stress + from.density * ahead * (velocity - from.velocity) -
           porous_behind(from, velocity, ahead).stress;
  }
  /// The interval [low, high] in which the fastest such front lies, from above; low 0: there is none.
  std::array<double, 2> bracket(const Front& from, double velocity) const {
    const double least = least_ahead(from, velocity);
    double high = 2 * least + 2e4;
    while (!(missing_stress(from, velocity, high) > 0) && high < 1e9) high *= 2;
    while (high - least > 1e-4 * least) {
      const double low = least + 0.8 * (high - least);
      if (missing_stress(from, velocity, low) <= 0) return {low, high};
      high = low;
    }
    return {0, 0};
  }
  bool reaches(const Front& from, double velocity) const { return bracket(from, velocity)[0] > 0; }

  /// The density behind a shock into porous matter need not rise with its strength (much heat, little solid):
  /// the speed of the front is looked for.
  ShockState porous_shock(const Front& from, double velocity) const {
    const auto [low, high] = bracket(from, velocity);
    if (!(low > 0)) fail(velocity);
    const auto missing = [&](double ahead) { return missing_stress(from, velocity, ahead); };
    return porous_behind(from, velocity, rising_root(missing, low, high));
  }
  ShockState porous_at_velocity(double velocity) const {
    if (!yields() || !reaches(elastic_, velocity)) return porous_shock(rest_, velocity);
    ShockState s = porous_shock(elastic_, velocity);
    if (s.shock_speed >= elastic_speed_) return porous_shock(rest_, velocity);  // one front
    announce(s);
    return s;
  }

  /// Puts the elastic precursor into the state behind the second front.
  void announce(ShockState& s) const {
    s.has_precursor = true;
    s.precursor_speed = elastic_speed_;
    s.precursor_velocity = elastic_.velocity;
    s.precursor_stress = elastic_.stress;
  }

  /// The speeds of waves in a state that is known otherwise.
  void complete(ShockState& s) const {
    const double lost = crushed(s), c2 = sound_speed_squared(eos_, s.density, s.pressure, lost);
    s.bulk_speed = std::sqrt(std::max(c2, 0.0));
    s.release_speed = longitudinal(s.density, s.pressure, lost);
  }

  ShockState at_density(double rho) const {
    if (!yields() || rho <= elastic_density_) return jump(rest_, rho);
    ShockState s = jump(elastic_, rho);
    if (s.shock_speed >= elastic_speed_) return jump(rest_, rho);  // one front
    announce(s);
    return s;
  }

  /// The smaller of two densities of which 0 stands for none. Where pores begin to crush and matter to yield
  /// one after the other, the two fronts behind the first one are taken as one.
  static double first_limit(double a, double b) { return a > 0 && b > 0 ? std::min(a, b) : std::max(a, b); }

  /// The density at which pores begin to crush; 0: there are none, or they crush at once.
  double find_crush_limit() const {
    const auto* porous = std::get_if<Porous>(&eos_);
    if (!porous || !(porous->elastic_limit > 0)) return 0;
    double low = rho0_, high = std::min(limit_, 0.999 * porous->frozen(0).largest_density());
    for (int i = 0; i < 100 && low < high; ++i) {
      const double middle = 0.5 * (low + high);
      if (middle == low || middle == high) break;
      (crushed(jump(rest_, middle)) > 0 ? high : low) = middle;
    }
    return low;
  }

  /// What porous matter has lost of its distension in a state, by loading alone.
  double crushed(const ShockState& s) const { return crushed_by(eos_, s.density, s.energy); }

  double pressure_of(double rho, double e) const {
    return recoil::pressure(eos_, rho, e, crushed_by(eos_, rho, e));
  }

  bool yields() const { return elastic_density_ > 0 && elastic_density_ < limit_; }

  /// The density at which uniaxial strain reaches the yield stress; 0: no strength. Where pressure raises the
  /// yield stress the elastic stress may never catch up with it: then beyond the limit.
  double find_elastic_limit(double temperature) const {
    if (!(shear_modulus_ > 0)) return 0;
    if (!pressure_dependent(strength_)) {
      const double initial_yield = yield(strength_, {.temperature = temperature});
      const double strain = initial_yield / (2 * shear_modulus_);
      return initial_yield > 0 ? rho0_ * std::exp(std::min(strain, 100.0)) : 0.0;
    }
    double low = rho0_, high = rho0_;
    const auto holds = [&](double rho) { return jump(rest_, rho).plastic_strain == 0; };
    for (double step = 1e-6; holds(high); step *= 1.5) {
      low = high;
      high = rho0_ * (1 + step);
      if (high >= limit_) return 2 * limit_;
    }
    for (int i = 0; i < 60 && low < high; ++i) {
      const double middle = 0.5 * (low + high);
      (holds(middle) ? low : high) = middle;
    }
    return low > rho0_ ? low : 0.0;
  }

  /// Stress and energy behind a front to density s.density that carries this deviator: Newton's method over
  /// the energy, which ends at once where pressure is linear in it.
  void close(const Front& from, double dv, double deviator, ShockState& s) const {
    if (std::holds_alternative<Porous>(eos_)) return close_porous(from, dv, deviator, s);
    double e = 0;
    for (int i = 0; i < 40; ++i) {
      const double p = pressure_of(s.density, e), slope = pressure_of(s.density, e + 1) - p;
      const double known = p + deviator + slope * (from.energy - e + 0.5 * from.stress * dv);
      s.stress = known / (1 - 0.5 * slope * dv);
      s.energy = from.energy + 0.5 * (s.stress + from.stress) * dv;
      if (std::fabs(s.energy - e) <= 1e-12 * std::fabs(s.energy)) break;
      e = s.energy;
    }
    s.pressure = s.stress - deviator;
  }

  /// The same where pressure over energy bends, as pores are gone: bracketed. Without a root, at densities
  /// that no shock reaches, the state is no number.
  void close_porous(const Front& from, double dv, double deviator, ShockState& s) const {
    const auto missing = [&](double e) {
      return e - from.energy - 0.5 * (pressure_of(s.density, e) + deviator + from.stress) * dv;
    };
    double lo = from.energy, step = 1e3;
    while (missing(lo) > 0 && step < 1e10) lo -= step, step *= 2;
    double hi = lo;
    for (step = 1e3; !(missing(hi) > 0) && step < 1e10; step *= 2) lo = hi, hi += step;
    s.energy = missing(lo) <= 0 && missing(hi) > 0 ? rising_root(missing, lo, hi) : unset;
    s.pressure = pressure_of(s.density, s.energy);
    s.stress = s.pressure + deviator;
  }

  /// The jump conditions of one front from `from` to density rho.
  ShockState jump(const Front& from, double rho) const {
    ShockState s;
    s.density = rho;
    const double dv = 1 / from.density - 1 / rho;
    close(from, dv, 0, s);
    load(s);
    // The temperature may follow the energy, and the energy the strength: a mild coupling.
    const bool coupled = law_.thermal().rule == Thermal::Rule::energy || pressure_dependent(strength_);
    for (int i = 0; i < 30; ++i) {
      const double before = s.stress;
      close(from, dv, deviator(s), s);
      if (std::fabs(s.stress - before) <= 1e-15 * std::fabs(s.stress)) break;
      if (coupled) load(s);
    }
    s.pressure = s.stress - deviator(s);
    const double du = std::sqrt(std::max((s.stress - from.stress) * dv, 0.0));
    s.velocity = from.velocity + du;
    s.shock_speed = du > 0 ? from.velocity + (s.stress - from.stress) / (from.density * du)
                           : longitudinal(s.density, 0, 0);
    complete(s);
    return s;
  }

  double longitudinal(double rho, double p, double lost) const {
    const double c2 = sound_speed_squared(eos_, rho, p, lost) + 4 * shear_modulus_ / (3 * rho);
    return std::sqrt(std::max(c2, 0.0));
  }

  YieldState state_of(const ShockState& s, double ep, double temperature) const {
    return {.ep = ep,
            .temperature = temperature,
            .pressure = s.pressure,
            .compression = s.density / rest_density(eos_, crushed(s))};
  }

  /// -S_nn [Pa], at most 2/3 of the yield stress.
  double deviator(const ShockState& s) const {
    const double elastic = 2 * shear_modulus_ * std::log(s.density / rho0_);
    return 2.0 / 3 * std::min(elastic, s.yield);
  }

  /// Yield stress, plastic strain and temperature at s.density (and s.energy). Uniaxial strain makes
  /// ep + Y/(3 G) = (2/3) ln(rho/rho0) hold all along the loading: it is the radial return of a trial
  /// stress 2 G ln(rho/rho0). Heating by plastic work needs the way: Heun steps in ln rho.
  void load(ShockState& s) const {
    const double total = std::log(s.density / rho0_), lost = crushed(s);
    const auto strain = [&](double part, const Melt& melt) {
      const double q = 2 * shear_modulus_ * part;
      return q > 0 ? plastic_increment(strength_, q, state_of(s, 0, melt.temperature), 1, 1 - melt.molten,
                                       melt.at)
                   : 0.0;
    };
    const double q = 1.5 * deviator(s);  // of the round before
    const double heat = s.energy - distortion_energy(q * q, shear_modulus_, s.density);
    Melt melt = law_.melt(s.density, heat, lost);
    s.plastic_strain = strain(total, melt);
    if (s.plastic_strain > 0 && law_.thermal().rule == Thermal::Rule::plastic_work)
      melt = heat_along(s, total, strain);
    s.temperature = melt.temperature;
    s.molten = melt.molten;
    s.yield = yield_of(s, s.plastic_strain, melt);
  }
  double yield_of(const ShockState& s, double ep, const Melt& melt) const {
    return yield(strength_, state_of(s, ep, melt.temperature), 1 - melt.molten, melt.at);
  }

  /// @returns what is molten at the end.
  template <class Strain>
  Melt heat_along(ShockState& s, double total, const Strain& strain) const {
    constexpr int steps = 64;
    const double start = std::log(std::max(elastic_density_, rho0_) / rho0_);
    double t = law_.unmelted(rho0_, 0, 0), ep = 0, y = yield_of(s, 0, law_.melted(rho0_, t));
    for (int k = 1; k <= steps; ++k) {
      const double part = start + (total - start) * k / steps;
      const double middle = rho0_ * std::exp(part - 0.5 * (total - start) / steps);
      double next_t = t, next_ep = ep, next_y = y;
      for (int i = 0; i < 3; ++i) {
        const Melt next = law_.melted(middle, next_t);
        next_ep = strain(part, next);
        next_y = yield_of(s, next_ep, next);
        next_t = t + plastic_heating(law_.thermal(), 0.5 * (y + next_y), std::max(next_ep - ep, 0.0), middle);
      }
      t = next_t, ep = next_ep, y = next_y;
    }
    s.plastic_strain = ep;
    return law_.melted(s.density, t);
  }

  /// The largest density that a shock can reach: the guard of the equation of state, or where the
  /// denominator of the jump conditions vanishes.
  double last_density() const {
    double lo = rho0_, hi = limit_;
    const auto fine = [&](double rho) {
      const ShockState s = at_density(rho);
      const double slope = pressure_of(rho, s.energy + 1) - pressure_of(rho, s.energy);
      return 0.5 * slope * (1 / rho0_ - 1 / rho) < 0.99 && s.stress >= 0 && std::isfinite(s.velocity);
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

  Eos eos_;
  Strength strength_;
  TemperatureLaw law_;
  double rho0_ = 0, shear_modulus_ = 0;  // kg/m3, Pa
  Front rest_{}, elastic_{};
  double elastic_density_ = 0;  // kg/m3; 0: no strength
  double elastic_speed_ = 0;    // m/s
  double limit_ = 0;            // kg/m3
};

}  // namespace

ShockState shock_at_velocity(const Material& material, double velocity) {
  return Shock(material).at_velocity(velocity);
}

double largest_velocity(const Material& material) { return Shock(material).largest_velocity(); }

Impact match_impact(const Material& flyer, const Material& target, double closing) {
  const Shock a(flyer), b(target);
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
}

bool flyer_leaves(const Impact& impact, const Material& flyer, const Material& target) {
  const auto impedance = [](const ShockState& s, const Material& m) {
    return s.velocity > 0 ? s.stress / s.velocity : density(m) * longitudinal_speed(m);
  };
  return impedance(impact.flyer, flyer) < impedance(impact.target, target) * (1 - 1e-9);
}

double unloading_time(const ShockState& state, const Material& material, double thickness) {
  const double solid = thickness * density(material) / solid_density(material);
  return thickness / state.shock_speed + solid / bulk_sound_speed(material);
}

}  // namespace recoil
