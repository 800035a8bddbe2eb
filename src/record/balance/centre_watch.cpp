#include "record/balance/centre_watch.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace recoil {

template <int Dim>
CentreWatch<Dim>::CentreWatch(const std::vector<std::string>& names, const std::vector<bool>& rigid,
                              std::vector<bool> balanced, const std::vector<int>& fragments_of)
    : balanced_(std::move(balanced)) {
  const auto source = [&](std::size_t m) { return fragments_of.empty() ? -1 : fragments_of[m]; };
  for (std::size_t m = 0; m < names.size(); ++m) {
    if (rigid[m] || source(m) >= 0) continue;
    std::vector<std::size_t>& bodies = bodies_.emplace_back();
    for (std::size_t part = 0; part < names.size(); ++part)
      if (part == m || source(part) == static_cast<int>(m)) bodies.push_back(part);
    worst_.push_back({names[m]});
  }
  lines_.resize(bodies_.size());
}

template <int Dim>
typename CentreWatch<Dim>::Sums CentreWatch<Dim>::sums_of(const Totals<Dim>& t, std::size_t l) const {
  Sums s;
  for (const std::size_t m : bodies_[l]) {
    s.mass += t.bodies[m].mass;
    s.place += t.bodies[m].place + t.edges[m].place;
    s.momentum += t.bodies[m].momentum;
  }
  return s;
}

template <int Dim>
void CentreWatch<Dim>::begin(const Totals<Dim>& t) {
  time_ = t.time;
  for (std::size_t l = 0; l < lines_.size(); ++l) {
    const Sums s = sums_of(t, l);
    lines_[l] = {s.mass, s.place, s.momentum, {}, {}, 0};
  }
}

template <int Dim>
void CentreWatch<Dim>::look(const Totals<Dim>& t) {
  const double dt = t.time - time_;
  time_ = t.time;
  for (std::size_t l = 0; l < lines_.size(); ++l) {
    Line& line = lines_[l];
    const Sums now = sums_of(t, l);
    const Vec<Dim> p = now.momentum, off = now.place - line.start - line.carried;
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
    const double distance = line.mass > 0 ? norm(missing) / line.mass : 0;
    if (distance > worst.off) worst = {worst.name, distance, line.way / line.mass, t.time};
  }
}

template class CentreWatch<1>;
template class CentreWatch<2>;
template class CentreWatch<3>;

}  // namespace recoil
