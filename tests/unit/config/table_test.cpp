#include "config/table.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/error.hpp"

namespace recoil::config::table_test {
namespace {

const std::vector<Key> keys{
    {.name = "density",
     .type = Key::Type::quantity,
     .unit = "kg/m3",
     .positive = true,
     .required = true,
     .doc = "mass per volume",
     .example = "\"8.93 g/cm3\""},
    {.name = "gamma",
     .type = Key::Type::quantity,
     .unit = "1",
     .minimum = 0,
     .maximum = 5,
     .default_text = "2"},
    {.name = "count", .type = Key::Type::integer, .minimum = 1, .default_text = "3"},
    {.name = "melts", .type = Key::Type::flag, .default_text = "true"},
    {.name = "title", .default_text = "none"},
    {.name = "cite", .type = Key::Type::texts},
    {.name = "kind",
     .type = Key::Type::choice,
     .default_text = "jc",
     .choices = {"jc", "elastic"},
     .not_yet = {"sg"}},
    {.name = "r", .type = Key::Type::range, .unit = "m"},
    {.name = "at", .type = Key::Type::vector, .unit = "m", .default_text = {}},
    {.name = "eos", .type = Key::Type::table},
};

struct Read {
  Diagnostics out;
  Document doc;
  Record record;
  explicit Read(const std::string& text)
      : doc(parse_document(text, "f", out)), record(read_record(doc.root, keys, out)) {}
  /// The only mistake.
  const Diagnostic& only() const {
    EXPECT_EQ(out.error_count(), 1) << out.text();
    static const Diagnostic none{};
    return out.list().empty() ? none : out.list().front();
  }
};

TEST(Table, ReadsEveryType) {
  const Read r(
      "density = \"8.93 g/cm3\"\ngamma = 1.5\ncount = 7\nmelts = false\ntitle = \"t\"\ncite = [\"a\", "
      "\"b\"]\n"
      "kind = \"elastic\"\nr = [\"0 mm\", \"2 mm\"]\nat = { y = \"1 mm\" }\neos = { kind = 1 }\n");
  ASSERT_FALSE(r.out.has_errors()) << r.out.text();
  EXPECT_DOUBLE_EQ(r.record.number("density"), 8930);
  EXPECT_EQ(r.record.number("gamma"), 1.5);
  EXPECT_EQ(r.record.integer("count"), 7);
  EXPECT_FALSE(r.record.flag("melts"));
  EXPECT_EQ(r.record.text("title"), "t");
  EXPECT_EQ(r.record.texts("cite").size(), 2U);
  EXPECT_EQ(r.record.text("kind"), "elastic");
  EXPECT_EQ(r.record.range("r")[1], 2e-3);
  EXPECT_EQ(r.record.vector3("at")[1], 1e-3);
  EXPECT_EQ(r.record.node("eos")->children.size(), 1U);
  EXPECT_EQ(r.record.place("gamma").line, 2);
  EXPECT_EQ(r.record.place("gamma").column, 9);
}

TEST(Table, TakesDefaults) {
  const Read r("density = \"1 kg/m3\"");
  EXPECT_EQ(r.record.number("gamma"), 2);
  EXPECT_EQ(r.record.integer("count"), 3);
  EXPECT_TRUE(r.record.flag("melts"));
  EXPECT_EQ(r.record.text("kind"), "jc");
  EXPECT_FALSE(r.record.has("gamma"));
  EXPECT_EQ(r.record.node("eos"), nullptr);
  EXPECT_THROW(r.record.number("gama"), InternalError);
}

TEST(Table, AWrongValueIsReportedAndItsDefaultUsed) {
  const Read r("density = \"1 kg/m3\"\ngamma = 9\n");
  EXPECT_EQ(r.only().message, "'gamma' must be at most 5, but is 9");
  EXPECT_EQ(r.record.number("gamma"), 2);
  EXPECT_TRUE(r.record.has("gamma"));
  EXPECT_FALSE(r.record.good("gamma"));
}

TEST(Table, ReportsAMissingKeyWithAnExample) {
  const Read r("gamma = 1\n");
  EXPECT_EQ(r.only().message, "'density' is missing");
  EXPECT_EQ(r.only().help, "density = \"8.93 g/cm3\": mass per volume");
}

TEST(Table, ReportsWrongTypes) {
  EXPECT_NE(Read("density = true").only().message.find("needs a quantity of [density], but is true"),
            std::string::npos);
  EXPECT_EQ(Read("density = 8930").only().help, "write density = \"8930 g/cm3\"");
  const std::string good = "density = \"1 kg/m3\"\n";
  EXPECT_NE(Read(good + "count = 1.5").only().message.find("whole number"), std::string::npos);
  EXPECT_NE(Read(good + "melts = 1").only().message.find("true or false"), std::string::npos);
  EXPECT_NE(Read(good + "title = 1").only().message.find("a text"), std::string::npos);
  EXPECT_NE(Read(good + "eos = 1").only().message.find("a table"), std::string::npos);
  EXPECT_NE(Read(good + "r = [\"1 mm\"]").only().message.find("pair"), std::string::npos);
  EXPECT_NE(Read(good + "r = [\"2 mm\", \"1 mm\"]").only().message.find("low end first"), std::string::npos);
  EXPECT_NE(Read(good + "at = { r = \"1 mm\" }").only().message.find("not a component"), std::string::npos);
  EXPECT_NE(Read(good + "gamma = inf").only().message.find("finite"), std::string::npos);
  EXPECT_NE(Read("density = \"0 kg/m3\"").only().message.find("more than 0 kg/m3"), std::string::npos);
  EXPECT_NE(Read(good + "kind = \"sg\"").only().message.find("not available in this version"),
            std::string::npos);
  EXPECT_NE(Read(good + "kind = \"elastc\"").only().help.find("did you mean 'elastic'?"), std::string::npos);
}

}  // namespace
}  // namespace recoil::config::table_test
