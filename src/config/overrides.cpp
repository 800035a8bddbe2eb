#include "config/overrides.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>

#include "core/closest.hpp"

namespace recoil::config {

namespace {

constexpr const char* source_name = "--set";

/// The places of the keys made on the way, so that an unknown one gets its caret where it stands.
void place_keys(Node& root, const std::vector<std::string>& path, const Document& before, Place place) {
  Node* node = &root;
  std::string dotted;
  for (const std::string& part : path) {
    node = node->find(part);
    dotted = join_path(dotted, part);
    place.length = static_cast<int>(part.size());
    if (!before.find(dotted)) node->key_place = place;
    place.column += place.length + 1;
  }
}

std::string without_blanks(const std::string& s) {
  const std::size_t first = s.find_first_not_of(" \t");
  return first == std::string::npos ? std::string() : s.substr(first, s.find_last_not_of(" \t") + 1 - first);
}

bool is_named_group(const std::string& key) { return key == "body" || key == "gauge" || key == "material"; }

}  // namespace

void apply_overrides(Document& document, const std::vector<std::string>& overrides, Diagnostics& out) {
  std::string text;
  for (const std::string& one : overrides) {
    std::string line = one;
    std::replace(line.begin(), line.end(), '\n', ' ');
    text += line + '\n';
  }
  if (!overrides.empty()) out.source(source_name, text);
  int line = 0;
  for (const std::string& one : overrides) {
    ++line;
    const std::size_t equals = one.find('=');
    if (equals == std::string::npos || equals == 0) {
      out.error({source_name, line, 1, static_cast<int>(one.size())}, fmt::format("'{}' sets nothing", one),
                "write PATH=VALUE, e.g. mesh.finest=0.1mm");
      continue;
    }
    const std::string dotted = one.substr(0, one.find_last_not_of(" \t", equals - 1) + 1);
    const std::vector<std::string> path = split_path(dotted);
    const Place at_value{source_name, line, static_cast<int>(equals) + 2,
                         std::max(1, static_cast<int>(one.size() - equals) - 1)};
    const Node value = parse_value(without_blanks(one.substr(equals + 1)), at_value);
    const bool adds_one = path.size() == 2 && value.is_table();  // gauge.face={kind="point", ...}
    if (path.size() >= 2 && is_named_group(path[0]) && !adds_one) {
      const std::vector<std::string> names = document.names(path[0]);
      if (std::find(names.begin(), names.end(), path[1]) == names.end()) {
        const std::string near = did_you_mean(path[1], names);
        out.error({source_name, line, static_cast<int>(path[0].size()) + 2, static_cast<int>(path[1].size())},
                  fmt::format("the case has no {} '{}'", path[0], path[1]),
                  !near.empty() ? near
                  : names.empty()
                      ? fmt::format("it has none: write [{}.{}] in the case file", path[0], path[1])
                      : fmt::format("it has: {}. A new one: {}.{}={{...}} with all that it needs",
                                    fmt::join(names, ", "), path[0], path[1]));
        continue;
      }
    }
    const Document before = document;
    if (!put(document.root, path, value)) {
      out.error({source_name, line, 1, static_cast<int>(equals)},
                fmt::format("'{}' leads through a key that is not a table", one.substr(0, equals)));
      continue;
    }
    place_keys(document.root, path, before, {source_name, line, 1, 1});
  }
}

}  // namespace recoil::config
