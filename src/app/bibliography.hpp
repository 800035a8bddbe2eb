#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "app/load_case.hpp"

namespace recoil::app {

/// An entry of a bibliography.
struct Source {
  std::string key;
  std::string text;    ///< in one line, for people
  std::string bibtex;  ///< as it stands in the file; empty: there is no such entry
};

/// The entries of a BibTeX file by their keys; none where there is no file.
std::map<std::string, Source> read_bibliography(const std::filesystem::path& file);

/// What a case and its materials cite, each once, sorted by key: from references.bib beside the case and from
/// that of the library.
std::vector<Source> sources_of(const LoadedCase& loaded);

}  // namespace recoil::app
