#include "config/schema.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "config/document.hpp"
#include "config/keys.hpp"
#include "config/table.hpp"
#include "config/units.hpp"
#include "core/error.hpp"

namespace recoil::config::schema_test {
namespace {

using nlohmann::json;

/// The schema of the table that a section describes.
const json& table_of(const json& schema, const std::string& section) {
  const json* at = &schema;
  if (!section.empty())
    for (const std::string& part : split_path(section))
      at = part == "*" ? &at->at("additionalProperties") : &at->at("properties").at(part);
  return *at;
}

TEST(Schema, IsJsonThatNamesEveryKey) {
  const json schema = json::parse(json_schema());
  for (const Section& section : case_sections()) {
    const json& table = table_of(schema, section.name);
    EXPECT_EQ(table.at("additionalProperties").type(), json(false).type()) << section.name;
    for (const Key& key : section.keys) {
      EXPECT_TRUE(table.at("properties").contains(key.name)) << section.name << "." << key.name;
      EXPECT_TRUE(table.at("properties").at(key.name).contains("description"))
          << section.name << "." << key.name;
    }
  }
  const json& mesh = table_of(schema, "mesh");
  EXPECT_EQ(mesh.at("required"), json::array({"finest"}));
  EXPECT_EQ(mesh.at("properties").at("offset").at("maximum"), 1);
  EXPECT_EQ(table_of(schema, "domain").at("properties").at("geometry").at("enum").size(), 5U);
}

TEST(Schema, TheRegistryIsWhole) {
  for (const Section& section : case_sections()) {
    EXPECT_FALSE(section.doc.empty()) << section.name;
    for (const Key& key : section.keys) {
      EXPECT_FALSE(key.doc.empty()) << section.name << "." << key.name;
      EXPECT_NO_THROW(dimension_name(key.unit)) << key.name;
    }
  }
}

TEST(Schema, ExamplesAndDefaultsCanBeRead) {
  int read = 0;
  for (const Section& section : case_sections())
    for (const Key& key : section.keys)
      for (const std::string& text : {key.example, key.default_text}) {
        const bool plain = key.type != Key::Type::any && key.type != Key::Type::table;
        if (text.empty() || !plain || text.starts_with("{ kind")) continue;
        Node table;
        table.kind = Node::Kind::table;
        Node value = parse_value(text, {});
        value.key = key.name;
        table.children = {value};
        Diagnostics out;
        std::vector<std::string> axes{"x", "y", "z"};
        if (key.type == Key::Type::turn && !value.is_table()) axes.pop_back();  // a quantity in the plane
        read_record(table, {&key, 1}, out, axes);
        EXPECT_EQ(out.text(), "") << section.name << "." << key.name << " = " << text;
        ++read;
      }
  EXPECT_GT(read, 100);
}

TEST(Schema, GaugesAreListedByKindWithTheirColumns) {
  int kinds = 0;
  for (const Section& section : case_sections()) {
    if (section.name != "gauge.*") continue;
    ++kinds;
    EXPECT_FALSE(section.columns.empty()) << section.kind;
    EXPECT_NE(section.kind, "");
  }
  EXPECT_EQ(kinds, 12);
  EXPECT_NE(explain("gauge").find("peak-stress"), std::string::npos);
  EXPECT_NE(explain("gauge").find("velocity.AXIS"), std::string::npos);
}

TEST(Explain, FindsKeysByPathAndByName) {
  for (const char* name : {"mesh.finest", "finest", "[mesh].finest"}) {
    const std::string text = explain(name);
    EXPECT_NE(text.find("edge of the smallest cells"), std::string::npos) << text;
    EXPECT_NE(text.find("finest = \"0.05 mm\""), std::string::npos) << text;
  }
  EXPECT_NE(explain("body.flyer.velocity").find("vector of velocity [m/s]"), std::string::npos);
  EXPECT_NE(explain("[gauge]").find("surface-velocity"), std::string::npos);
  EXPECT_NE(explain("body.flyer").find("rigid"), std::string::npos);
}

TEST(Explain, AsksBackWhereThereIsNoSuchKey) {
  try {
    explain("mesh.finset");
    FAIL() << "an unknown key was explained";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("did you mean 'mesh.finest'"), std::string::npos) << e.what();
  }
}

TEST(ReferencePage, NamesEveryKey) {
  const std::string page = reference_page();
  for (const Section& section : case_sections())
    for (const Key& key : section.keys)
      EXPECT_NE(page.find("| `" + key.name + "` |"), std::string::npos) << key.name;
}

}  // namespace
}  // namespace recoil::config::schema_test
