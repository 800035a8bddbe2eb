#pragma once

#include <string>

#include "material/material.hpp"

namespace recoil::app {

/// A material of the user's folders or the library by its name. @throws InputError with the nearest names.
Material named_material(const std::string& name);

}  // namespace recoil::app
