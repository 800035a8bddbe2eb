#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "app/report/field_frames.hpp"
#include "app/report/page_data.hpp"
#include "app/report/run_dumps.hpp"
#include "config/case.hpp"
#include "picture/field_plane.hpp"
#include "picture/space/surface_net.hpp"

namespace recoil::app {

/// The surfaces of the bodies of a 3-D run for its page, with those fields that are of interest there: faces
/// of four corners, values at their corners half a cell below the surface in 8 bits. Rigid bodies have none.
class SurfaceFrames {
 public:
  /// Reads at most 24 dumps of a run, evenly and the last one always, and fewer where they would take more
  /// than `most` characters. None of another geometry and of a run without dumps.
  SurfaceFrames(const RunDumps& found, const config::Case& c, double most);

  /// Adds them to a page. @returns their JSON; null where there are none.
  Json write(Blocks& blocks) const;
  std::size_t size() const;  ///< characters in the page

 private:
  struct Frame {
    double time_us = 0;
    double spacing_mm = 0;
    std::array<double, 3> low_mm{}, high_mm{};  // around the surface; points count from the low corner
    std::string points{}, faces{};
    std::vector<QuantisedField> values{};
    std::size_t size() const;
  };

  static Frame packed_frame(double time, const SurfaceNet& net, double spacing);
  Frame frame_of(const ChosenDump& dump, const config::Case& c);

  std::vector<std::string> fields_;
  std::vector<Frame> frames_;
};

}  // namespace recoil::app
