#include "material/eos/eos_table.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace recoil {

namespace {

constexpr double thinnest = 0.5;       // of the density at rest, to which tables are continued
constexpr double continued_by = 0.01;  // of the same, between the rows of the continuation
constexpr double snapped = 0.1;        // of a row's spacing, within which rest takes its place
constexpr const char* cut_it =
    "leave those densities out by least-density or most-density, or take a table without that";

std::string g_per_cm3(double rho) { return fmt::format("{:.6g} g/cm3", rho * 1e-3); }

/// Steffen's slopes of values y over x: a monotone cubic wherever the values are monotone. Without a limit:
/// those of parabolas through three neighbours, which keep their order where the values turn round.
std::vector<double> steffen(const std::vector<double>& x, const std::vector<double>& y, bool limit = true) {
  const std::size_t n = x.size();
  std::vector<double> slope(n);
  const auto secant = [&](std::size_t k) { return (y[k + 1] - y[k]) / (x[k + 1] - x[k]); };
  const auto width = [&](std::size_t k) { return x[k + 1] - x[k]; };
  const auto limited = [](double wish, double s) {
    if (wish * s <= 0) return 0.0;
    return std::abs(wish) > 2 * std::abs(s) ? 2 * s : wish;
  };
  for (std::size_t k = 1; k + 1 < n; ++k) {
    const double a = secant(k - 1), b = secant(k);
    const double mean = (a * width(k) + b * width(k - 1)) / (width(k) + width(k - 1));
    if (!limit) {
      slope[k] = mean;
      continue;
    }
    const double least = std::min({std::abs(a), std::abs(b), 0.5 * std::abs(mean)});
    slope[k] = a * b <= 0 ? 0.0 : std::copysign(2 * least, a);
  }
  const auto at_end = [&](std::size_t first, std::size_t next) {
    const double share = width(first) / (width(first) + width(next));
    const double parabola = secant(first) * (1 + share) - secant(next) * share;
    return limit ? limited(parabola, secant(first)) : parabola;
  };
  slope[0] = at_end(0, 1);
  slope[n - 1] = at_end(n - 2, n - 3);
  return slope;
}

struct Grid {
  RawEosTable& raw;
  std::size_t columns() const { return raw.temperature.size(); }
  std::size_t rows() const { return raw.density.size(); }
  double& p(std::size_t i, std::size_t j) const { return raw.pressure[i * columns() + j]; }
  double& e(std::size_t i, std::size_t j) const { return raw.energy[i * columns() + j]; }
};

/// Rows of densities within the limits; a row of density zero holds no state.
RawEosTable within(const RawEosTable& raw, const EosTable::Limits& limits) {
  RawEosTable kept;
  kept.temperature = raw.temperature;
  const auto n = static_cast<std::ptrdiff_t>(raw.temperature.size());
  for (std::size_t i = 0; i < raw.density.size(); ++i) {
    const double rho = raw.density[i];
    if (!(rho > 0) || rho < limits.least || (limits.most > 0 && rho > limits.most)) continue;
    kept.density.push_back(rho);
    const auto at = static_cast<std::ptrdiff_t>(i) * n;
    kept.pressure.insert(kept.pressure.end(), raw.pressure.begin() + at, raw.pressure.begin() + at + n);
    kept.energy.insert(kept.energy.end(), raw.energy.begin() + at, raw.energy.begin() + at + n);
  }
  return kept;
}

/// The part of the way from isotherm j to the next at which t lies.
std::size_t isotherm_below(const std::vector<double>& temperature, double t) {
  std::size_t j = 0;
  while (j + 2 < temperature.size() && temperature[j + 1] <= t) ++j;
  return j;
}

/// Makes t an isotherm of the table. @returns its number.
std::size_t add_isotherm(RawEosTable& raw, double t) {
  const std::size_t j = isotherm_below(raw.temperature, t), n = raw.temperature.size();
  for (const std::size_t own : {j, j + 1})
    if (std::abs(raw.temperature[own] - t) < 1e-9 * t) return own;
  const double part = (t - raw.temperature[j]) / (raw.temperature[j + 1] - raw.temperature[j]);
  for (auto* values : {&raw.pressure, &raw.energy}) {
    std::vector<double> wider;
    for (std::size_t i = 0; i < raw.density.size(); ++i)
      for (std::size_t k = 0; k < n; ++k) {
        const double* row = values->data() + i * n;
        wider.push_back(row[k]);
        if (k == j) wider.push_back(row[j] + part * (row[j + 1] - row[j]));
      }
    *values = std::move(wider);
  }
  raw.temperature.insert(raw.temperature.begin() + static_cast<std::ptrdiff_t>(j) + 1, t);
  return j + 1;
}

/// Values of one isotherm, or with `less` of its difference to the one before.
std::vector<double> column_of(const RawEosTable& raw, const std::vector<double>& values, std::size_t j,
                              bool less) {
  std::vector<double> column;
  const std::size_t n = raw.temperature.size();
  for (std::size_t i = 0; i < raw.density.size(); ++i)
    column.push_back(values[i * n + j] - (less ? values[i * n + j - 1] : 0.0));
  return column;
}

double cubic(double x0, double x1, double y0, double y1, double s0, double s1, double x) {
  const double h = x1 - x0, u = (x - x0) / h, v = 1 - u;
  return v * v * (1 + 2 * u) * y0 + h * u * v * v * s0 + u * u * (1 + 2 * v) * y1 - h * u * u * v * s1;
}

/// The row of a density between rows i and i + 1, as the interpolation has it.
std::vector<double> row_between(const RawEosTable& raw, const std::vector<double>& values, std::size_t i,
                                double rho) {
  std::vector<double> row;
  for (std::size_t j = 0; j < raw.temperature.size(); ++j) {
    const std::vector<double> y = column_of(raw, values, j, j > 0),
                              s = steffen(raw.density, y, j > 0 || &values == &raw.pressure);
    const double part = cubic(raw.density[i], raw.density[i + 1], y[i], y[i + 1], s[i], s[i + 1], rho);
    row.push_back(part + (j > 0 ? row[j - 1] : 0.0));
  }
  return row;
}

/// Makes the density without pressure on isotherm j a row of the table, and its energy zero.
/// @returns its number; that of the last row: there is none.
std::size_t add_rest(RawEosTable& raw, std::size_t j) {
  const Grid g{raw};
  std::size_t i = g.rows() - 1;
  while (i > 0 && !(g.p(i - 1, j) <= 0 && g.p(i, j) > 0)) --i;
  if (i == 0) return g.rows() - 1;
  --i;
  double lo = raw.density[i], hi = raw.density[i + 1];
  const double width = hi - lo;
  for (int k = 0; k < 100 && hi - lo > 1e-15 * hi; ++k) {
    const double middle = 0.5 * (lo + hi);
    (row_between(raw, raw.pressure, i, middle)[j] > 0 ? hi : lo) = middle;
  }
  const double rho = 0.5 * (lo + hi), from = raw.density[i];
  const std::vector<double> p = row_between(raw, raw.pressure, i, rho),
                            e = row_between(raw, raw.energy, i, rho);
  const auto n = static_cast<std::ptrdiff_t>(g.columns());
  std::size_t row = i + 1;
  if (rho - from < snapped * width)
    row = i;
  else if (rho - from < (1 - snapped) * width) {
    const auto at = static_cast<std::ptrdiff_t>(row) * n;
    raw.density.insert(raw.density.begin() + static_cast<std::ptrdiff_t>(row), rho);
    raw.pressure.insert(raw.pressure.begin() + at, p.begin(), p.end());
    raw.energy.insert(raw.energy.begin() + at, e.begin(), e.end());
  }
  raw.density[row] = rho;
  for (std::size_t k = 0; k < p.size(); ++k) g.p(row, k) = p[k], g.e(row, k) = e[k];
  const double zero = e[j];
  for (double& value : raw.energy) value -= zero;
  g.p(row, j) = 0;
  return row;
}

/// Rows below the table's first, down to thinnest: p of each isotherm falls along one straight line, that of
/// isotherm `rest`; the part of p that heat makes stays, and e follows from de/drho = (p - T dp/dT)/rho^2.
void continue_downwards(RawEosTable& raw, std::size_t rest, double rest_density) {
  const double r = raw.density.front(), least = thinnest * rest_density;
  if (r <= least) return;
  const std::size_t n = raw.temperature.size();
  const auto rows = static_cast<std::size_t>(std::ceil((r - least) / (continued_by * rest_density)));
  const double fall = steffen(raw.density, column_of(raw, raw.pressure, rest, false))[0];
  std::vector<double> by_density;
  for (std::size_t j = 0; j < n; ++j)
    by_density.push_back(steffen(raw.density, column_of(raw, raw.energy, j, false))[0]);
  RawEosTable longer;
  longer.temperature = raw.temperature;
  for (std::size_t k = 0; k < rows; ++k) {
    const double rho = least + (r - least) * static_cast<double>(k) / static_cast<double>(rows);
    longer.density.push_back(rho);
    for (std::size_t j = 0; j < n; ++j) {
      longer.pressure.push_back(raw.pressure[j] + fall * (rho - r));
      longer.energy.push_back(raw.energy[j] + by_density[j] * r * (1 - r / rho) +
                              fall * (std::log(rho / r) + r / rho - 1));
    }
  }
  longer.density.insert(longer.density.end(), raw.density.begin(), raw.density.end());
  longer.pressure.insert(longer.pressure.end(), raw.pressure.begin(), raw.pressure.end());
  longer.energy.insert(longer.energy.end(), raw.energy.begin(), raw.energy.end());
  raw = std::move(longer);
}

std::string fault_of_order(const RawEosTable& raw) {
  const auto rising = [](const std::vector<double>& x) {
    for (std::size_t k = 1; k < x.size(); ++k)
      if (!(x[k] > x[k - 1])) return false;
    return true;
  };
  if (raw.density.size() < 4) return "fewer than four densities are left of the table";
  if (raw.temperature.size() < 2) return "the table has fewer than two temperatures";
  if (!rising(raw.density)) return "the densities of the table do not rise";
  if (!rising(raw.temperature)) return "the temperatures of the table do not rise";
  for (std::size_t i = 0; i < raw.density.size(); ++i)
    for (std::size_t j = 1; j < raw.temperature.size(); ++j) {
      const std::size_t k = i * raw.temperature.size() + j;
      const bool energy = raw.energy[k] > raw.energy[k - 1], pressure = raw.pressure[k] > raw.pressure[k - 1];
      if (energy && pressure) continue;
      return fmt::format("at {}, from {:.6g} to {:.6g} K, the {} does not rise", g_per_cm3(raw.density[i]),
                         raw.temperature[j - 1], raw.temperature[j], energy ? "pressure" : "energy");
    }
  return {};
}

}  // namespace

