#pragma once

#include <filesystem>
#include <string>

#include "format/run_units.hpp"
#include "format/vtkhdf.hpp"

namespace recoil::app {

/// A dump that holds the field of this name. @throws InputError where the run did not write it, which names
/// those that it wrote.
VtkhdfFile read_with_field(const std::filesystem::path& file, const std::string& field,
                           const RunUnits& units);

}  // namespace recoil::app
