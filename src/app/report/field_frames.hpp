#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "app/load_case.hpp"
#include "app/plot/round_off.hpp"
#include "app/report/page_data.hpp"
#include "app/report/run_dumps.hpp"
#include "config/case.hpp"
#include "format/vtkhdf.hpp"
#include "picture/field_plane.hpp"
#include "picture/field_scalar.hpp"

namespace recoil::app {

/// One scalar in one frame: whole numbers from 1 to 2^bits - 1, 0 where there is no matter.
struct QuantisedField {
  std::string packed;
  double lowest = 0, step = 0;  ///< value of 1, difference between neighbouring numbers
};

/// @param exact the values are whole numbers, and stay so.
QuantisedField quantised(const std::vector<double>& values, int bits, bool exact);

/// The fields of a run for its page: planes (one; in 3d one across each axis), each with its frames of
/// quantised values and outlines of bodies.
class FieldFrames {
 public:
  /// Reads the dumps of a run; one without dumps has no frames. Where they would take more than `most`
  /// characters, values are stored in 8 bits instead of 12, and then frames are left out.
  FieldFrames(const RunDumps& found, const LoadedCase& loaded, double most);

  /// Adds them to a page. @returns their JSON; null where there are none.
  Json write(Blocks& blocks) const;
  /// What had to be left out, in words; empty: nothing.
  std::string omission() const;
  /// Whether frames were left out because they would take too much.
  bool is_thinned() const { return shown() < whole_; }

 private:
  struct Frame {                         // NOLINT(bugprone-exception-escape): moving JSON does not throw
    Json head;                           // time, size and place of the cells
    std::vector<QuantisedField> values;  // of the scalars, in their order
    std::string outlines;
    std::size_t size() const;
  };
  struct Plane {  // NOLINT(bugprone-exception-escape): likewise
    Json head;    // name, axes
    Cut cut;
    std::vector<Frame> frames;
  };
  /// Least and largest of all frames; the same without the outermost parts of each frame.
  struct Extremes {
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    double low = lowest, high = highest;
    std::set<double> values;  // of a scalar with few
  };

  void add_planes(const config::Case& c);
  void choose_detail(const std::vector<ChosenDump>& dumps, double most);
  void add_dump(const ChosenDump& chosen);
  Frame frame_of(const VtkhdfFile& dump, const Cut& cut);
  void note(const FieldScalar& scalar, const std::vector<double>& values);
  void choose_scalars(const UnstructuredGrid& grid);
  Json variable(const FieldScalar& scalar) const;
  std::size_t size() const;
  std::size_t shown() const { return planes_.empty() ? 0 : planes_.front().frames.size(); }
  void thin_out(double most);

  RunUnits units_;
  RoundOff round_off_;
  int bits_ = 12;
  std::size_t dumps_ = 0, whole_ = 0;  // of the run; those that can be read
  std::vector<Plane> planes_;
  std::vector<FieldScalar> scalars_;     // stored
  std::vector<FieldScalar> magnitudes_;  // of vectors, which the page makes from their components
  std::vector<std::string> bodies_;
  std::map<std::string, Extremes> extremes_;  // by the name of the scalar
};

}  // namespace recoil::app
