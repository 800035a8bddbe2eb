#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace recoil::app {

inline const std::vector<std::string> completed_shells{"bash", "zsh", "fish"};

/// A script by which a shell completes the commands, options and arguments that `top` declares: commands and
/// options by name, templates and materials as they are now, files where a file is wanted.
/// @param shell one of completed_shells.
std::string completion_script(const CLI::App& top, const std::string& shell);

}  // namespace recoil::app
