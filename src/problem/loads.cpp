#include "problem/loads.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "config/formula/formula.hpp"
#include "core/error.hpp"
#include "core/linear_history.hpp"

namespace recoil {

namespace {

using config::Formula;

/// A formula of a load, for several threads at once: they take turns.
class SharedFormula {
 public:
  SharedFormula(const std::string& name, const std::string& key, const std::string& text,
                const config::Domain& domain)
      : name_(name),
        key_(key),
        formula_(text, config::axes_of(domain.geometry), Formula::Of::place_and_time) {}

  double at(const config::Vector& x, double time) {
    const std::lock_guard lock(mutex_);
    const double value = formula_.at(x, time);
    if (std::isfinite(value)) return value;
    throw PhysicsError(fmt::format("'{}' of [load.{}] has no finite value at ({:.4g}) mm, {:.4g} us", key_,
                                   name_, fmt::join({1e3 * x[0], 1e3 * x[1], 1e3 * x[2]}, ", "), 1e6 * time));
  }

 private:
  std::string name_, key_;
  std::mutex mutex_;
  Formula formula_;
};

/// The formula at a key of a load; null where the text is empty.
std::shared_ptr<SharedFormula> formula_at(const config::Load& load, const char* key, const std::string& text,
                                          const config::Domain& domain) {
  return text.empty() ? nullptr : std::make_shared<SharedFormula>(load.name, key, text, domain);
}

/// f at the three points of Gauss between two times, with their weights: exact for polynomials of degree 5.
template <class F>
double mean_over(double from, double to, F&& f) {
  const double middle = 0.5 * (from + to), off = 0.5 * (to - from) * std::sqrt(0.6);
  return (5 * f(middle - off) + 8 * f(middle) + 5 * f(middle + off)) / 18;
}

/// The mean pressure at a place between two times: of a history alone exactly, else by Gauss points.
std::function<double(const config::Vector&, double, double)> mean_pressure(const config::Load& load,
                                                                           const config::Domain& domain) {
  const auto part = formula_at(load, "part", load.part, domain);
  if (!load.history.empty()) {
    LinearHistory<double> history;
    for (const config::TimedPressure& t : load.history) {
      history.times.push_back(t.time);
      history.values.push_back(t.pressure);
    }
    return [history, part](const config::Vector& x, double from, double to) {
      const double pressure = history.mean(from, to);
      if (!part || pressure == 0) return pressure;
      return pressure * mean_over(from, to, [&](double t) { return part->at(x, t); });
    };
  }
  const auto pressure = formula_at(load, "pressure", load.pressure, domain);
  return [pressure, part](const config::Vector& x, double from, double to) {
    return mean_over(from, to, [&](double t) {
      const double whole = pressure->at(x, t);
      return part && whole != 0 ? whole * part->at(x, t) : whole;
    });
  };
}

}  // namespace

template <int Dim>
std::vector<SurfaceLoad<Dim>> surface_loads(const config::Case& c) {
  std::vector<SurfaceLoad<Dim>> all;
  for (const config::Load& load : c.loads) {
    SurfaceLoad<Dim>& to = all.emplace_back();
    const auto body = std::ranges::find(c.bodies, load.body, &config::Body::name);
    to.body = static_cast<int>(body - c.bodies.begin());
    to.facing = config::first_components<Dim>(load.facing);
    to.pressure = [mean = mean_pressure(load, c.domain)](const Vec<Dim>& x, double from, double until) {
      config::Vector at{};
      for (int d = 0; d < Dim; ++d) at[static_cast<std::size_t>(d)] = x[d];
      return mean(at, from, until);
    };
  }
  return all;
}

template std::vector<SurfaceLoad<1>> surface_loads<1>(const config::Case&);
template std::vector<SurfaceLoad<2>> surface_loads<2>(const config::Case&);
template std::vector<SurfaceLoad<3>> surface_loads<3>(const config::Case&);

}  // namespace recoil
