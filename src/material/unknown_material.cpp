#include "material/unknown_material.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstddef>
#include <utility>
#include <vector>

#include "core/closest.hpp"

namespace recoil {

namespace {

/// Names that resemble this one, or one of its two parts.
std::string similar(const std::string& name, const std::vector<std::string>& known) {
  std::string help = did_you_mean(name, known, 3);
  const std::size_t slash = name.find('/');
  if (!help.empty() || slash == std::string::npos) return help;
  const std::string second = name.substr(slash + 1);  // "pure" says nothing
  if (nearest(second, known, 4).size() < 4) help = did_you_mean(second, known, 3);
  return help.empty() ? did_you_mean(name.substr(0, slash + 1), known, 3) : help;
}

std::string where_there_are_none(const MaterialFolders& folders) {
  std::string help = "there are no materials in";
  for (std::size_t i = 0; i < folders.size(); ++i) help += (i > 0 ? ", '" : " '") + folders[i].string() + "'";
  return help;
}

}  // namespace

std::string help_for_unknown_material(const std::string& name, const config::Document* own,
                                      const MaterialFolders& folders) {
  const std::vector<std::string> owned = own ? own->names("material") : std::vector<std::string>{};
  std::vector<std::string> known = owned;
  for (std::string& n : list_materials(folders)) known.push_back(std::move(n));
  std::string help = similar(name, known);
  if (help.empty()) help = known.empty() ? where_there_are_none(folders) : "`recoil material list` lists all";
  if (owned.empty()) return help;
  return fmt::format("{}{} the case itself has '{}'", help, help.ends_with('?') ? "" : ";",
                     fmt::join(owned, "', '"));
}

}  // namespace recoil
