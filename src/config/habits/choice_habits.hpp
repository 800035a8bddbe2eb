#pragma once

#include <span>
#include <string>
#include <string_view>

namespace recoil::config {

/// What to write in place of a word that is no choice but that other programs have: "2d" of a geometry,
/// "fixed" of a boundary. Empty: no such word is known.
std::string_view help_for_choice(std::string_view written, std::span<const std::string> choices);

}  // namespace recoil::config
