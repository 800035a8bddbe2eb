#include "app/launch.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>
#include <utility>

#include "core/error.hpp"

namespace recoil::app {

namespace {

/// Pointers for execvp; valid as long as the words.
std::vector<char*> pointers_to(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (std::string& w : words) pointers.push_back(w.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// The rank that Open MPI, MPICH or Slurm gave us; null: not launched.
const char* rank_from_launcher() {
  for (const char* name : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"})
    if (const char* rank = std::getenv(name)) return rank;
  return nullptr;
}

/// A process that waits for a message gives its processor away where there are more processes than processors
/// only: where other programs run it gets it back milliseconds later, at each of some 40 waits of a step.
/// @param ranks on this machine; null: unknown.
void choose_idle(const char* ranks) {
  const long processors = sysconf(_SC_NPROCESSORS_ONLN);
  const bool enough = ranks != nullptr && std::strtol(ranks, nullptr, 10) <= processors;
  setenv("OMPI_MCA_mpi_yield_when_idle", enough ? "0" : "1", 0);
}

}  // namespace

std::filesystem::path program_file() {
  std::error_code error;
  const auto file = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) throw EnvironmentError("cannot find the program's own file: " + error.message());
  return file;
}

bool launched() { return rank_from_launcher() != nullptr; }

bool speaks() {
  const char* rank = rank_from_launcher();
  return !rank || std::string(rank) == "0";
}

void prepare_mpi_environment() {
  for (const char* name :
       {"OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "OMPI_MCA_rmaps_base_oversubscribe",
        "OMPI_MCA_ess_singleton_isolated"})  // the last: one process starts no daemon
    setenv(name, "1", 0);
  choose_idle(std::getenv("OMPI_COMM_WORLD_LOCAL_SIZE"));
}

void become_mpirun(int ranks, const std::vector<std::string>& arguments) {
  choose_idle(std::to_string(ranks).c_str());
  prepare_mpi_environment();
  // -q: an exit code of ours is no failure of MPI that needs a page of explanation.
  std::vector<std::string> words{"mpirun", "-q", "-n", std::to_string(ranks), program_file().string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  execvp("mpirun", pointers_to(words).data());
  throw EnvironmentError(
      fmt::format("cannot start mpirun: {}\n   = help: install Open MPI, or omit -n", std::strerror(errno)));
}

int run_program(std::vector<std::string> words, const std::filesystem::path& log) {
  const std::vector<char*> pointers = pointers_to(words);
  const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file < 0)
    throw EnvironmentError(fmt::format("cannot write {}: {}", log.string(), std::strerror(errno)));
  const pid_t child = fork();
  if (child == 0) {
    dup2(file, STDOUT_FILENO);
    dup2(file, STDERR_FILENO);
    execvp(pointers[0], pointers.data());
    _exit(127);
  }
  close(file);
  int status = 0;
  while (child > 0 && waitpid(child, &status, 0) < 0)
    if (errno != EINTR) break;
  if (child < 0 || !WIFEXITED(status) || WEXITSTATUS(status) == 127)
    throw EnvironmentError(fmt::format("{} failed; see {}", words[0], log.string()));
  return WEXITSTATUS(status);
}

int run_child(const std::vector<std::string>& arguments, const std::filesystem::path& log) {
  std::vector<std::string> words{program_file().string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return run_program(std::move(words), log);
}

std::string on_path(const std::string& name) {
  const char* path = std::getenv("PATH");
  const std::string all = path ? path : "";
  for (std::size_t at = 0; at <= all.size();) {
    const std::size_t end = std::min(all.find(':', at), all.size());
    const std::filesystem::path file = std::filesystem::path(all.substr(at, end - at)) / name;
    if (access(file.c_str(), X_OK) == 0) return file.string();
    at = end + 1;
  }
  return "";
}

}  // namespace recoil::app
