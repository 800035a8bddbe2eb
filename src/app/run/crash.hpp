#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "config/case.hpp"
#include "format/unstructured_grid.hpp"
#include "state/body.hpp"

namespace recoil::app {

/// What is known of the failure of a run.
struct Failure {
  std::string text;           // what was said of it, in full
  std::string body;           // empty: not of one body
  std::vector<double> place;  // m; empty: not known
  double last_step = 0;       // s
};

/// Writes to the folder `crash` of a run what one process knows of a failure: process_N.txt (text, counters,
/// the states around the place, how to repeat it), process_N.hdf (the fields) and process_N.png (the pressure
/// around the place). Where the fields cannot be written or drawn, the text says why. Not collective.
/// @param fields makes the fields of all processes or of this one; it may fail. @returns the folder. @throws
/// EnvironmentError.
template <int Dim>
std::filesystem::path write_crash(const std::filesystem::path& run, const config::Case& case_,
                                  const State<Dim>& state, const Failure& failure,
                                  const std::function<UnstructuredGrid()>& fields, int rank);

}  // namespace recoil::app
