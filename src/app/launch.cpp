#include "app/launch.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <system_error>
#include <thread>
#include <utility>

#include "app/run/stop_request.hpp"
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

/// In what a child differs from a copy of this process.
struct ChildSetup {
  int input = -1, output = -1;  // descriptors in place of ours; -1: ours
  /// The signal that it gets when we end. 0: none, and what the terminal sends to us it gets, too; otherwise
  /// Ctrl-C reaches us alone, and we ask the child to stop.
  int at_our_end = 0;
};

constexpr int cannot_start = 127;

/// Starts a program, found on PATH. @returns its number; below 0: none could be started.
pid_t start(std::vector<std::string> words, const ChildSetup& setup) {
  const std::vector<char*> pointers = pointers_to(words);
  const pid_t parent = getpid(), child = fork();
  if (child != 0) return child;
  if (setup.at_our_end != 0) {
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, setup.at_our_end);
    if (getppid() != parent) _exit(cannot_start);
  }
  if (setup.input >= 0) dup2(setup.input, STDIN_FILENO);
  if (setup.output >= 0) dup2(setup.output, STDOUT_FILENO), dup2(setup.output, STDERR_FILENO);
  execvp(pointers[0], pointers.data());
  _exit(cannot_start);
}

/// Whether a process catches SIGUSR1; one that does not yet would die of it.
bool is_ready(const std::string& process) {
  std::ifstream status("/proc/" + process + "/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("SigCgt:")) return (std::stoull(line.substr(7), nullptr, 16) >> (SIGUSR1 - 1)) & 1;
  return false;
}

/// Whether a process is ready, and so many others that it has started, as far as the system tells.
bool are_ready(pid_t process, int others) {
  const std::string number = std::to_string(process);
  if (!is_ready(number)) return false;
  std::ifstream children(fmt::format("/proc/{0}/task/{0}/children", number));
  if (!children) return true;
  int ready = 0;
  for (std::string child; children >> child;) ready += is_ready(child) ? 1 : 0;
  return ready >= others;
}

/// Waits for a child, and passes a request to stop on to it as soon as it is ready, at the latest after ten
/// seconds. @param others that it starts itself. @returns its status; below 0: unknown.
int wait_and_pass_on(pid_t child, int others) {
  constexpr std::chrono::milliseconds pause{5};
  constexpr int longest = 2000;  // pauses
  int requested = 0;
  for (bool passed = false;;) {
    int status = 0;
    const pid_t ended = waitpid(child, &status, WNOHANG);
    if (ended == child) return status;
    if (ended < 0 && errno != EINTR) return -1;
    if (!passed && stop_requested() && (are_ready(child, others) || ++requested > longest))
      passed = kill(child, SIGUSR1) == 0;
    std::this_thread::sleep_for(pause);
  }
}

/// Waits for a child as it is. @returns its status; below 0: unknown.
int wait_for(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return -1;
  return status;
}

/// Runs a program whose output goes to a file. @param asks_to_stop passes requests to stop on.
int run_into(const std::vector<std::string>& words, const std::filesystem::path& log, bool asks_to_stop) {
  const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file < 0)
    throw EnvironmentError(fmt::format("cannot write {}: {}", log.string(), std::strerror(errno)));
  const pid_t child = start(words, {.output = file, .at_our_end = asks_to_stop ? SIGUSR1 : 0});
  close(file);
  const int status = child < 0 ? -1 : asks_to_stop ? wait_and_pass_on(child, 0) : wait_for(child);
  if (status >= 0 && WIFSIGNALED(status))
    throw EnvironmentError(fmt::format("{} was ended by a signal ({}), see {}",
                                       std::filesystem::path(words[0]).filename().string(),
                                       strsignal(WTERMSIG(status)), log.string()));
  if (status < 0 || WEXITSTATUS(status) == cannot_start)
    throw EnvironmentError(fmt::format("{} failed; see {}", words[0], log.string()));
  return WEXITSTATUS(status);
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

void prepare_mpi_alone() {
  prepare_mpi_environment();
  setenv("OMPI_MCA_orte_create_session_dirs", "0", 0);
}

int run_mpirun(int ranks, const std::vector<std::string>& arguments) {
  choose_idle(std::to_string(ranks).c_str());
  prepare_mpi_environment();
  // -q: an exit code of ours is no failure of MPI that needs a page of explanation.
  std::vector<std::string> words{"mpirun", "-q", "-n", std::to_string(ranks), program_file().string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
  watch_stop_signals();
  const pid_t child = start(words, {.input = nothing, .at_our_end = SIGKILL});
  close(nothing);
  const int status = child < 0 ? -1 : wait_and_pass_on(child, ranks);
  if (status >= 0 && WIFSIGNALED(status))
    throw EnvironmentError(
        fmt::format("mpirun was ended by signal {}\n   = help: `recoil resume` goes on from the last "
                    "checkpoint, if there is one",
                    WTERMSIG(status)));
  if (status < 0 || WEXITSTATUS(status) == cannot_start)
    throw EnvironmentError("cannot start mpirun\n   = help: install Open MPI, or omit -n");
  return WEXITSTATUS(status);
}

int run_program(const std::vector<std::string>& words, const std::filesystem::path& log) {
  return run_into(words, log, false);
}

int run_child(const std::vector<std::string>& arguments, const std::filesystem::path& log) {
  std::vector<std::string> words{program_file().string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return run_into(words, log, true);
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
