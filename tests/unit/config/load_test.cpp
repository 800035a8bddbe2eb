#include "config/section/load.hpp"

#include <gtest/gtest.h>

#include <string>

#include "config/document.hpp"
#include "config/read_case.hpp"

namespace recoil::config::load_test {
namespace {

constexpr const char* plate = R"(
[domain]
geometry = "1d"
x = ["0 mm", "10 mm"]
[mesh]
finest = "0.1 mm"
[time]
end = "1 us"
[body.plate]
material = "copper/ofhc-johnson-cook"
shape = { kind = "box", x = ["2 mm", "6 mm"] }
[body.wall]
rigid = true
shape = { kind = "box", x = ["7 mm", "8 mm"] }
[load.push]
)";

struct Read {
  Case contents;
  std::string said;
};

Read read(const std::string& load) {
  Diagnostics out;
  const Document document = parse_document(plate + load + "\n", "case.toml", out);
  Read r;
  r.contents = read_case(document, out);
  r.said = out.text();
  return r;
}

bool holds(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

TEST(Loads, AreFormulasQuantitiesOrHistories) {
  EXPECT_EQ(read("body = \"plate\"\npressure = \"2.5e-1 GPa\"").contents.loads[0].pressure, "2.5e-1*GPa");
  EXPECT_EQ(read("body = \"plate\"\npressure = \"2*GPa*exp(-t/us)*exp(-(x/mm)^2)\"").said, "");
  const Read history = read("body = \"plate\"\nhistory = [[\"0 us\", \"0 GPa\"], [\"1 us\", \"2 GPa\"]]");
  EXPECT_EQ(history.said, "");
  EXPECT_DOUBLE_EQ(history.contents.loads[0].history[1].pressure, 2e9);
}

TEST(Loads, SayWhatIsWrong) {
  const std::string on = "body = \"plate\"\n";
  EXPECT_TRUE(holds(read(on).said, "[load.push] has neither 'pressure' nor 'history'")) << read(on).said;
  const auto said = [&](const char* text) { return read(on + text).said; };
  EXPECT_TRUE(holds(said("pressure = \"2*GPa*exp(-t)\""), "exp needs a pure number"));
  EXPECT_TRUE(holds(said("pressure = \"2*GPa*exp(-t)\""), "exp(t/us)"));
  EXPECT_TRUE(holds(said("pressure = \"2*m/s\""), "is no pressure")) << said("pressure = \"2*m/s\"");
  EXPECT_TRUE(holds(said("pressure = \"2*bar\""), "knows no 'bar'")) << said("pressure = \"2*bar\"");
  EXPECT_TRUE(holds(said("pressure = \"1 GPa\"\npart = \"x\""), "is no pure number"));
  EXPECT_TRUE(holds(said("pressure = \"1 GPa\"\npart = \"x < 3\""), "x > 20*mm ? 1 : 0"));
  EXPECT_TRUE(holds(said("history = [[\"0 us\", \"1 GPa\"]]"), "needs a list of at least two times"));
  EXPECT_TRUE(holds(said("history = [[\"1 us\", \"1 GPa\"], [\"0 us\", \"1 GPa\"]]"), "do not grow"));
  EXPECT_TRUE(holds(said("history = [[\"0 us\", \"1 m/s\"], [\"1 us\", \"1 GPa\"]]"), "pressure"));
  EXPECT_TRUE(holds(read("body = \"wall\"\npressure = \"1 GPa\"").said, "'wall' is rigid"));
  EXPECT_TRUE(holds(read("body = \"plat\"\npressure = \"1 GPa\"").said, "did you mean 'plate'"));
}

}  // namespace
}  // namespace recoil::config::load_test
