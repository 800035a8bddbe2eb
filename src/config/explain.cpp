#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "config/document.hpp"
#include "config/keys.hpp"
#include "config/schema.hpp"
#include "config/units.hpp"
#include "core/closest.hpp"
#include "core/error.hpp"

namespace recoil::config {

namespace {

using Type = Key::Type;

std::string unit_text(const Key& key) {
  return key.unit.empty() || key.unit == "1" ? "number"
                                             : fmt::format("{} [{}]", dimension_name(key.unit), key.unit);
}

std::string type_text(const Key& key) {
  switch (key.type) {
    case Type::quantity:
      return unit_text(key);
    case Type::integer:
      return "whole number";
    case Type::flag:
      return "true or false";
    case Type::text:
      return "text";
    case Type::choice:
      return "one of " + fmt::format("{}", fmt::join(key.choices, ", "));
    case Type::texts:
      return key.choices.empty() ? "texts" : "texts of " + fmt::format("{}", fmt::join(key.choices, ", "));
    case Type::range:
      return "pair of " + unit_text(key);
    case Type::vector:
      return "vector of " + unit_text(key);
    case Type::direction:
      return "direction by components or angles";
    case Type::turn:
      return unit_text(key) + ", in 3d a vector of it";
    case Type::table:
      return "table";
    case Type::any:
      return key.unit.empty() ? "see below" : unit_text(key);
  }
  return {};
}

/// Where a key exists, or nothing where it does everywhere.
std::string where_text(const Key& key) {
  return key.only_in.empty() ? "" : "only in " + names_of(key.only_in);
}

std::string limits_text(const Key& key) {
  std::string out;
  if (key.positive) out = "above 0";
  if (!key.positive && std::isfinite(key.minimum)) out = fmt::format("from {:g}", key.minimum);
  if (std::isfinite(key.maximum)) out += fmt::format("{}up to {:g}", out.empty() ? "" : ", ", key.maximum);
  return out;
}

std::string default_text(const Key& key) {
  return key.required ? "required" : key.default_text.empty() ? "" : "default " + key.default_text;
}

std::string heading(const Section& s) {
  const std::string name = s.name.empty() ? "top of the file" : '[' + s.name + ']';
  return s.kind.empty() ? name : fmt::format("{} {}", name, s.kind);
}

std::string explain_key(const Section& section, const Key& key) {
  std::string out =
      fmt::format("{} in {}\n  {}\n  type     {}\n", key.name, heading(section), key.doc, type_text(key));
  if (const std::string limits = limits_text(key); !limits.empty()) out += "  range    " + limits + '\n';
  if (!key.default_text.empty()) out += "  default  " + key.default_text + '\n';
  if (key.required) out += "  required\n";
  if (const std::string where = where_text(key); !where.empty()) out += "  geometry " + where + '\n';
  if (!key.example.empty()) out += fmt::format("  example  {} = {}\n", key.name, key.example);
  return out;
}

/// NAME.AXIS stands for one column along each coordinate.
std::string full_name(const Column& column) {
  using enum Column::Each;
  return std::string(column.name) + (column.each == axis     ? ".AXIS"
                                     : column.each == stress ? ".COMPONENT"
                                     : column.each == turn   ? " (3d: .AXIS)"
                                                             : "");
}

std::string explain_section(const Section& section) {
  std::string out = fmt::format("{}\n  {}\n", heading(section), section.doc);
  for (const Key& key : section.keys) {
    const std::string extra = default_text(key);
    out += fmt::format("  {:<12} {}{}\n", key.name, key.doc, extra.empty() ? "" : " (" + extra + ")");
  }
  if (!section.columns.empty()) out += "  columns\n";
  for (const Column& c : section.columns)
    out += fmt::format("    {:<24} {} [{}]\n", full_name(c), c.doc, c.unit);
  return out;
}

/// "body.flyer" fits "body.*"; without the part that the user chooses ("body") it fits as well.
bool fits(const std::string& section, const std::string& asked) {
  const std::vector<std::string> pattern = split_path(section), parts = split_path(asked);
  const auto same = [](const std::string& p, const std::string& a) { return p == "*" || p == a; };
  if (std::equal(pattern.begin(), pattern.end(), parts.begin(), parts.end(), same)) return true;
  std::vector<std::string> fixed;
  std::copy_if(pattern.begin(), pattern.end(), std::back_inserter(fixed),
               [](const auto& p) { return p != "*"; });
  return fixed == parts;
}

std::string without_brackets(std::string key) {
  std::erase_if(key, [](char c) { return c == '[' || c == ']' || c == ' '; });
  return key;
}

std::vector<Section> with_more(const std::vector<Section>& more) {
  std::vector<Section> all = case_sections();
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace

std::string explain(const std::string& key, const std::vector<Section>& more) {
  const std::string asked = without_brackets(key);
  const std::size_t dot = asked.rfind('.');
  const std::string last = dot == std::string::npos ? asked : asked.substr(dot + 1);
  std::string out;
  std::vector<std::string> names;
  std::set<std::string> shown;
  const auto add = [&](const std::string& text) { out += (out.empty() ? "" : "\n") + text; };
  for (const Section& section : with_more(more)) {
    if (!section.name.empty()) names.push_back(section.name);
    if (!asked.empty() && fits(section.name, asked)) add(explain_section(section));
    for (const Key& k : section.keys) {
      names.push_back(k.name);
      names.push_back(join_path(section.name, k.name));
      const bool named = dot == std::string::npos || fits(section.name, asked.substr(0, dot));
      // Keys at the top that only open a section are explained by it.
      const bool opens = section.name.empty() && k.type == Type::table && k.name != "material";
      const bool told =
          !shown.insert(section.name + '.' + k.name + ' ' + k.doc).second;  // the same for each kind
      if (k.name == last && named && !opens && !told) add(explain_key(section, k));
    }
  }
  if (!out.empty()) return out;
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  std::string help = did_you_mean(asked, names, 3);
  if (help.empty()) help = did_you_mean(last, names, 3);
  throw InputError(
      fmt::format("error: there is no key '{}'\n{}", key, help.empty() ? "" : "   = help: " + help + '\n'));
}

std::string reference_page(const std::vector<Section>& more) {
  std::string out =
      "# The case file\n\n"
      "A case is a TOML file. Every quantity is a text with its unit (`\"0.05 mm\"`). `*` stands for a name "
      "of your "
      "choice.\nThis page is written by `recoil schema --markdown` from the same list that the program reads "
      "with.\n";
  for (const Section& section : with_more(more)) {
    out += fmt::format(
        "\n## {}\n\n{}\n\n| key | type | range | default | meaning | example |\n|---|---|---|---|---|---|\n",
        heading(section), section.doc);
    for (const Key& key : section.keys) {
      const std::string standard = key.required ? "required" : key.default_text, where = where_text(key);
      out += fmt::format("| `{}` | {} | {} | {} | {}{} | {} |\n", key.name, type_text(key), limits_text(key),
                         standard, key.doc, where.empty() ? "" : "; " + where,
                         key.example.empty() ? "" : '`' + key.example + '`');
    }
    if (section.columns.empty()) continue;
    out += "\nColumns of its file:\n\n| column | unit | meaning |\n|---|---|---|\n";
    for (const Column& c : section.columns)
      out += fmt::format("| `{}` | {} | {} |\n", full_name(c), c.unit, c.doc);
  }
  return out;
}

}  // namespace recoil::config
