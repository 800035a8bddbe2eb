#include "config/schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "config/document.hpp"
#include "config/keys.hpp"

namespace recoil::config {

namespace {

using Json = nlohmann::ordered_json;
using Type = Key::Type;

Json quantity(const std::string& unit) {
  if (unit.empty() || unit == "1") return {{"type", {"number", "string"}}};
  return {{"type", "string"}, {"pattern", R"(^\s*[-+]?[0-9]*\.?[0-9]*([eE][-+]?[0-9]+)?\s*[^\s0-9].*$)"}};
}

Json object() {
  return {{"type", "object"}, {"additionalProperties", false}, {"properties", Json::object()}};
}

Json text(const std::vector<std::string>& choices) {
  Json s{{"type", "string"}};
  if (!choices.empty()) s["enum"] = choices;
  return s;
}

Json type_of(const Key& key) {
  switch (key.type) {
    case Type::quantity:
      return quantity(key.unit);
    case Type::integer:
      return {{"type", "integer"}};
    case Type::flag:
      return {{"type", "boolean"}};
    case Type::text:
    case Type::choice:
      return text(key.choices);
    case Type::texts:
      return {{"anyOf", {text(key.choices), {{"type", "array"}, {"items", text(key.choices)}}}}};
    case Type::range:
      return {{"type", "array"}, {"items", quantity(key.unit)}, {"minItems", 2}, {"maxItems", 2}};
    case Type::vector: {
      Json s = object();
      for (const char* axis : {"x", "y", "z", "r"}) s["properties"][axis] = quantity(key.unit);
      return s;
    }
    case Type::direction: {
      Json s = type_of({.name = key.name, .type = Type::vector});
      for (const char* angle : {"angle", "elevation"}) s["properties"][angle] = quantity("rad");
      return s;
    }
    case Type::turn: {
      Json vector = type_of({.name = key.name, .type = Type::vector, .unit = key.unit});
      return {{"anyOf", {quantity(key.unit), vector}}};
    }
    case Type::table:
      return {{"type", "object"}};
    case Type::any:
      return Json::object();
  }
  return Json::object();
}

/// The value that a default or an example stands for; texts of TOML are mostly JSON as well.
Json value_of(const Key& key, const std::string& written) {
  Json value = Json::parse(written, nullptr, false);
  if (value.is_discarded() && key.type != Type::vector && key.type != Type::direction &&
      key.type != Type::turn && key.type != Type::any && written.find('{') == std::string::npos)
    value = written;
  return value;
}

Json key_schema(const Key& key) {
  Json s = type_of(key);
  s["description"] = key.doc;
  const bool number =
      key.type == Type::integer || (key.type == Type::quantity && (key.unit.empty() || key.unit == "1"));
  if (number && std::isfinite(key.maximum)) s["maximum"] = key.maximum;
  if (number && std::isfinite(key.minimum)) s["minimum"] = key.minimum;
  if (number && key.positive) s["exclusiveMinimum"] = 0;
  if (!key.default_text.empty()) s["default"] = value_of(key, key.default_text);
  if (!key.example.empty())
    if (const Json example = value_of(key, key.example); !example.is_discarded())
      s["examples"] = Json::array({example});
  return s;
}

/// The schema of the table that a section describes, made on the way where it is not there yet.
Json& table_schema(Json& root, const std::string& section) {
  Json* at = &root;
  if (section.empty()) return *at;
  for (const std::string& part : split_path(section)) {
    if (part == "*") {
      Json& below = (*at)["additionalProperties"];
      if (!below.is_object()) below = object();
      at = &below;
    } else {
      at = &(*at)["properties"][part];
    }
  }
  if (!at->contains("type") || !at->contains("properties")) at->update(object());
  return *at;
}

void add_section(Json& root, const Section& section, bool may_demand = true) {
  Json& table = table_schema(root, section.name);
  if (!table.contains("description")) table["description"] = section.doc;
  for (const Key& key : section.keys) {
    if (!table["properties"].contains(key.name)) table["properties"][key.name] = key_schema(key);
    if (!may_demand) continue;
    // Of tables with kinds only `kind` is needed in all of them.
    if (!key.required || (!section.kind.empty() && key.name != "kind")) continue;
    Json& required = table["required"];
    if (std::find(required.begin(), required.end(), key.name) == required.end()) required.push_back(key.name);
  }
}

}  // namespace

std::string json_schema(const std::vector<Section>& more) {
  Json root = object();
  root["$schema"] = "http://json-schema.org/draft-07/schema#";
  root["title"] = "Recoil case file, format 1";
  for (const Section& section : case_sections()) add_section(root, section);
  root["properties"]["expect"]["additionalProperties"]["type"] = {"object", "boolean"};
  root["properties"]["material"]["additionalProperties"] = {{"type", "object"}};
  for (const Section& section : more) add_section(root, section, false);
  return root.dump(2) + '\n';
}

}  // namespace recoil::config
