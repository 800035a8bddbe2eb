#pragma once

#include <cstdlib>
#include <string_view>

#include "parallel/world.hpp"

namespace recoil {

/// Starts MPI once for the whole test program: the mesh needs it even on one process.
inline void start_parallel() { static const parallel::Session session; }

/// Whether mpirun has started this program with more than one process.
inline bool several_processes() {
  const char* size = std::getenv("OMPI_COMM_WORLD_SIZE");
  return size != nullptr && std::string_view(size) != "1";
}

}  // namespace recoil
