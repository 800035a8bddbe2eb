#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "config/case.hpp"
#include "config/diagnostics.hpp"
#include "config/document.hpp"
#include "material/material.hpp"

namespace recoil::app {

/// A case with all that it refers to.
struct LoadedCase {
  config::Document document;           // with the changes of the command line
  config::Case contents;               // with the expectations of expected.toml beside the file
  std::vector<Material> materials;     // one for each body; rigid bodies have an empty one
  config::Diagnostics found;           // mistakes and warnings
  bool too_large = false;              // needs more memory than the machine has: an error of the environment
  std::filesystem::path folder;        // of the file
  std::vector<std::string> overrides;  // changes of the command line, PATH=VALUE
};

/// The case file meant by a word of the command line: a file, a folder that holds case.toml, or the name of
/// one of the shipped cases. @throws InputError where there is none.
std::filesystem::path find_case_file(const std::string& word);

/// "flyer_al_cu" of cases/flyer_al_cu/case.toml, "mine" of mine.toml.
std::string short_name(const std::filesystem::path& case_file);

/// The title of a case, or without one the name of its file.
std::string title_of(const config::Case& c);

/// Reads the case, expected.toml, and the materials; all mistakes are in `found`. With errors the rest is
/// only good for finding more of them. @throws InputError where there is no such file.
/// @param home the file that the case counts as, where `word` is a copy of it: names, references and
/// materials are looked for beside it; empty: none.
LoadedCase load_case(const std::string& word, const std::vector<std::string>& overrides,
                     const std::filesystem::path& home = {});

/// The case that a run computed, with its materials, as case.resolved.toml in its folder has it. @throws
/// InputError for a folder that holds no run.
LoadedCase load_run(const std::filesystem::path& folder);

/// @throws InputError where a folder does not exist, with those beside it whose names are near.
void require_folder(const std::filesystem::path& folder);

/// Expectations that name what no run of the case can tell, compare it with a value of another dimension, or
/// with a curve that is not there: a part of check_logic().
void check_expectations(LoadedCase& loaded);

/// Checks that need more than single values, for cases without errors so far: more cells than the machine has
/// memory for, fields and intervals that do not exist, bodies that overlap, lie outside the domain, are cut
/// off or too thin, gauges off their body, doubtful materials, bodies that do not meet or meet too fast.
void check_logic(LoadedCase& loaded);

}  // namespace recoil::app
