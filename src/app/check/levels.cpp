#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>

#include "app/check/checks.hpp"
#include "config/geometry.hpp"

namespace recoil::app {

namespace {

/// Whether a region and the domain have some volume in common.
bool meets_domain(const config::Region& region, const config::Domain& domain) {
  for (std::size_t d = 0; d < static_cast<std::size_t>(config::dimension(domain.geometry)); ++d)
    if (!(std::min(region.hi[d], domain.hi[d]) > std::max(region.lo[d], domain.lo[d]))) return false;
  return true;
}

/// Keys that mean nothing with cells of one size.
void check_idle_keys(LoadedCase& loaded) {
  const auto idle = [&](const std::string& path) {
    const config::Node* node = loaded.document.find(path);
    if (node != nullptr)
      loaded.found.warning(node->key_place,
                           fmt::format("'{}' has no effect: the mesh has cells of one size", path),
                           "[mesh] levels = 3 gives cells of three sizes, or leave it out");
  };
  idle("mesh.bend");
  idle("mesh.every");
  for (const config::Region& region : loaded.contents.regions) idle("refine." + region.name);
}

}  // namespace

void check_levels(LoadedCase& loaded) {
  const config::Case& c = loaded.contents;
  if (c.mesh.levels == 1) check_idle_keys(loaded);
  for (const config::Region& region : c.regions) {
    if (meets_domain(region, c.domain)) continue;
    const std::string path = "refine." + region.name;
    const config::Node* node = loaded.document.find(path);
    loaded.found.error(node != nullptr ? node->key_place : config::Place{c.file},
                       fmt::format("nothing of [{}] lies in the domain", path),
                       "move it into the domain, or take it out");
  }
}

}  // namespace recoil::app
