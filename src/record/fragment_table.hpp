#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "format/csv.hpp"
#include "format/run_units.hpp"
#include "gauge/fragments/fragments.hpp"

namespace recoil {

/// The fragments of one body in short, in SI; of an axisymmetric body whole rings.
struct BodyFragments {
  /// The heaviest pieces; NaN where there are not so many.
  struct Piece {
    double mass = 0;
    std::vector<double> velocity;  // by axis

    template <class Archive>
    void transfer(Archive& a) {
      a(mass, velocity);
    }
  };
  static constexpr std::size_t told = 3;

  std::string body;
  int pieces = 0, heaps = 0;    // of rubble
  double rubble = 0;            // kg
  std::vector<Piece> heaviest;  // as many as told

  template <class Archive>
  void transfer(Archive& a) {
    a(body, pieces, heaps, rubble, heaviest);
  }
};

/// fragments.csv: at each dump of fields one line for each fragment. Columns: `time [us]`, `fragment` (its
/// number at this time, from 1: as the field variable has it), `body`, `kind` (piece, rubble), `mass`,
/// `failed-mass`, `volume`, `position.AXIS`, `velocity.AXIS`, `kinetic`, `lowest.AXIS`, `highest.AXIS`,
/// `diameter`, `cells`. On rank 0 only.
template <int Dim>
class FragmentTable {
 public:
  FragmentTable(std::vector<std::string> names, std::vector<bool> rigid, const RunUnits& units);
  /// Opens the file. @param last when appending: later times are taken out [s]. @throws InputError where rows
  /// of that time are missing; EnvironmentError.
  void open(const std::filesystem::path& path, CsvMode mode, double last);
  /// Adds the fragments of a time [s].
  void write(const Fragments<Dim>& fragments, double time);
  /// Those written last, by deformable body; before the first time no pieces.
  const std::vector<BodyFragments>& last() const { return last_; }

  /// For checkpoints (parallel/archive.hpp).
  template <class Archive>
  void transfer(Archive& a) {
    a(last_);
  }

 private:
  void begin_telling();
  void tell(const Fragment<Dim>& fragment);

  std::vector<std::string> names_;
  std::vector<bool> rigid_;
  RunUnits units_;
  std::optional<CsvWriter> file_;
  std::vector<BodyFragments> last_;
};

}  // namespace recoil
