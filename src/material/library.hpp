#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "config/diagnostics.hpp"
#include "config/document.hpp"
#include "config/keys.hpp"
#include "material/material.hpp"

namespace recoil {

/// Folders with materials; where two have the same name, the first one counts.
using MaterialFolders = std::vector<std::filesystem::path>;

/// The names in these folders, sorted: `copper/seed` for the file copper/seed.toml. A folder that does not
/// exist has none.
std::vector<std::string> list_materials(const MaterialFolders& folders);

/// The file of a name; empty: there is none.
std::filesystem::path material_file(const std::string& name, const MaterialFolders& folders);

/// The material that a body asks for: a [material.NAME] of the case, else a file of these folders.
/// A table of the case may name a `base` (either kind) and change single values of it; where it changes the
/// `kind` of the equation of state or strength, those values of the base stay that the new kind has too.
/// Mistakes go to `out`; an unknown name is reported at `place` with the nearest ones.
/// @param own the case's document; null: the folders only
/// @return nothing where there was an error.
std::optional<Material> find_material(const std::string& name, const config::Document* own,
                                      const MaterialFolders& folders, config::Diagnostics& out,
                                      const config::Place& place);

/// A material from a table of the form of the library's files.
std::optional<Material> read_material(const std::string& name, const config::Node& table,
                                      config::Diagnostics& out);

/// Every table and key of a material, as sections "material.*", "material.*.eos", ...: made from the models'
/// own lists, for help, schema and reference page.
std::vector<config::Section> material_sections();

/// The material in full, in SI, as text that read_material understands; tables are named
/// `table`, `table.eos`, ... (empty: as in a library file).
std::string to_toml(const Material& material, const std::string& table = {});

}  // namespace recoil
