#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "gauge/totals.hpp"
#include "record/quantities.hpp"
#include "record/summary.hpp"
#include "state/body.hpp"

namespace recoil::app {

/// What a finished run found out, as quantities.csv and gauges/ in its folder have it.
struct RunQuantities {
  Quantities found;                // SI; pairs of bodies by both orders of their names
  std::vector<std::string> names;  // of quantities.csv, in its order
  std::filesystem::path file;      // quantities.csv
};

/// quantities.csv of a run: every number and flag that an expectation can name, but not what gauges hold.
/// Collective; the first process writes. @throws EnvironmentError.
template <int Dim>
void write_quantities(const std::filesystem::path& file, const config::Case& c, const State<Dim>& state,
                      const Summary& summary, const parallel::World& world, parallel::Team& team);

/// Whether the folder holds a finished run with its quantities.
bool has_quantities(const std::filesystem::path& run);

/// @param case_folder where the reference curves lie that a quantity may name.
/// @throws InputError for a folder without a finished run, or files that cannot be read.
RunQuantities read_quantities(const std::filesystem::path& run, const std::filesystem::path& case_folder);

/// The value of one: a number, or 1 or 0 of a flag; NaN where there is none, because it did not happen.
/// @throws InputError for a name that the run does not have.
double value_of(const RunQuantities& run, const std::string& quantity);

/// Of every gauge over time the peak of its main column: "gauge.rear.velocity.peak".
std::vector<std::string> peaks_of_gauges(const RunQuantities& run);

/// Largest, smallest and last value of every column of every gauge over time.
std::vector<std::string> extremes_of_gauges(const RunQuantities& run);

}  // namespace recoil::app
