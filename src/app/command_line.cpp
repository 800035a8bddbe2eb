#include "app/command_line.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "app/declared_commands.hpp"
#include "app/launch.hpp"
#include "core/closest.hpp"
#include "core/error.hpp"
#include "core/printable.hpp"

namespace recoil::app {

namespace {

std::vector<std::string> names_of_commands(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* c : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(c->get_name());
  return names;
}

std::vector<std::string> names_of_options(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* o : app.get_options()) {
    for (const std::string& n : o->get_snames()) names.push_back("-" + n);
    for (const std::string& n : o->get_lnames()) names.push_back("--" + n);
  }
  return names;
}

/// The first word that stands where a command should, but is none; else empty.
std::string unknown_command(const CLI::App& top, int argc, const char* const* argv) {
  const CLI::App* at = &top;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const std::vector<std::string> known = names_of_commands(*at);
    if (known.empty()) return {};
    if (word.starts_with("-")) continue;
    if (std::find(known.begin(), known.end(), word) == known.end()) return word;
    at = at->get_subcommand(word);
  }
  return {};
}

/// What the word that the command line failed at may have been meant as; empty: nothing comes near.
std::string cure(const CLI::App& top, int argc, const char* const* argv) {
  const CLI::App* at = &top;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word.starts_with("-")) {
      const std::string name = word.substr(0, word.find('='));
      const std::vector<std::string> known = names_of_options(*at);
      if (name.size() > 2 && std::find(known.begin(), known.end(), name) == known.end())
        if (const std::string near = did_you_mean(name, known); !near.empty()) return near;
      continue;
    }
    const std::vector<std::string> known = names_of_commands(*at);
    if (known.empty()) continue;
    if (std::find(known.begin(), known.end(), word) != known.end()) {
      at = at->get_subcommand(word);
      continue;
    }
    const std::string near = did_you_mean(word, known);
    return !near.empty() ? near : fmt::format("the commands are: {}", fmt::join(known, ", "));
  }
  return {};
}

/// The command that the words name, as far as they do: "recoil material show".
std::pair<const CLI::App*, std::string> named_command(const CLI::App& top, int argc,
                                                      const char* const* argv) {
  std::pair<const CLI::App*, std::string> found{&top, "recoil"};
  for (int i = 1; i < argc; ++i) {
    const std::vector<std::string> known = names_of_commands(*found.first);
    if (std::find(known.begin(), known.end(), argv[i]) == known.end()) continue;
    found.first = found.first->get_subcommand(argv[i]);
    found.second += std::string(" ") + argv[i];
  }
  return found;
}

/// What is missing, by the name that the help gives it: "CASE is missing (case file, or its folder)".
std::string missing(const CLI::App& command, const std::string& what) {
  if (!names_of_commands(command).empty()) return "a command is missing";
  for (const CLI::Option* o : command.get_options())
    if (what == o->get_name() + " is required")
      return fmt::format("{} is missing ({})", o->get_positional() ? o->get_type_name() : o->get_name(),
                         o->get_description());
  return what;
}

int report_usage(const Commands& commands, const CLI::ParseError& e, int argc, const char* const* argv) {
  std::string what = e.what();
  const std::string word = unknown_command(commands.top, argc, argv);
  if (!word.empty()) what = fmt::format("there is no command '{}'", word);
  std::replace(what.begin(), what.end(), '\n', ' ');
  const auto [command, words] = named_command(commands.top, argc, argv);
  std::string help = cure(commands.top, argc, argv);
  if (word.empty() && e.get_name() == "RequiredError") {
    what = missing(*command, what);
    if (const auto known = names_of_commands(*command); help.empty() && !known.empty())
      help = fmt::format("the commands are: {}; `recoil --help` says what they do", fmt::join(known, ", "));
  }
  if (help.empty()) help = fmt::format("`{} --help` tells more", words);
  fmt::print(stderr, "error: {}\n   = help: {}\n", what, help);
  return exit_bad_input;
}

int fail(ExitCode code, const std::string& text) {
  if (speaks()) {
    std::fflush(stdout);
    const bool has_head =
        text.starts_with("error") || text.starts_with("warning");  // what is wrong comes later
    const std::string all =
        fmt::format("{}{}{}", has_head ? "" : "error: ", printable(text), text.ends_with('\n') ? "" : "\n");
    std::fputs(all.c_str(), stderr);  // which throws nothing where that cannot be written either
  }
  return code;
}

}  // namespace

int report_errors(const std::function<int()>& body) {
  try {
    return body();
  } catch (const InputError& e) {
    return fail(exit_bad_input, e.what());
  } catch (const PhysicsError& e) {
    return fail(exit_numerical_failure, e.what());
  } catch (const EnvironmentError& e) {
    return fail(exit_environment, e.what());
  } catch (const std::bad_alloc&) {
    return fail(exit_environment,
                "out of memory\n   = help: larger cells (mesh.finest) need less; "
                "`recoil check` estimates how much");
  } catch (const std::system_error& e) {  // from printing or starting threads
    return fail(exit_environment, e.what());
  } catch (const std::exception& e) {
    return fail(exit_our_bug, std::string(e.what()) +
                                  "\n   = help: this is a bug in recoil, not in your input; please "
                                  "report it together with the case file");
  }
}

int command_line(int argc, const char* const* argv) {
  return report_errors([&]() -> int {
    Commands commands;
    try {
      commands.top.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
      if (e.get_exit_code() == 0) return commands.top.exit(e);  // help, version
      return report_usage(commands, e, argc, argv);
    }
    const int code = commands.chosen();
    if (std::fflush(stdout) != 0)
      throw EnvironmentError(fmt::format("the output cannot be written: {}", std::strerror(errno)));
    return code;
  });
}

}  // namespace recoil::app
