#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// Processes: who we are, and how to start others.
namespace recoil::app {

/// The file of the running program. @throws EnvironmentError where the system does not tell.
std::filesystem::path program_file();

/// Whether this process prints: all but the first one under mpirun are silent. Known before MPI starts.
bool speaks();

/// Whether an MPI launcher started this process.
bool launched();

/// What Open MPI needs in containers: leave to run as root, with more processes than processors, waiting
/// without heat where they share processors. Variables that the user has set stay.
void prepare_mpi_environment();

/// The same for a process on its own. It makes no folder for messages to others, as Open MPI does for each by
/// default: two that start at the same moment, as in a sweep, may make the same one, and one of them ends
/// ("mkdir: File exists").
void prepare_mpi_alone();

/// Runs `mpirun -n RANKS program ARGUMENTS...` and waits. A request to stop (`watch_stop_signals`) goes to
/// the processes as SIGUSR1, which mpirun passes on; after SIGINT or SIGTERM of its own it would kill them.
/// @returns the exit code of the processes. @throws EnvironmentError where mpirun cannot be started or is
/// killed.
int run_mpirun(int ranks, const std::vector<std::string>& arguments);

/// Runs the program once more with these arguments and waits. Its output goes to the file `log`. A request to
/// stop, and our own end, reach it as SIGUSR1: it stops with a checkpoint.
/// @returns its exit code. @throws EnvironmentError where it cannot be started.
int run_child(const std::vector<std::string>& arguments, const std::filesystem::path& log);

/// Runs any program, found on PATH: its name and its arguments. It is not asked to stop; otherwise the same.
int run_program(const std::vector<std::string>& words, const std::filesystem::path& log);

/// The file of a program on PATH; empty: there is none.
std::string on_path(const std::string& name);

}  // namespace recoil::app
