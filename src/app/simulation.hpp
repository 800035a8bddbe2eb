#pragma once

#include <filesystem>

#include "app/load_case.hpp"
#include "app/reporter.hpp"
#include "parallel/world.hpp"

namespace recoil::app {

struct SimulationOptions {
  std::filesystem::path folder;  // of the results; exists
  int threads = 1;
  Display display = Display::plain;
  bool speaks = true;
  bool verbose = false;  // where the time went, too
};

/// Computes a case from start to end. Collective.
/// @returns the exit code: 0, or 5 where an expectation failed.
/// @throws PhysicsError with a crash folder written, EnvironmentError, InputError.
template <int Dim>
int simulate(const LoadedCase& loaded, const SimulationOptions& options, const parallel::World& world);

}  // namespace recoil::app
