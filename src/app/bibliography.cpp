#include "app/bibliography.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <set>

#include "app/data_folder.hpp"

namespace recoil::app {

namespace fs = std::filesystem;

namespace {

/// The place behind the brace that closes the one at `open`, or the end of the text.
std::size_t behind_brace(const std::string& text, std::size_t open) {
  int depth = 0;
  for (std::size_t k = open; k < text.size(); ++k) {
    if (text[k] == '{') ++depth;
    if (text[k] == '}' && --depth == 0) return k + 1;
  }
  return text.size();
}

/// Without braces and with one space between words.
std::string plain(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '{' || c == '}') continue;
    const bool space = std::isspace(static_cast<unsigned char>(c)) != 0;
    if (!space) out += c;
    if (space && !out.empty() && out.back() != ' ') out += ' ';
  }
  return out;
}

/// The fields of an entry: names in small letters, values without their outer braces.
std::map<std::string, std::string> fields_of(const std::string& entry) {
  std::map<std::string, std::string> fields;
  std::size_t at = entry.find(',');
  while (at != std::string::npos) {
    const std::size_t equals = entry.find('=', at), open = entry.find('{', at);
    if (equals == std::string::npos || open == std::string::npos) break;
    std::string name = plain(entry.substr(at + 1, equals - at - 1));
    std::erase(name, ' ');
    const std::size_t end = behind_brace(entry, open);
    fields[name] = plain(entry.substr(open + 1, end - open - 2));
    at = entry.find(',', end);
  }
  return fields;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

/// "Johnson, G. R.; Cook, W. H.: Title. Where, 1983"
std::string reference_text(std::map<std::string, std::string> f) {
  std::string text = replaced(f["author"], " and ", "; ");
  if (!text.empty()) text += ": ";
  text += f["title"];
  for (const char* part : {"journal", "booktitle", "institution", "publisher"})
    if (!f[part].empty()) text += ". " + f[part];
  if (!f["volume"].empty()) text += " " + f["volume"];
  if (!f["number"].empty()) text += ", " + f["number"];
  if (!f["pages"].empty()) text += ", " + replaced(f["pages"], "--", "\u2013");
  if (!f["year"].empty()) text += ", " + f["year"];
  if (!f["note"].empty()) text += ". " + f["note"];
  return text;
}

}  // namespace

std::map<std::string, Source> read_bibliography(const fs::path& file) {
  std::ifstream in(file);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  std::map<std::string, Source> all;
  for (std::size_t at = text.find('@'); at != std::string::npos;) {
    const std::size_t open = text.find('{', at), comma = text.find(',', at);
    if (open == std::string::npos || comma == std::string::npos) break;
    const std::size_t end = behind_brace(text, open);
    const std::string entry = text.substr(at, end - at), key = plain(text.substr(open + 1, comma - open - 1));
    all[key] = {key, reference_text(fields_of(entry)), entry};
    at = text.find('@', end);
  }
  return all;
}

std::vector<Source> sources_of(const LoadedCase& loaded) {
  std::set<std::string> keys(loaded.contents.cite.begin(), loaded.contents.cite.end());
  for (const Material& m : loaded.materials) keys.insert(m.cite.begin(), m.cite.end());
  std::map<std::string, Source> known = read_bibliography(loaded.folder / "references.bib");
  known.merge(read_bibliography(materials_folder() / "references.bib"));
  std::vector<Source> all;
  for (const std::string& key : keys) {
    const auto found = known.find(key);
    all.push_back(found == known.end() ? Source{key, key, ""} : found->second);
  }
  return all;
}

}  // namespace recoil::app
