#include "app/machine.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <thread>

namespace recoil::app {

namespace {

namespace fs = std::filesystem;

constexpr double unknown = std::numeric_limits<double>::infinity();

/// The number in a file; infinite where it holds none ("max") or does not exist.
double number_in(const fs::path& file) {
  std::ifstream in(file);
  double value = 0;
  if (in >> value) return value;
  return unknown;
}

double installed_memory() {
  std::ifstream in("/proc/meminfo");
  double kilobytes = 0;
  for (std::string word; in >> word;)
    if (word == "MemTotal:" && in >> kilobytes) return kilobytes * 1024;
  return unknown;
}

/// Every group on the way up from ours may have a limit.
double least_on_the_way(fs::path group, const fs::path& top, const char* file) {
  double least = number_in(top / file);
  for (; group.has_relative_path(); group = group.parent_path())
    least = std::min(least, number_in(top / group.relative_path() / file));
  return least;
}

double group_limit() {
  const fs::path top = "/sys/fs/cgroup";
  double least = std::min(number_in(top / "memory.max"), number_in(top / "memory/memory.limit_in_bytes"));
  std::ifstream in("/proc/self/cgroup");
  for (std::string line; std::getline(in, line);) {
    const std::size_t last = line.rfind(':');
    if (last == std::string::npos) continue;
    const fs::path group = line.substr(last + 1);
    if (line.starts_with("0::")) least = std::min(least, least_on_the_way(group, top, "memory.max"));
    if (line.find(":memory:") != std::string::npos)
      least = std::min(least, least_on_the_way(group, top / "memory", "memory.limit_in_bytes"));
  }
  return least;
}

/// What `ulimit -v` and `ulimit -d` leave to this process.
double process_limit() {
  double least = unknown;
  for (const auto kind : {RLIMIT_AS, RLIMIT_DATA})
    if (rlimit limit{}; getrlimit(kind, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
      least = std::min(least, static_cast<double>(limit.rlim_cur));
  return least;
}

}  // namespace

double machine_memory() { return std::min({installed_memory(), group_limit(), process_limit()}); }

int machine_processors() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

}  // namespace recoil::app