EosTable::EosTable(RawEosTable raw, const Limits& limits, std::string& problem, std::string& help) {
  raw = within(raw, limits);
  help = cut_it;
  if (problem = fault_of_order(raw); !problem.empty()) return;
  const double t = limits.temperature;
  if (t < raw.temperature.front() || t > raw.temperature.back()) {
    problem = fmt::format("the table has {:.6g} to {:.6g} K, not the initial temperature {:.6g} K",
                          raw.temperature.front(), raw.temperature.back(), t);
    help = "thermal.initial-temperature must be one of the table's";
    return;
  }
  const std::size_t column = add_isotherm(raw, t), row = add_rest(raw, column);
  if (row == raw.density.size() - 1) {
    problem = fmt::format("at {:.6g} K no density between {} and {} is free of pressure", t,
                          g_per_cm3(raw.density.front()), g_per_cm3(raw.density.back()));
    help = "the state at rest must be in the table: widen least-density, or change initial-temperature";
    return;
  }
  rest_density_ = raw.density[row];
  continue_downwards(raw, column, rest_density_);
  if (problem = fault_of_order(raw); !problem.empty()) return;
  use(raw);
  if (problem = faults(); problem.empty()) help.clear();
}

void EosTable::use(const RawEosTable& raw) {
  density_ = raw.density;
  temperature_ = raw.temperature;
  const std::size_t n = temperature_.size();
  nodes_.resize(density_.size() * n);
  const std::vector<double>* values[2] = {&raw.energy, &raw.pressure};
  for (int what = 0; what < 2; ++what) {
    std::vector<double> slope(density_.size(), 0.0);
    for (std::size_t j = 0; j < n; ++j) {
      // The energy of an isotherm falls and rises again; what must not turn are pressures and differences.
      const std::vector<double> more =
          steffen(density_, column_of(raw, *values[what], j, j > 0), j > 0 || what == 1);
      for (std::size_t i = 0; i < density_.size(); ++i) {
        slope[i] += more[i];
        nodes_[i * n + j].value[what] = (*values[what])[i * n + j];
        nodes_[i * n + j].slope[what] = slope[i];
      }
    }
  }
  find_starts();
}

