#include "app/data_folder.hpp"

#include <cstdlib>
#include <system_error>

#include "app/launch.hpp"
#include "core/build_info.hpp"

namespace recoil::app {

std::filesystem::path data_folder() {
  if (const char* chosen = std::getenv("RECOIL_DATA"); chosen && *chosen) return chosen;
  const auto installed = (program_file().parent_path() / build_info::relative_data_dir).lexically_normal();
  std::error_code error;
  if (std::filesystem::is_directory(installed / "materials", error)) return installed;
  return build_info::source_data_dir;
}

}  // namespace recoil::app
