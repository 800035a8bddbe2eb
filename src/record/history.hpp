#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "format/csv.hpp"
#include "format/run_units.hpp"
#include "record/balance/budget.hpp"

namespace recoil {

/// Which bodies have a load on their surface.
template <int Dim>
std::vector<bool> loaded_bodies(const State<Dim>& state);

/// history.csv: `time [us]`, then for every deformable body, and for `total`, columns NAME.QUANTITY:
/// mass, momentum.AXIS, angular-momentum.AXIS (planar: z; 3d), kinetic, internal, volume;
/// exchange.impulse.AXIS, exchange.moment.AXIS and exchange.work, received over the contacts since the start
/// (for `total`: from rigid bodies); edges.mass, edges.momentum.AXIS, edges.energy, what has left through the
/// edges of the domain; of bodies with a load, load.impulse.AXIS, load.moment.AXIS, load.work, received from
/// it; drift.mass, drift.momentum, drift.energy (see Drift). On rank 0 only.
template <int Dim>
class History {
 public:
  /// @throws EnvironmentError. @param loaded which bodies have a load.
  /// @param mode append: goes on with the file that is there.
  History(const std::filesystem::path& path, const std::vector<std::string>& names,
          const std::vector<bool>& rigid, const std::vector<bool>& loaded, const RunUnits& units,
          CsvMode mode = CsvMode::create);
  /// @param drifts of this time, `total` first, as BudgetWatch::now().
  void row(const Totals<Dim>& totals, const std::vector<Drift>& drifts);
  void flush() { file_->flush(); }

 private:
  bool any_loaded() const { return std::ranges::find(loaded_, true) != loaded_.end(); }

  std::vector<bool> rigid_, loaded_;
  double whole_;
  std::size_t turns_;
  std::optional<CsvWriter> file_;
  std::vector<double> values_;
};

}  // namespace recoil
