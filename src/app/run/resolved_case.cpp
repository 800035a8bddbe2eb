#include "app/run/resolved_case.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstddef>
#include <set>

#include "config/declare/write.hpp"
#include "core/build_info.hpp"
#include "core/printable.hpp"
#include "material/library.hpp"

namespace recoil::app {

namespace {

/// A name of a file in a comment, which ends with its line.
std::string in_comment(const std::string& name) {
  return fmt::format("{}", fmt::join(printable_characters(name), ""));
}

/// Where a value comes from.
std::string source(const config::Document& document, const std::string& path) {
  const config::Node* node = document.find(path);
  if (!node) return "default";
  return node->place.file == document.name ? fmt::format("line {}", node->place.line)
                                           : in_comment(node->place.file);
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
  for (const config::WrittenTable& table : config::written_tables(c)) out += text_of(table, loaded.document);
  std::set<std::string> seen;
  for (std::size_t m = 0; m < loaded.materials.size(); ++m)
    if (!c.bodies[m].rigid && seen.insert(c.bodies[m].material).second)
      out += "\n" + to_toml(loaded.materials[m], "material." + config::written_text(c.bodies[m].material));
  return out;
}

}  // namespace recoil::app
