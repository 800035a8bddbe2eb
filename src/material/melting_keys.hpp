#pragma once

#include "config/table.hpp"
#include "material/material.hpp"

namespace recoil {

/// Reads [melting] of a material whose other parts are read; what the strength model knows of melting holds
/// there as well. Mistakes go to `out`.
Melting read_melting(const config::Node& table, const Material& material, config::Diagnostics& out);

/// Where `over` changes the strength, [melting] of the base loses what the new model has itself; without the
/// melting temperature of the old one, and none of its own, it goes.
void keep_melting(config::Node& base, const config::Node& over);

}  // namespace recoil
