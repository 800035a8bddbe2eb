#pragma once

#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>

#include "material/eos/density_range.hpp"
#include "material/eos/eos_table.hpp"
#include "material/parameter.hpp"

namespace recoil {

/// An equation of state that a file tabulates over density and temperature, see EosTable. The state at rest
/// is the one without pressure at the material's initial temperature.
struct Tabular {
  std::string file;                            // as written: seen from the folder of what names it
  double least_density = 0, most_density = 0;  // kg/m3; 0: as the table has
  std::filesystem::path path = {};             // of the file
  std::shared_ptr<const EosTable> table = {};
  double rho0 = unset;      // kg/m3
  DensityRange range = {};  // of what the table has

  static constexpr const char* kind = "tabular";
  static constexpr const char* doc = "a table over density and temperature, in the text form of SESAME";
  static constexpr bool barotropic = false;

  static constexpr auto parameters() {
    using P = Parameter<Tabular>;
    return std::array{P{"least-density", "kg/m3", &Tabular::least_density, 0, 3e4,
                        "densities below are not read; 0: all are"},
                      P{"most-density", "kg/m3", &Tabular::most_density, 0, 1e6,
                        "densities above are not read; 0: all are"}};
  }
  static std::array<TextParameter<Tabular>, 1> texts() {
    return {{{"file", &Tabular::file, "the table, its path seen from the folder of this file",
              "\"copper.sesame\""}}};
  }

  /// Takes a table. @return what is wrong with it; empty: nothing. @param help how to cure it
  std::string take(const RawEosTable& raw, double rest_temperature, std::string& help) {
    std::string problem;
    table = std::make_shared<const EosTable>(
        raw, EosTable::Limits{rest_temperature, least_density, most_density}, problem, help);
    if (!problem.empty()) return problem;
    rho0 = table->rest_density();
    range = {table->least_density() / rho0, table->most_density() / rho0};
    return problem;
  }

  double pressure(double rho, double e) const { return table->pressure(rho, e); }
  double energy(double rho, double p) const { return table->energy(rho, p); }
  double sound_speed_squared(double rho, double p) const { return table->sound_speed_squared(rho, p); }
  bool admissible(double rho) const { return rho > 0 && rho < largest_density(); }
  double largest_density() const { return table->most_density(); }
};

/// Bulk sound speed at rest [m/s].
inline double bulk_sound_speed(const Tabular& eos) { return std::sqrt(eos.sound_speed_squared(eos.rho0, 0)); }

}  // namespace recoil
