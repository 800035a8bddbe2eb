#include "config/declare/reading.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <system_error>

#include "config/kept_files.hpp"
#include "core/closest.hpp"

namespace recoil::config {

void TableReading::missing(std::string_view key) const {
  for (const Key& k : keys)
    if (k.name == key) report_missing(node, k, owner, in.out);
}

std::filesystem::path input_file(const TableReading& reading, std::string_view key) {
  namespace fs = std::filesystem;
  const CaseReading& in = reading.in;
  const fs::path named = reading.record.text(key);
  const bool in_run = fs::exists(in.folder / "case.resolved.toml");
  const fs::path file = in.folder / (in_run ? named.filename() : named);
  std::error_code error;
  if (!fs::is_regular_file(file, error)) {
    reading.wrong(key, fmt::format("there is no file {}", file.string()),
                  "its path is seen from the folder of the case file");
    return {};
  }
  if (!in.files) return file;
  const std::string problem = keep_file(*in.files, file);
  if (!problem.empty()) reading.wrong(key, problem, rename_one);
  return file;
}

bool check_body(const std::string& name, const Place& place, const CaseReading& in) {
  if (std::find(in.bodies.begin(), in.bodies.end(), name) != in.bodies.end()) return true;
  const std::string near = did_you_mean(name, in.bodies);
  in.out.error(place, fmt::format("there is no body '{}'", name),
               !near.empty() ? near : fmt::format("the bodies are: {}", fmt::join(in.bodies, ", ")));
  return false;
}

std::vector<std::array<std::string, 2>> pairs_named(std::string_view pair,
                                                    const std::vector<std::string>& names) {
  std::vector<std::array<std::string, 2>> found;
  const auto known = [&](std::string_view s) {
    return std::find(names.begin(), names.end(), s) != names.end();
  };
  for (std::size_t i = 1; i + 1 < pair.size(); ++i) {
    const std::string_view a = pair.substr(0, i), b = pair.substr(i + 1);
    if (pair[i] == '-' && known(a) && known(b)) found.push_back({std::string(a), std::string(b)});
  }
  return found;
}

std::array<std::string, 2> read_pair(const std::string& pair, const Place& place,
                                     const std::vector<std::string>& names, Diagnostics& out) {
  const auto found = pairs_named(pair, names);
  if (found.size() == 1 && found[0][0] != found[0][1]) return found[0];
  if (found.size() > 1) {
    out.error(place, fmt::format("'{}' can be read as more than one pair of bodies", pair), "rename a body");
    return {};
  }
  std::vector<std::string> all;
  for (std::size_t i = 0; i < names.size(); ++i)
    for (std::size_t j = i + 1; j < names.size(); ++j) all.push_back(names[i] + '-' + names[j]);
  const std::string near = did_you_mean(pair, all);
  out.error(place, fmt::format("'{}' is not a pair of bodies", pair),
            !near.empty() ? near : fmt::format("the pairs are: {}", fmt::join(all, ", ")));
  return {};
}

bool check_name(const Node& node, const char* what, Diagnostics& out) {
  const auto fits = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
  };
  const bool good = !node.key.empty() && std::all_of(node.key.begin(), node.key.end(), fits);
  if (!good)
    out.error(node.key_place, fmt::format("'{}' cannot be the name of a {}", node.key, what),
              "use letters, digits, _ and -");
  if (good && node.key == "total") {
    out.error(node.key_place, fmt::format("'total' cannot be the name of a {}", what),
              "history.csv calls the sum over all bodies so");
    return false;
  }
  return good;
}

bool check_is_table(const Node& node, const char* what, Diagnostics& out) {
  if (node.is_table()) return true;
  out.error(node.key_place, fmt::format("'{}' must be a {}, but is {}", node.key, what, describe(node)),
            fmt::format("write [{}.NAME] above the keys of a {}", what, what));
  return false;
}

}  // namespace recoil::config