void EosTable::find_starts() {
  const std::size_t widths = 8 * density_.size();
  const double lo = density_.front(), width = (density_.back() - lo) / static_cast<double>(widths);
  per_width_ = 1 / width;
  std::size_t row = 0;
  start_.clear();
  for (std::size_t k = 0; k <= widths; ++k) {
    // A little below, so that rounding never starts beyond the row.
    const double from = lo + width * (static_cast<double>(k) - 0.01);
    while (row + 2 < density_.size() && density_[row + 1] <= from) ++row;
    start_.push_back(row);
  }
}

/// Under pressure sound must have a speed. In tension it need not: there matter tears.
std::string EosTable::faults() const {
  for (std::size_t i = 0; i + 1 < density_.size(); ++i)
    for (std::size_t j = 0; j < temperature_.size(); ++j)
      for (const double part : {0.0, 0.5}) {
        const double rho = density_[i] + part * (density_[i + 1] - density_[i]);
        const double e = energy_at(rho, temperature_[j]), p = pressure(rho, e);
        if (!std::isfinite(p) || !std::isfinite(e))
          return fmt::format("at {} and {:.6g} K it is not a number", g_per_cm3(rho), temperature_[j]);
        if (p >= 0 && !(sound_speed_squared(rho, p) > 0))
          return fmt::format(
              "at {} and {:.6g} K, under pressure, the square of the sound speed is {:.4g} m2/s2",
              g_per_cm3(rho), temperature_[j], sound_speed_squared(rho, p));
      }
  return {};
}

double EosTable::energy_at(double rho, double t) const {
  const Weights w = weights(rho);
  const std::size_t j = isotherm_below(temperature_, t);
  const double part = (t - temperature_[j]) / (temperature_[j + 1] - temperature_[j]);
  const double low = w.value(node(w.row, j), node(w.row + 1, j), 0);
  return low + part * (w.value(node(w.row, j + 1), node(w.row + 1, j + 1), 0) - low);
}

}  // namespace recoil
