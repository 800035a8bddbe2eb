#include <fmt/format.h>

#include <filesystem>
#include <string>

#include "app/bibliography.hpp"
#include "app/commands.hpp"
#include "app/load_case.hpp"
#include "core/build_info.hpp"

namespace recoil::app {

int cite(const std::string& word) {
  const bool is_run = std::filesystem::exists(std::filesystem::path(word) / "case.resolved.toml");
  LoadedCase loaded = is_run ? load_run(word) : load_case(word, {});
  loaded.found.throw_if_errors();
  fmt::print(
      "@misc{{recoil,\n  author  = {{{{The Recoil developers}}}},\n  title   = {{Recoil: a hydrocode for the "
      "impact "
      "of solids with sharp interfaces}},\n  version = {{{}}},\n  note    = {{{}}}\n}}\n",
      build_info::version, build_info::full_version);
  for (const Source& s : sources_of(loaded)) {
    if (s.bibtex.empty())
      fmt::print("\n% '{}' is cited, but in no references.bib beside the case or in materials/\n", s.key);
    else
      fmt::print("\n{}\n", s.bibtex);
  }
  return 0;
}

}  // namespace recoil::app
