#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

#include "config/overrides.hpp"
#include "config/read_case.hpp"

namespace recoil::config::mistakes_test {
namespace {

/// A right case, to be spoiled one line at a time.
const std::vector<std::string> lines{
    "format = 1",                                                                      // 1
    "[domain]",                                                                        // 2
    "geometry = \"planar\"",                                                           // 3
    "x = [\"0 mm\", \"80 mm\"]",                                                       // 4
    "y = [\"-8 mm\", \"22 mm\"]",                                                      // 5
    "[mesh]",                                                                          // 6
    "finest = \"0.5 mm\"",                                                             // 7
    "[time]",                                                                          // 8
    "end = \"10 us\"",                                                                 // 9
    "[body.flyer]",                                                                    // 10
    "material = \"steel/hzb\"",                                                        // 11
    "velocity = { x = \"5 km/s\" }",                                                   // 12
    "shape = { kind = \"box\", x = [\"0 mm\", \"2 mm\"], y = [\"0 mm\", \"9 mm\"] }",  // 13
    "[body.target]",                                                                   // 14
    "rigid = true",                                                                    // 15
    "shape = { kind = \"disc\", radius = \"5 mm\", centre = { x = \"20 mm\" } }",      // 16
    "[gauge.rear]",                                                                    // 17
    "kind = \"point\"",                                                                // 18
    "body = \"target\"",                                                               // 19
    "at = { x = \"1 mm\" }",                                                           // 20
    "[expect]",                                                                        // 21
    "\"contact.flyer-target.opens\" = { value = \"0.7 us\", within = \"3 %\" }",       // 22
};

std::string with(int line, const std::string& replacement) {
  std::string text;
  for (int n = 1; n <= static_cast<int>(lines.size()); ++n)
    text += (n == line ? replacement : lines[n - 1]) + '\n';
  return text;
}

struct Mistake {
  int line;          // that is replaced
  const char* text;  // by this
  int at_line, at_column;
  const char* message;  // part of it
  const char* help;     // part of it
};

void PrintTo(const Mistake& m, std::ostream* out) { *out << m.text; }

class Mistakes : public testing::TestWithParam<Mistake> {};

TEST_P(Mistakes, GetsAMessageAPlaceAndACure) {
  const Mistake& m = GetParam();
  Diagnostics out;
  const Document doc = parse_document(with(m.line, m.text), "case.toml", out);
  read_case(doc, out);
  ASSERT_EQ(out.error_count(), 1) << out.text();
  const Diagnostic& d = out.list().front();
  EXPECT_NE(d.message.find(m.message), std::string::npos) << out.text();
  EXPECT_NE(d.help.find(m.help), std::string::npos) << out.text();
  EXPECT_EQ(d.place.line, m.at_line) << out.text();
  EXPECT_EQ(d.place.column, m.at_column) << out.text();
}

INSTANTIATE_TEST_SUITE_P(
    Case, Mistakes,
    testing::Values(
        Mistake{12, "velocty = { x = \"5 km/s\" }", 12, 1, "unknown key 'velocty' in [body.flyer]",
                "did you mean 'velocity'?"},
        Mistake{7, "finest = \"2 us\"", 7, 10, "'2 us' has dimension [time], but 'finest' needs [length]",
                "mm"},
        Mistake{12, "velocity = { x = 5 km/s }", 12, 18, "'5 km/s' needs quotes", "write \"5 km/s\""},
        Mistake{7, "finest = 0.5", 7, 10, "'finest' is a bare number", "write finest = \"0.5 mm\""},
        Mistake{1, "format = 2", 1, 10, "this case has format 2", "newer"},
        Mistake{3, "geometry = \"plane\"", 3, 12, "'plane' is not a valid 'geometry'", "planar"},
        Mistake{3, "geometry = planar", 3, 12, "'planar' needs quotes", "write \"planar\""},
        Mistake{4, "x = [\"80 mm\", \"0 mm\"]", 4, 5, "low end first", "swap"},
        Mistake{5, "z = [\"0 mm\", \"1 mm\"]\ny = [\"-8 mm\", \"22 mm\"]", 5, 1,
                "'z' in [domain] is not a coordinate", "x, y"},
        Mistake{4, "", 2, 2, "'x' is missing in [domain]", "x = [\"0 mm\""},
        Mistake{4, "boundary = { x = [\"periodic\", \"outflow\"] }\nx = [\"0 mm\", \"80 mm\"]", 4, 18,
                "only one end", "both"},
        Mistake{4, "boundary = { x = \"wall\" }\nx = [\"0 mm\", \"80 mm\"]", 4, 18, "'wall' is not a valid",
                "a wall is a body with rigid = true"},
        Mistake{3, "geometry = \"2d\"", 3, 12, "'2d' is not a valid 'geometry'", "\"planar\" (plane strain)"},
        Mistake{7, "finest = \"20 mm\"", 7, 10, "1.5 cells wide along y", "0.75 mm"},
        Mistake{7, "finest = \"0.5 mn\"", 7, 10, "unknown unit 'mn'", "did you mean 'mm'?"},
        Mistake{7, "finest = \"-0.5 mm\"", 7, 10, "'finest' must be more than 0 mm", ""},
        Mistake{7, "", 6, 2, "'finest' is missing in [mesh]", "0.05 mm"},
        Mistake{9, "end = \"0 us\"", 9, 7, "'end' must be more than 0 us", ""},
        Mistake{9, "end = \"10 us\"\ncfl = 1.5", 10, 7, "'cfl' must be at most 1", ""},
        Mistake{9, "end = \"10 us\"\n[method]\nscheme = \"sed\"", 11, 10, "'sed' is not a valid 'scheme'",
                "did you mean 'seed'?"},
        Mistake{9, "end = \"10 us\"\n[method]\nscheme = \"ghost-fluid\"\nkappa = 0.3", 12, 1,
                "'kappa' has no meaning for scheme = \"ghost-fluid\"", "scheme = \"seed\""},
        Mistake{9, "end = \"10 us\"\n[method]\nscheme = \"seed\"\nkappa = 1.5", 12, 9,
                "'kappa' must be at most 1", ""},
        Mistake{9, "end = \"10 us\"\n[contact]\ndefault = \"bondd\"", 11, 11, "'bondd'", "bonded"},
        Mistake{9, "end = \"10 us\"\n[metod]", 10, 2, "unknown key 'metod'", "did you mean 'method'?"},
        Mistake{9, "end = \"10 us\"\nend = \"11 us\"", 10, 7, "'end' is given twice",
                "line 9: end = \"10 us\""},
        Mistake{8, "[mesh]", 8, 1, "'mesh' is given twice", "line 6: [mesh]"},
        Mistake{9, "end = nan", 9, 7, "'end' must be finite, but is nan", "\"10 us\""},
        Mistake{9, "end = -inf", 9, 7, "'end' must be finite, but is -inf", "\"10 us\""},
        Mistake{9, "end = \"nan us\"", 9, 7, "'end' must be finite", "10 us"},
        Mistake{9, "end = \"1e400 us\"", 9, 7, "'end' must be finite", "10 us"},
        Mistake{7, "finest = \"1e307 km\"", 7, 10, "beyond the range of numbers", "0.5 mm"},
        Mistake{12, "velocity = { x = \"5 mps\" }", 12, 18, "unknown unit 'mps'", "did you mean 'm/s'?"},
        Mistake{12, "velocity = { x = \"5 Kph\" }", 12, 18, "unknown unit 'Kph'", "did you mean 'km/h'?"},
        Mistake{7, "finest = \"0.5 mm", 7, 10, "this quote is never closed", "behind the text"},
        Mistake{7, "finest = 0.5 mm\"", 7, 16, "closes what was never opened", "before the text"},
        Mistake{9, "end = '10 us", 9, 7, "this quote is never closed", "behind"},
        Mistake{4, "x = [\"0 mm, \"80 mm\"]", 4, 6, "this quote is never closed", "behind"},
        Mistake{1, "title = \"\xC3\xA4\xE4\"", 1, 11, "the byte 0xE4 is no UTF-8", "UTF-8"}));

INSTANTIATE_TEST_SUITE_P(
    Bodies, Mistakes,
    testing::Values(
        Mistake{11, "", 10, 7, "'material' is missing in [body.flyer]", "rigid = true"},
        Mistake{15, "rigid = true\nmaterial = \"x\"", 16, 1, "rigid body 'target' has a material", ""},
        Mistake{12, "velocity = { z = \"5 km/s\" }", 12, 14, "'z' is not a component of 'velocity'", "x, y"},
        Mistake{12, "velocity = { x = 5 }", 12, 18, "'x' is a bare number", "\"5 m/s\""},
        Mistake{12, "spin = \"1 rad/s\"", 12, 1, "'spin' needs 'spin-centre'", ""},
        Mistake{12, "spin-centre = { x = \"1 mm\" }", 12, 1, "needs 'spin'", ""},
        Mistake{12, "radial-falls-from = \"1 mm\"", 12, 1, "needs 'radial-velocity'", ""},
        Mistake{16, "", 14, 7, "'shape' is missing in [body.target]", "kind"},
        Mistake{20, "at = { x = \"1 mm\" }\n[body.a]\nfragments-of = \"flier\"", 22, 16,
                "there is no body 'flier'", "did you mean 'flyer'?"},
        Mistake{20, "at = { x = \"1 mm\" }\n[body.a]\nfragments-of = \"\"", 22, 16,
                "the body that breaks has no name", "target"},
        Mistake{20, "at = { x = \"1 mm\" }\n[body.a]\nfragments-of = \"target\"", 22, 16,
                "'a' cannot take up fragments of 'target'", "a rigid body does not break"},
        Mistake{20, "at = { x = \"1 mm\" }\n[body.a]\nfragments-of = \"flyer\"\nmaterial = \"steel/hzb\"", 23,
                1, "'material' and 'fragments-of' do not go together", "begins empty"},
        Mistake{16, "shape = { radius = \"5 mm\" }", 16, 9, "needs its kind", "box"},
        Mistake{16, "shape = { kind = \"disk\", radius = \"5 mm\" }", 16, 18, "'disk' is not a valid 'kind'",
                "did you mean 'disc'?"},
        Mistake{16, "shape = { kind = \"sphere\", radius = \"5 mm\" }", 16, 18,
                "does not exist in geometry \"planar\"", "3d"},
        Mistake{16, "shape = { kind = \"disc\", radus = \"5 mm\", radius = \"5 mm\" }", 16, 26,
                "unknown key 'radus'", "radius"},
        Mistake{16, "shape = { kind = \"box\", x = [\"0 mm\", \"1 mm\"] }", 16, 1, "'y' is missing", "y = "},
        Mistake{16, "shape = { kind = \"half-space\", point = { x = \"0 m\" }, normal = { x = 0 } }", 16, 55,
                "no direction", ""},
        Mistake{16, "shape = { kind = \"polygon\", vertices = [[\"0 m\", \"0 m\"]] }", 16, 40, "at least 3",
                ""},
        Mistake{16, "shape = { kind = \"difference\", parts = [] }", 16, 40, "at least 2 shapes", ""},
        Mistake{14,
                "[body.\"a b\"]\nrigid = true\nshape = { kind = \"disc\", radius = \"5 mm\" }\n[body.target]",
                14, 7, "cannot be the name of a body", "letters"},
        Mistake{14,
                "[body.total]\nrigid = true\nshape = { kind = \"disc\", radius = \"5 mm\" }\n[body.target]",
                14, 7, "'total' cannot be", ""}));

INSTANTIATE_TEST_SUITE_P(
    Gauges, Mistakes,
    testing::Values(
        Mistake{19, "body = \"traget\"", 19, 8, "there is no body 'traget'", "did you mean 'target'?"},
        Mistake{19, "", 17, 8, "'body' is missing in [gauge.rear]", "body = \"target\""},
        Mistake{20, "at = { x = \"90 mm\" }", 20, 6, "lies outside the domain: x = 90 mm", ""},
        Mistake{18, "kind = \"pont\"", 18, 8, "'pont' is not a valid 'kind'", "did you mean 'point'?"},
        Mistake{18, "kind = \"body\"", 20, 1, "'at' does not apply", ""},
        Mistake{21, "[gauge.c]\nkind = \"contact\"\npair = \"flyer-flyer\"\n[expect]", 23, 8,
                "is not a pair of bodies", "flyer-target"},
        Mistake{21, "[gauge.c]\nkind = \"contact\"\npair = \"flyer-target\"\nradius = \"1 mm\"\n[expect]", 21,
                8, "'at' is missing in [gauge.c]", "at = { x"},
        Mistake{21, "[gauge.c]\nkind = \"contact\"\npair = \"flyer-target\"\nat = { x = \"1 mm\" }\n[expect]",
                21, 8, "'radius' is missing in [gauge.c]", "2 mm"},
        Mistake{20, "at = { x = \"10 mm\" }\nradius = \"1 mm\"", 21, 1, "'radius' does not apply", ""},
        Mistake{20, "at = { x = \"10 mm\" }\ndirection = { x = 1 }", 21, 1, "'direction' does not apply", ""},
        Mistake{21, "[gauge.c]\nkind = \"contact\"\npair = \"flyer-target\"\ndirection = { x = 0 }\n[expect]",
                24, 1, "'direction' has no direction", "x = 1, y = 1"},
        Mistake{22, "\"contact.flyer-traget.opens\" = true", 22, 1, "is not a pair of bodies",
                "did you mean 'flyer-target'?"},
        Mistake{22, "\"gauge.raer.velocity@1us\" = true", 22, 1, "there is no gauge 'raer'",
                "did you mean 'rear'?"},
        Mistake{22, "\"body.flyr.velocity\" = true", 22, 1, "there is no body 'flyr'",
                "did you mean 'flyer'?"},
        Mistake{22, "\"run.steps\" = { value = \"1 us\" }", 22, 1, "'within' is missing", "3 %"},
        Mistake{22, "\"run.steps\" = { value = \"1 us\", within = \"1 mm\" }", 22, 42,
                "'within' has dimension [length]", "percentage"},
        Mistake{22, "\"run.steps\" = { value = 0, within = \"1 %\" }", 22, 37, "a percentage of the value 0",
                ""},
        Mistake{22, "\"run.steps\" = { at-most = 1, value = 1 }", 22, 1, "needs one of", ""},
        Mistake{22, "\"run.steps\" = { valu = 1, at-most = 1 }", 22, 17, "unknown key 'valu'",
                "did you mean 'value'?"},
        Mistake{22, "\"a\" = 5", 22, 7, "needs a table, true or false", "within"}));

TEST(MistakesTogether, AreAllReportedInOnePass) {
  std::string text = with(7, "finest = 5");
  text.replace(text.find("\"10 us\""), 7, "10 us");
  text.replace(text.find("body = \"target\""), 15, "bdy = \"target\" ");
  Diagnostics out;
  const Document doc = parse_document(text, "case.toml", out);
  read_case(doc, out);
  EXPECT_EQ(out.error_count(), 4) << out.text();
  EXPECT_NE(out.text().find("  --> case.toml:9:7\n   | end = 10 us\n   |       ^^^^^\n"), std::string::npos)
      << out.text();
}

TEST(MistakesTogether, AnEmptyFileIsEmpty) {
  for (const char* text : {"", "\n \t\r\n"}) {
    Diagnostics out;
    EXPECT_FALSE(parse_document(text, "case.toml", out).complete);
    EXPECT_EQ(out.error_count(), 1);
    EXPECT_NE(out.text().find("the file is empty\n  --> case.toml\n"), std::string::npos) << out.text();
  }
}

// Quotes in comments, escapes and texts of several lines open nothing.
TEST(MistakesTogether, QuotesThatAreRight) {
  for (const char* text : {"# Wilkins' plate, 5\" thick\n", "title = \"a \\\" b\"\n", "title = '\"'\n",
                           "title = \"it's\" # 5\"\n", "title = \"\"\"\nit's \"so\"\n\"\"\"\n",
                           "title = '''\n5\" and 5'\n'''\n", "title = \"\"\ncite = ['a',\"b\"]\n"}) {
    Diagnostics out;
    EXPECT_TRUE(parse_document(text, "case.toml", out).complete) << text << out.text();
    EXPECT_EQ(out.error_count(), 0) << out.text();
  }
}

// Found by the fuzzer: quotes put into a comment do not help the parser, and were put there again and again.
TEST(MistakesTogether, RepairsEnd) {
  Diagnostics out;
  EXPECT_FALSE(parse_document("a = 1  # 60 m/s, 80 m/s along \x01 it\n", "case.toml", out).complete);
  EXPECT_LE(out.error_count(), 2) << out.text();
}

TEST(MistakesTogether, PairsThatCanBeReadTwiceAreRefused) {
  std::string text = with(14, "[body.target]");
  const std::string rigid = "rigid = true\nshape = { kind = \"disc\", radius = \"1 mm\" }\n";
  text += "[body.a]\n" + rigid + "[body.b-c]\n" + rigid + "[body.a-b]\n" + rigid + "[body.c]\n" + rigid +
          "[gauge.g]\nkind = \"contact\"\npair = \"a-b-c\"\n";
  Diagnostics out;
  const Document doc = parse_document(text, "case.toml", out);
  read_case(doc, out);
  ASSERT_EQ(out.error_count(), 1) << out.text();
  EXPECT_NE(out.text().find("more than one pair"), std::string::npos);
}

TEST(MistakesTogether, OfTheCommandLine) {
  Diagnostics out;
  Document doc = parse_document(with(0, ""), "case.toml", out);
  apply_overrides(
      doc, {"mesh.finset=1mm", "body.flyr.material=x", "nonsense", "time.end=5", "mesh.finest.x=1"}, out);
  read_case(doc, out);
  const std::string text = out.text();
  EXPECT_EQ(out.error_count(), 5) << text;
  EXPECT_NE(
      text.find(
          "unknown key 'finset' in [mesh]\n  --> --set:1:6\n   | mesh.finset=1mm\n   |      ^^^^^^\n   = "
          "help: did you mean 'finest'?"),
      std::string::npos)
      << text;
  EXPECT_NE(text.find("the case has no body 'flyr'\n  --> --set:2:6"), std::string::npos) << text;
  EXPECT_NE(text.find("'nonsense' sets nothing"), std::string::npos) << text;
  EXPECT_NE(text.find("'end' is a bare number, but needs a unit of [time]\n  --> --set:4:10"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("leads through a key that is not a table"), std::string::npos) << text;
}

/// A whole gauge, body or material may come from the command line; a key of one that is not there may not.
TEST(MistakesTogether, OfTheCommandLineThatAddsAGauge) {
  const auto said = [](const std::string& change) {
    Diagnostics out;
    Document doc = parse_document(with(0, ""), "case.toml", out);
    apply_overrides(doc, {change}, out);
    const std::size_t gauges = read_case(doc, out).gauges.size();
    return out.error_count() > 0 ? out.text() : std::to_string(gauges) + " gauges";
  };
  EXPECT_EQ(said(R"(gauge.new={kind="point",body="flyer",at={x="1 mm"}})"), "2 gauges");
  EXPECT_NE(said("gauge.new.kind=point").find("the case has no gauge 'new'"), std::string::npos);
  EXPECT_NE(said(R"(gauge.new={kind="point",body="flyer"})").find("'at' is missing in [gauge.new]"),
            std::string::npos);
}

TEST(MistakesTogether, OfTheCommandLineWhereACaseHasNoneOfAKind) {
  Diagnostics out;
  Document doc = parse_document("format = 1\n", "case.toml", out);
  apply_overrides(doc, {"gauge.rear.every=1us"}, out);
  EXPECT_NE(out.text().find("the case has no gauge 'rear'"), std::string::npos) << out.text();
  EXPECT_NE(out.text().find("it has none: write [gauge.rear] in the case file"), std::string::npos)
      << out.text();
}

}  // namespace
}  // namespace recoil::config::mistakes_test
