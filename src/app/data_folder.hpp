#pragma once

#include <filesystem>

namespace recoil::app {

/// The folder that holds materials/, cases/ and templates/: the environment's RECOIL_DATA, else that of the
/// installed program, else the source tree.
std::filesystem::path data_folder();

inline std::filesystem::path templates_folder() { return data_folder() / "templates"; }
inline std::filesystem::path materials_folder() { return data_folder() / "materials"; }

}  // namespace recoil::app
