#include "config/diagnostics.hpp"

#include <gtest/gtest.h>

#include <string>

#include "core/error.hpp"

namespace recoil::config::diagnostics_test {
namespace {

TEST(Diagnostics, ShowsTheLineACaretAndTheCure) {
  Diagnostics d;
  d.source("flyer.toml", "[body.flyer]\nvelocty = { z = \"450 m/s\" }\n");
  d.error({"flyer.toml", 2, 1, 7}, "unknown key 'velocty' in [body.flyer]", "did you mean 'velocity'?");
  EXPECT_EQ(d.text(),
            "error: unknown key 'velocty' in [body.flyer]\n"
            "  --> flyer.toml:2:1\n"
            "   | velocty = { z = \"450 m/s\" }\n"
            "   | ^^^^^^^\n"
            "   = help: did you mean 'velocity'?\n");
}

TEST(Diagnostics, CountsCharactersNotBytesAndKeepsTabs) {
  Diagnostics d;
  d.source("a", "\té = 5\r\n");
  d.error({"a", 1, 6, 1}, "m");
  EXPECT_EQ(d.text(), "error: m\n  --> a:1:6\n   | \té = 5\n   | \t    ^\n");
}

/// A binary file must not write to the terminal what that obeys.
TEST(Diagnostics, ShowsNoControlCharacters) {
  Diagnostics d;
  d.source("a", "\x1b[31mE\xff\x80\xc3(=\xc3\xa9\x07");
  d.error({"a", 1, 9, 1}, "m");
  EXPECT_EQ(d.text(),
            "error: m\n  --> a:1:9\n   | ?[31mE?"
            "?(=\u00e9?\n   |         ^\n");
}

TEST(Diagnostics, OfLongLinesShowsWhatIsAroundTheMistake) {
  Diagnostics d;
  d.source("a", std::string(500, 'x') + "!" + std::string(500, 'y'));
  d.error({"a", 1, 501, 1}, "m");
  EXPECT_EQ(d.text(), "error: m\n  --> a:1:501\n   | \u2026" + std::string(80, 'x') + "!" +
                          std::string(119, 'y') + "\u2026\n   | " + std::string(81, ' ') + "^\n");
}

TEST(Diagnostics, PutsMessagesInTheOrderOfTheText) {
  Diagnostics d;
  d.error({"a", 9, 1, 1}, "late");
  d.error({"a", 2, 5, 1}, "early");
  EXPECT_LT(d.text().find("early"), d.text().find("late"));
}

TEST(Diagnostics, ReachesNoFurtherThanTheText) {
  Diagnostics d;
  d.source("a", "x");
  d.error({"a", 7, 3, 2}, "beyond the end");
  d.error({"a", 1, 40, 500}, "beyond the line");
  d.error({"", 0, 0, 1}, "nowhere");
  EXPECT_EQ(d.error_count(), 3);
  EXPECT_NE(d.text().find("error: nowhere\n"), std::string::npos);
}

TEST(Diagnostics, TheSameMistakeIsListedOnce) {
  Diagnostics d;
  for (int times = 0; times < 2; ++times) {
    d.error({"a", 3, 1, 1}, "wrong");
    d.warning({"a", 3, 1, 1}, "wrong");
  }
  d.error({"a", 4, 1, 1}, "wrong");
  EXPECT_EQ(d.list().size(), 3U);
  EXPECT_EQ(d.error_count(), 3);
}

TEST(Diagnostics, TakesWhatWasThrownApart) {
  Diagnostics d;
  d.error({"a"}, InputError("error: wrong\n   = help: turn it round"));
  d.error({"a"}, InputError("without a cure"));
  EXPECT_EQ(d.list().at(0).message, "wrong");
  EXPECT_EQ(d.list().at(0).help, "turn it round");
  EXPECT_EQ(d.list().at(1).message, "without a cure");
  EXPECT_EQ(d.list().at(1).help, "");
}

TEST(Diagnostics, WarningsAreNoErrors) {
  Diagnostics d;
  d.warning({"a", 1, 1, 1}, "unlikely");
  EXPECT_FALSE(d.has_errors());
  EXPECT_NO_THROW(d.throw_if_errors());
  d.error({"a", 1, 1, 1}, "wrong");
  EXPECT_THROW(d.throw_if_errors(), InputError);
}

}  // namespace
}  // namespace recoil::config::diagnostics_test
