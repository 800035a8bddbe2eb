#pragma once

#include <optional>
#include <string>
#include <utility>

namespace recoil::app {

struct LoadedCase;

/// The text in brackets at the end of a label; "1" where there is none.
std::string unit_in(const std::string& label);

/// What values are, judged against the noise that sums of rounded numbers leave.
enum class Spread { real, round_off, uniform };

/// Differences of a field that are round-off and no physics. A body in free flight shows stresses of 1e-3 Pa
/// after some hundred steps, 5e-15 of rho c_L^2 (cases/free_flight_*); over 1e6 steps noise that adds up as a
/// random walk is a hundred times as large. Below `part` of the scale nothing can be told from noise: of
/// stresses rho c_L^2 of the stiffest body, of velocities its c_L, of energies c_L^2.
struct RoundOff {
  static constexpr double part = 1e-10;
  /// Of numbers in dumps, which have seven digits, of those in tables, which have more.
  static constexpr double of_dumps = 5e-7, of_tables = 1e-12;

  double stress = 0;       // Pa
  double speed = 0;        // m/s
  double density = 0;      // kg/m3
  double temperature = 0;  // K
  double length = 0;       // m
  double number = 0;       // of strains, damage and parts

  /// In that unit; 0 where nothing is known of it.
  double in(const std::string& unit) const;
  /// @param digits the smallest difference that the numbers can show, of the largest.
  Spread judge(const std::string& unit, double lowest, double highest, double digits) const;
};

RoundOff round_off_of(const LoadedCase& run);
/// Of the run in a folder; zeros where it has no case.
RoundOff round_off_of(const std::string& folder);

/// The ends of colours or of an axis for values that are round-off, or all the same; none for others.
/// @param signed_values zero is in the middle.
std::optional<std::pair<double, double>> honest_range(Spread spread, double least, double lowest,
                                                      double highest, bool signed_values);

/// "pressure [GPa], round-off only".
std::string noted(const std::string& label, Spread spread);

}  // namespace recoil::app
