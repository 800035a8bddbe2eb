#pragma once

#include <stdexcept>
#include <string>

namespace recoil {

/// A mistake in what the user gave us; the text is complete (file, line, cure). Exit code 2.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The computed state left the range in which the equations hold. Exit code 3.
struct PhysicsError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The machine refused: disk, memory, MPI. Exit code 4.
struct EnvironmentError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A mistake of ours. Exit code 1.
struct InternalError : std::logic_error {
  using std::logic_error::logic_error;
};

/// Checks an invariant of our own, in every build. @throws InternalError.
inline void require(bool holds, const char* what) {
  if (!holds) throw InternalError(std::string("internal error: ") + what);
}

}  // namespace recoil
