#pragma once

#include <cstdlib>

#include "parallel/world.hpp"

namespace recoil {

/// Starts MPI once for the whole test program: the mesh needs it even on one process.
inline void start_parallel() { static const parallel::Session session; }

/// Whether mpirun has started this program.
inline bool several_processes() { return std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr; }

}  // namespace recoil
