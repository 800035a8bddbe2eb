#include "config/document.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace recoil::config::document_test {
namespace {

TEST(Document, KeepsOrderAndPlaces) {
  Diagnostics d;
  const Document doc =
      parse_document("[body.zinc]\nm = \"a\"\n[body.alu]\nv = { z = \"1 m/s\", a = 2 }\n", "f.toml", d);
  ASSERT_FALSE(d.has_errors());
  EXPECT_EQ(doc.names("body"), (std::vector<std::string>{"zinc", "alu"}));
  const Node* z = doc.find("body.alu.v.z");
  ASSERT_NE(z, nullptr);
  EXPECT_EQ(z->path, "body.alu.v.z");
  EXPECT_EQ(z->place.line, 4);
  EXPECT_EQ(z->place.column, 11);
  EXPECT_EQ(z->place.length, 7);
  EXPECT_EQ(z->key_place.column, 7);
  EXPECT_EQ(doc.find("body.alu.v")->children[1].integer, 2);
  EXPECT_EQ(doc.find("body.tin"), nullptr);
}

TEST(Document, ReadsPathsWithQuotes) {
  Diagnostics d;
  const Document doc = parse_document("[expect]\n\"a.b\" = true\n", "f", d);
  const Node* node = doc.find("expect.\"a.b\"");
  ASSERT_NE(node, nullptr);
  EXPECT_EQ(node->path, "expect.\"a.b\"");
  EXPECT_TRUE(node->flag);
}

TEST(Document, QuotesWhatTheUserForgotAndGoesOn) {
  Diagnostics d;
  const Document doc =
      parse_document("v = { x = 5 km/s, y = 0.1mm, z = \"1 m\" } # 3 m\ng = planar\n", "f", d);
  ASSERT_TRUE(doc.complete);
  ASSERT_EQ(d.error_count(), 3);
  EXPECT_EQ(d.list()[0].message, "'5 km/s' needs quotes: a number with its unit is a text");
  EXPECT_EQ(d.list()[0].help, "write \"5 km/s\"");
  EXPECT_EQ(d.list()[0].place.column, 11);
  EXPECT_EQ(d.list()[0].place.length, 6);
  EXPECT_EQ(d.list()[1].place.column, 23);
  EXPECT_EQ(d.list()[2].place.line, 2);
  EXPECT_EQ(doc.find("v.x")->text, "5 km/s");
  EXPECT_EQ(doc.find("v.z")->place.column, 34) << "a place after the repairs is the user's";
  EXPECT_EQ(doc.find("v.z")->place.length, 5);
}

TEST(Document, ReportsOtherMistakesOfSyntax) {
  Diagnostics d;
  const Document doc = parse_document("a = 1\na = 2\n", "f", d);
  EXPECT_FALSE(doc.complete);
  ASSERT_EQ(d.error_count(), 1);
  EXPECT_EQ(d.list()[0].place.line, 2);
  EXPECT_NE(d.list()[0].message.find("given twice"), std::string::npos);
}

TEST(Document, AMissingFileIsAnError) {
  Diagnostics d;
  EXPECT_FALSE(read_document("/no/such/case.toml", d).complete);
  EXPECT_NE(d.text().find("cannot read '/no/such/case.toml'"), std::string::npos);
}

TEST(Document, PutsAndMerges) {
  Diagnostics d;
  Document base = parse_document("rho = 1\n[strength]\nkind = \"jc\"\nc = 0.1\n", "base", d);
  const Document over = parse_document("[strength]\nc = 0\n", "over", d);
  const Node both = merged(base.root, over.root);
  EXPECT_EQ(both.find("strength")->find("kind")->text, "jc");
  EXPECT_EQ(both.find("strength")->find("c")->number, 0);
  EXPECT_EQ(both.find("strength")->find("c")->place.file, "over");
  EXPECT_TRUE(put(base.root, {"a", "b"}, parse_value("0.1mm", {"--set", 1, 1, 1})));
  EXPECT_EQ(base.find("a.b")->text, "0.1mm");
  EXPECT_TRUE(put(base.root, {"rho"}, parse_value("[1, 2]", {})));
  EXPECT_EQ(base.find("rho")->children.size(), 2U);
  EXPECT_FALSE(put(base.root, {"rho", "x"}, parse_value("1", {})));
}

}  // namespace
}  // namespace recoil::config::document_test
