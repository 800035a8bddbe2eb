#include "record/balance/budget.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace recoil {

namespace {

constexpr double least_part = 1e-4;  // of what all bodies hold: a body with less is measured with so much
constexpr double least_speed = 0.1;  // m/s: a body that is slower is measured as if it moved so fast

}  // namespace

template <int Dim>
BudgetWatch<Dim>::BudgetWatch(std::vector<std::string> names, std::vector<bool> rigid,
                              std::vector<bool> balanced)
    : rigid_(std::move(rigid)), balanced_(std::move(balanced)), body_{-1} {
  worst_.push_back({"total"});
  for (std::size_t m = 0; m < names.size(); ++m) {
    if (rigid_[m]) continue;
    body_.push_back(static_cast<int>(m));
    worst_.push_back({names[m]});
  }
  now_ = worst_;
  for (const Drift& line : worst_) turning_.push_back({line.name, {}, {}});
  lines_.resize(body_.size());
}

/// Contents, without what came in and with what went out: constant but for errors.
template <int Dim>
typename BudgetWatch<Dim>::Sums BudgetWatch<Dim>::owed(const Totals<Dim>& t, int body) const {
  const int n = static_cast<int>(t.bodies.size());
  Sums s;
  const auto counts = [&](int m) { return body < 0 ? !rigid_[m] : m == body; };
  const auto add = [&s](double sign, const Account<Dim>& a) {
    s.mass += sign * a.mass;
    s.energy += sign * a.energy;
    s.momentum += sign * a.momentum;
  };
  for (int m = 0; m < n; ++m) {
    if (!counts(m)) continue;
    const auto e = static_cast<std::size_t>(m);
    add(1, {t.bodies[e].mass, t.bodies[e].energy, t.bodies[e].momentum});
    add(1, t.edges[e]);
    if (e < t.released.size()) s.energy -= t.released[e];
    if (e < t.loads.size()) {
      add(-1, t.loads[e]);
      s.angular_momentum -= t.load_moments[e];
    }
    s.speed += t.bodies[e].speed;
    s.angular_momentum += t.bodies[e].angular_momentum;
  }
  for (int a = 0; a < n; ++a)
    for (int b = a + 1; b < n; ++b)
      if (counts(a) != counts(b)) {  // between two that count it cancels
        const int pair = pair_number(a, b, n);
        const double sign = counts(a) ? -1 : 1;
        add(sign, t.pairs[pair]);
        if (!t.moments.empty()) s.angular_momentum += sign * t.moments[pair];
      }
  return s;
}

template <int Dim>
void BudgetWatch<Dim>::begin(const Totals<Dim>& start) {
  for (std::size_t l = 0; l < lines_.size(); ++l) lines_[l].start = owed(start, body_[l]);
  for (std::size_t l = 1; l < lines_.size(); ++l) lines_[l].internal = start.bodies[body_[l]].internal();
  look(start);
}

template <int Dim>
void BudgetWatch<Dim>::judge(std::size_t l, const Sums& s) {
  Line& line = lines_[l];
  line.most_speed = std::max(line.most_speed, s.speed);
  const double mass = line.start.mass != 0 ? std::abs(line.start.mass) : line.most_mass;
  const double speed = std::max({line.most_speed, least_part * lines_[0].most_speed, least_speed * mass}),
               energy = std::max(
                   {line.most_energy, least_part * lines_[0].most_energy, least_speed * least_speed * mass});
  const auto part = [](double error, double whole) {
    return error == 0 ? 0 : error / (whole > 0 ? whole : 1);
  };
  const double mass_error = std::abs(s.mass - line.start.mass),
               energy_error = std::abs(s.energy - line.start.energy);
  double momentum_error = 0;
  for (int d = 0; d < Dim; ++d)
    if (balanced_[d])
      momentum_error = std::max(momentum_error, std::abs(s.momentum[d] - line.start.momentum[d]));
  line.mass_error = std::max(line.mass_error, mass_error);
  line.momentum_error = std::max(line.momentum_error, momentum_error);
  line.energy_error = std::max(line.energy_error, energy_error);
  now_[l] = {now_[l].name, part(mass_error, mass), part(momentum_error, speed), part(energy_error, energy)};
  worst_[l] = {worst_[l].name, part(line.mass_error, mass), part(line.momentum_error, speed),
               part(line.energy_error, energy)};
}

template <int Dim>
void BudgetWatch<Dim>::look(const Totals<Dim>& t) {
  double all = 0, converted = 0;
  for (std::size_t l = 1; l < lines_.size(); ++l) {
    const double energy = t.bodies[body_[l]].energy;
    lines_[l].most_energy = std::max(lines_[l].most_energy, std::abs(energy));
    lines_[l].most_mass = std::max(lines_[l].most_mass, t.bodies[body_[l]].mass);
    all += energy;
    converted += std::abs(t.bodies[body_[l]].internal() - lines_[l].internal);
  }
  converted_ = std::max(converted_, converted);
  lines_[0].most_energy = std::max(lines_[0].most_energy, std::abs(all));
  turning_[0].now = {};
  for (std::size_t l = 0; l < lines_.size(); ++l) {
    const Sums s = owed(t, body_[l]);
    judge(l, s);
    turning_[l].unbalanced = s.angular_momentum - lines_[l].start.angular_momentum;
    if (l == 0) continue;
    turning_[l].now = t.bodies[body_[l]].angular_momentum;
    turning_[0].now += turning_[l].now;
  }
}

template class BudgetWatch<1>;
template class BudgetWatch<2>;
template class BudgetWatch<3>;

}  // namespace recoil
