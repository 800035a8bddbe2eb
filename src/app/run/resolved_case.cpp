#include "app/run/resolved_case.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstddef>
#include <map>
#include <set>
#include <sstream>
#include <string_view>

#include "config/declare/write.hpp"
#include "core/build_info.hpp"
#include "core/printable.hpp"
#include "material/library.hpp"

namespace recoil::app {

namespace {

/// A text in a comment, which ends with its line.
std::string in_comment(const std::string& name) {
  return fmt::format("{}", fmt::join(printable_characters(name), ""));
}

/// Where a value and all in it come from, but for the case file.
void gather_other_files(const config::Node& node, const std::string& case_file,
                        std::set<std::string>& files) {
  if (!node.place.file.empty() && node.place.file != case_file) files.insert(node.place.file);
  for (const config::Node& child : node.children) gather_other_files(child, case_file, files);
}

/// Where a value comes from: "line 21", "--set"; of a table that has been changed in part "line 21, --set".
std::string source(const config::Document& document, const std::string& path) {
  const config::Node* node = document.find(path);
  if (!node) return "default";
  std::set<std::string> others;
  gather_other_files(*node, document.name, others);
  std::vector<std::string> all;
  if (node->place.file == document.name) all.push_back(fmt::format("line {}", node->place.line));
  for (const std::string& file : others) all.push_back(in_comment(file));
  return fmt::format("{}", fmt::join(all, ", "));
}

constexpr std::string_view change_mark = "# Changed on the command line: ";

/// A line for each change of the command line; of those of one key the last.
std::string changes_text(const std::vector<std::string>& overrides) {
  std::map<std::string, std::size_t> last;
  const auto key = [&](std::size_t k) { return overrides[k].substr(0, overrides[k].find('=')); };
  for (std::size_t k = 0; k < overrides.size(); ++k) last[key(k)] = k;
  std::string text;
  for (std::size_t k = 0; k < overrides.size(); ++k)
    if (last[key(k)] == k) text += fmt::format("{}{}\n", change_mark, in_comment(overrides[k]));
  return text;
}

std::string text_of(const config::WrittenTable& table, const config::Document& document) {
  std::string out = table.path.empty() ? "" : fmt::format("\n[{}]\n", table.path);
  for (const config::WrittenKey& k : table.keys) {
    const std::string from =
        k.source.empty() ? source(document, config::join_path(table.path, k.name)) : k.source;
    out += fmt::format("{} = {}  # {}\n", k.name, k.value, from);
  }
  return out;
}

}  // namespace

std::string resolved_text(const LoadedCase& loaded) {
  const config::Case& c = loaded.contents;
  std::string out = fmt::format("# {} as recoil {} computed it: all values, in SI.\n", in_comment(c.file),
                                build_info::version);
  out += changes_text(loaded.overrides);
  for (const config::WrittenTable& table : config::written_tables(c)) out += text_of(table, loaded.document);
  std::set<std::string> seen;
  for (std::size_t m = 0; m < loaded.materials.size(); ++m)
    if (!c.bodies[m].rigid && seen.insert(c.bodies[m].material).second)
      out += "\n" + to_toml(loaded.materials[m], "material." + config::written_text(c.bodies[m].material));
  return out;
}

std::vector<std::string> changes_of(const std::string& resolved) {
  std::vector<std::string> changes;
  std::istringstream lines(resolved);
  for (std::string line; std::getline(lines, line) && line.starts_with('#');)
    if (line.starts_with(change_mark)) changes.push_back(line.substr(change_mark.size()));
  return changes;
}

}  // namespace recoil::app
