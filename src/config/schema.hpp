#pragma once

#include <string>

namespace recoil::config {

/// JSON schema (draft 7) of a case file, for completion and checks in editors.
std::string json_schema();

/// What `recoil explain KEY` prints. The key is a path ("mesh.finest", "body.flyer.velocity"), a section
/// ("mesh") or the name of a key alone ("finest": wherever it exists).
/// @throws InputError where there is none of that name, with the nearest ones.
std::string explain(const std::string& key);

/// The reference page of the case file, Markdown.
std::string reference_page();

}  // namespace recoil::config
