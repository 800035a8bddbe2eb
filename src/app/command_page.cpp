#include "app/command_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace recoil::app {

namespace {

/// The name of what an option takes, without the description of its check: "INT" of "INT:INT in [300 -
/// 10000]".
std::string type_of(const CLI::Option& o) {
  const std::string type = o.get_type_name();
  std::size_t end = type.size();
  for (const char* check : {":{", ":INT", ":UINT", ":FLOAT"}) end = std::min(end, type.find(check));
  return type.substr(0, end);
}

/// "`-o`, `--output` DIR", or "DIR" of an argument by its place.
std::string name_of(const CLI::Option& o) {
  std::string names;
  const auto add = [&](const std::string& name) { names += (names.empty() ? "`" : ", `") + name + "`"; };
  for (const std::string& n : o.get_snames()) add("-" + n);
  for (const std::string& n : o.get_lnames()) add("--" + n);
  const std::string type = type_of(o);
  if (o.get_items_expected_max() == 0) return names;
  return names.empty() ? fmt::format("`{}`", type) : fmt::format("{} `{}`", names, type);
}

/// Without what would end a cell of the table.
std::string in_cell(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
  return out;
}

/// "recoil sweep CASE --set KEY=VALUES": what must be given.
std::string usage(const CLI::App& command, const std::string& path) {
  std::string text = path;
  for (const CLI::Option* o : command.get_options()) {
    if (o->get_lnames().empty() && o->get_snames().empty())
      text += o->get_required() ? " " + type_of(*o) : " [" + type_of(*o) + "]";
    else if (o->get_required())
      text += fmt::format(" --{} {}", o->get_lnames().front(), type_of(*o));
  }
  return text;
}

void add_command(const CLI::App& command, const std::string& path, std::string& text) {
  const auto below = command.get_subcommands([](const CLI::App*) { return true; });
  if (below.empty()) {
    text += fmt::format("\n## {}\n\n`{}`: {}.\n\n| | |\n|---|---|\n", path, usage(command, path),
                        command.get_description());
    for (const CLI::Option* o : command.get_options())
      if (o->get_name() != "--help" && !o->get_description().empty())
        text += fmt::format("| {} | {} |\n", in_cell(name_of(*o)), in_cell(o->get_description()));
  }
  for (const CLI::App* s : below) add_command(*s, path + " " + s->get_name(), text);
}

}  // namespace

std::string command_page(const CLI::App& top) {
  std::string text =
      "# Commands\n\nWritten by `recoil commands`; `recoil COMMAND --help` prints the same. Errors and exit "
      "codes: "
      "[conventions](../conventions.md#errors-and-exit-codes).\n";
  add_command(top, "recoil", text);
  return text;
}

}  // namespace recoil::app
