#pragma once

#include <string>

#include "config/document.hpp"
#include "material/library.hpp"

namespace recoil {

/// What may be meant by the name of a material that neither the library nor the case has.
/// @param own the case; null: there is none.
std::string help_for_unknown_material(const std::string& name, const config::Document* own,
                                      const MaterialFolders& folders);

}  // namespace recoil
