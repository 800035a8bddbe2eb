#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace recoil::app {

/// docs/reference/commands.md: every command with its arguments and options, as `top` declares them.
std::string command_page(const CLI::App& top);

}  // namespace recoil::app
