#include "config/kept_files.hpp"

#include <fmt/format.h>

#include <system_error>

namespace recoil::config {

std::string keep_file(std::vector<std::filesystem::path>& files, const std::filesystem::path& file) {
  std::error_code error;
  for (const std::filesystem::path& other : files) {
    if (other.filename() != file.filename()) continue;
    if (std::filesystem::equivalent(other, file, error)) return {};
    return fmt::format("two files of this case are called {}", file.filename().string());
  }
  files.push_back(file);
  return {};
}

}  // namespace recoil::config
