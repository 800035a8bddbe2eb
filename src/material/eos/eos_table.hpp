#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace recoil {

/// A table as a file holds it: p and e at `density` i and `temperature` j stand at [i * temperatures + j].
struct RawEosTable {
  std::vector<double> density;           // kg/m3
  std::vector<double> temperature;       // K
  std::vector<double> pressure, energy;  // Pa, J/kg
};

/// Pressure and energy over density and temperature, interpolated so that energy and pressure rise with
/// temperature everywhere if they do between the table's own states: monotone cubics in density (Steffen,
/// Astron. Astrophys. 239 (1990) 443) for the pressure of the lowest isotherm and for the difference of each
/// isotherm to the next (its energy turns, and has a cubic without limits), straight lines of pressure over
/// energy between isotherms. The inversion of e(rho, T) is closed. The state at rest, without pressure at the
/// temperature of rest, is a point of the table, its energy zero.
class EosTable {
 public:
  struct Limits {
    double temperature = 298;    // K, at rest
    double least = 0, most = 0;  // kg/m3, of the densities that are used; 0: as the table has
  };

  /// Densities below half of that at rest need not be in the file: see docs/theory.md.
  /// @param problem what is wrong, where; empty if nothing is. @param help how to cure it
  EosTable(RawEosTable raw, const Limits& limits, std::string& problem, std::string& help);

  double rest_density() const { return rest_density_; }      // kg/m3
  double least_density() const { return density_.front(); }  // kg/m3
  double most_density() const { return density_.back(); }    // kg/m3

  /// Pressure [Pa] at density rho [kg/m3] and energy e [J/kg]. Beyond the densities of the table straight on
  /// along isotherms, beyond its temperatures straight on at constant density.
  double pressure(double rho, double e) const {
    const Weights w = weights(rho);
    const Between at = between<0>(w, e);
    return at.low[1] + at.part * (at.high[1] - at.low[1]);
  }
  /// Temperature [K].
  double temperature(double rho, double e) const {
    const Between at = between<0>(weights(rho), e);
    return temperature_[at.column] + at.part * (temperature_[at.column + 1] - temperature_[at.column]);
  }
  /// Energy [J/kg] at density rho and pressure p [Pa].
  double energy(double rho, double p) const {
    const Between at = between<1>(weights(rho), p);
    return at.low[0] + at.part * (at.high[0] - at.low[0]);
  }
  /// (dp/drho) at constant entropy [m2/s2], of the interpolated functions themselves.
  double sound_speed_squared(double rho, double p) const {
    const Weights w = weights(rho);
    const Between at = between<1>(w, p);
    const double by_energy = (at.high[1] - at.low[1]) / (at.high[0] - at.low[0]);
    const auto slope = [&](int what) {
      const double low = w.slope(node(w.row, at.column), node(w.row + 1, at.column), what);
      const double high = w.slope(node(w.row, at.column + 1), node(w.row + 1, at.column + 1), what);
      return low + at.part * (high - low);
    };
    return slope(1) + by_energy * (p / (rho * rho) - slope(0));
  }
  /// State on an isotherm of the table's interpolation: e [J/kg] at temperature T [K].
  double energy_at(double rho, double t) const;

 private:
  struct Node {
    double value[2], slope[2];  // energy, pressure, and their slopes over density
  };
  /// Of the values and slopes at both ends of an interval of density.
  struct Weights {
    std::size_t row;
    double low, low_slope, high, high_slope;
    double d_low, d_low_slope, d_high, d_high_slope;  // the same of the slope
    double value(const Node& a, const Node& b, int what) const {
      return low * a.value[what] + low_slope * a.slope[what] + high * b.value[what] +
             high_slope * b.slope[what];
    }
    double slope(const Node& a, const Node& b, int what) const {
      return d_low * a.value[what] + d_low_slope * a.slope[what] + d_high * b.value[what] +
             d_high_slope * b.slope[what];
    }
  };
  /// Between which isotherms a state lies, and where.
  struct Between {
    std::size_t column;
    double low[2], high[2], part;
  };

  const Node& node(std::size_t row, std::size_t column) const {
    return nodes_[row * temperature_.size() + column];
  }

  Weights weights(double rho) const {
    if (!(rho >= density_.front())) return {0, 1, rho - density_.front(), 0, 0, 0, 1, 0, 0};
    if (rho >= density_.back()) return {density_.size() - 2, 0, 0, 1, rho - density_.back(), 0, 0, 0, 1};
    std::size_t row = start_[static_cast<std::size_t>((rho - density_.front()) * per_width_)];
    while (density_[row + 1] <= rho) ++row;
    const double h = density_[row + 1] - density_[row], u = (rho - density_[row]) / h, v = 1 - u;
    return {row,
            v * v * (1 + 2 * u),
            h * u * v * v,
            u * u * (1 + 2 * v),
            -h * u * u * v,
            -6 * u * v / h,
            v * (v - 2 * u),
            6 * u * v / h,
            u * (u - 2 * v)};
  }

  /// By the energy (What = 0) or the pressure (1).
  template <int What>
  Between between(const Weights& w, double target) const {
    std::size_t low = 0, high = temperature_.size() - 1;
    while (high - low > 1) {
      const std::size_t middle = (low + high) / 2;
      (w.value(node(w.row, middle), node(w.row + 1, middle), What) <= target ? low : high) = middle;
    }
    Between at{low, {}, {}, 0};
    for (int what = 0; what < 2; ++what) {
      at.low[what] = w.value(node(w.row, low), node(w.row + 1, low), what);
      at.high[what] = w.value(node(w.row, low + 1), node(w.row + 1, low + 1), what);
    }
    at.part = (target - at.low[What]) / (at.high[What] - at.low[What]);
    return at;
  }

  void use(const RawEosTable& raw);
  void find_starts();
  std::string faults() const;

  std::vector<double> density_, temperature_;  // kg/m3, K
  std::vector<Node> nodes_;
  double rest_density_ = 0;         // kg/m3
  std::vector<std::size_t> start_;  // for equal widths of density: the row in which each begins
  double per_width_ = 0;            // m3/kg
};

/// A table read from a file, or why it could not be.
struct EosTableFile {
  RawEosTable table;
  std::string problem, help;  // empty: all is well
};

/// Reads a table 301 of SESAME's text form: words in the order nr, nt, densities [g/cm3], temperatures [K],
/// pressures [GPa], energies [MJ/kg], both with the density running fastest; what follows (free energies) is
/// not used. Header lines that name a material, a table and its length are understood, and tables other than
/// 301 are passed over; lines that begin with # are comments.
EosTableFile read_eos_table(const std::filesystem::path& path);
EosTableFile parse_eos_table(std::string_view text);

/// The opposite of parse_eos_table().
std::string to_text(const RawEosTable& table, const std::string& comment);

}  // namespace recoil
