#pragma once

namespace recoil::app {

/// Memory that this process may use [bytes]: the least of what the machine has and of the limits of its
/// control groups (versions 1 and 2) and of the process. Infinite where neither can be read.
double machine_memory();

/// Processors that threads can run on at the same time, at least 1.
int machine_processors();

}  // namespace recoil::app
