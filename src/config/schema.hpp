#pragma once

#include <string>
#include <vector>

#include "config/keys.hpp"

namespace recoil::config {

/// JSON schema (draft 7) of a case file, for completion and checks in editors.
/// @param more sections that others read, such as material_sections(); none of their keys is demanded, since
/// a table may build on another one.
std::string json_schema(const std::vector<Section>& more = {});

/// What `recoil explain KEY` prints. The key is a path ("mesh.finest", "body.flyer.velocity"), a section
/// ("mesh") or the name of a key alone ("finest": wherever it exists).
/// @throws InputError where there is none of that name, with the nearest ones.
std::string explain(const std::string& key, const std::vector<Section>& more = {});

/// The reference page of the case file, Markdown.
std::string reference_page(const std::vector<Section>& more = {});

}  // namespace recoil::config
