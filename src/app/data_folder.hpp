#pragma once

#include <filesystem>

#include "material/library.hpp"

namespace recoil::app {

/// The folder that holds materials/, cases/ and templates/: the environment's RECOIL_DATA, else that of the
/// installed program, else the source tree.
std::filesystem::path data_folder();

inline std::filesystem::path templates_folder() { return data_folder() / "templates"; }
inline std::filesystem::path materials_folder() { return data_folder() / "materials"; }

/// Where materials are looked for, in this order: the folder `materials` beside a case (none if `case_folder`
/// is empty), the folders of the environment's RECOIL_MATERIALS (with : between them), the library.
MaterialFolders material_folders(const std::filesystem::path& case_folder = {});

}  // namespace recoil::app
