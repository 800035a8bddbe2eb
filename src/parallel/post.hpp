#pragma once

#include <optional>

#include "parallel/world.hpp"

/// Messages that travel while this process works. MPI is called by one thread only (MPI_THREAD_FUNNELED), so
/// that one thread alone may call these functions, too.
namespace recoil::parallel {

/// Sends a message. Of several to one process each arrives after the one before it.
void post(int rank, Bytes&& bytes);
/// The next message that a process has posted, once all of it is here; else nothing. Does not wait.
std::optional<Bytes> take_posted(int rank);
/// The same, and waits for it.
Bytes wait_for_posted(int rank);
/// Waits until all messages that this process has posted are taken.
void wait_until_taken();

}  // namespace recoil::parallel
