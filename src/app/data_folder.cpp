#include "app/data_folder.hpp"

#include <cstdlib>
#include <sstream>
#include <string>
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

MaterialFolders material_folders(const std::filesystem::path& case_folder) {
  MaterialFolders folders;
  if (!case_folder.empty()) folders.push_back(case_folder / "materials");
  if (const char* own = std::getenv("RECOIL_MATERIALS")) {
    std::istringstream list(own);
    for (std::string folder; std::getline(list, folder, ':');)
      if (!folder.empty()) folders.emplace_back(folder);
  }
  folders.push_back(materials_folder());
  return folders;
}

}  // namespace recoil::app
