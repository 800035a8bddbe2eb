#include "record/balance/centre_watch.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace recoil {

template <int Dim>
CentreWatch<Dim>::CentreWatch(const std::vector<std::string>& names, const std::vector<bool>& rigid,
                              std::vector<bool> balanced)
    : balanced_(std::move(balanced)) {
  for (std::size_t m = 0; m < names.size(); ++m) {
    if (rigid[m]) continue;
    body_.push_back(m);
    worst_.push_back({names[m]});
  }
  lines_.resize(body_.size());
}

template <int Dim>
Vec<Dim> CentreWatch<Dim>::place_of(const Totals<Dim>& t, std::size_t l) const {
  return t.bodies[body_[l]].place + t.edges[body_[l]].place;
}

template <int Dim>
void CentreWatch<Dim>::begin(const Totals<Dim>& t) {
  time_ = t.time;
  for (std::size_t l = 0; l < lines_.size(); ++l)
    lines_[l] = {t.bodies[body_[l]].mass, 0, place_of(t, l), t.bodies[body_[l]].momentum, {}, {}, 0};
}

template <int Dim>
void CentreWatch<Dim>::look(const Totals<Dim>& t) {
  const double dt = t.time - time_;
  time_ = t.time;
  for (std::size_t l = 0; l < lines_.size(); ++l) {
    Line& line = lines_[l];
    const Vec<Dim> p = t.bodies[body_[l]].momentum, off = place_of(t, l) - line.start - line.carried;
    Vec<Dim> missing, step;
    for (int d = 0; d < Dim; ++d) {
      if (!balanced_[static_cast<std::size_t>(d)] || !std::isfinite(off[d])) continue;  // periodic: NaN
      step[d] = 0.5 * dt * (p[d] + line.momentum[d]);
      line.uncertain[d] += 0.5 * dt * std::abs(p[d] - line.momentum[d]);
      missing[d] = std::max(std::abs(off[d] - step[d]) - line.uncertain[d], 0.0);
    }
    line.carried += step, line.way += norm(step);
    line.momentum = p;
    CentreOff& worst = worst_[l];
    line.most_mass = std::max(line.most_mass, t.bodies[body_[l]].mass);
    const double mass = line.mass > 0 ? line.mass : line.most_mass;
    const double distance = mass > 0 ? norm(missing) / mass : 0;
    if (distance > worst.off) worst = {worst.name, distance, line.way / mass, t.time};
  }
}

template class CentreWatch<1>;
template class CentreWatch<2>;
template class CentreWatch<3>;

}  // namespace recoil
