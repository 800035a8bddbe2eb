#include "app/sweep/swept_keys.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace recoil::app::swept_keys_test {
namespace {

SweptKey one(const std::string& text) {
  config::Diagnostics found;
  const std::vector<SweptKey> keys = read_swept_keys({text}, found);
  EXPECT_FALSE(found.has_errors()) << found.text();
  return keys.at(0);
}

std::string mistake(const std::vector<std::string>& texts) {
  config::Diagnostics found;
  read_swept_keys(texts, found);
  return found.text();
}

using Texts = std::vector<std::string>;
using Numbers = std::vector<double>;

TEST(SweptKeys, AListKeepsItsTextsAndKnowsItsNumbers) {
  const SweptKey key = one("mesh.finest = 0.2mm, 100 um");
  EXPECT_EQ(key.key, "mesh.finest");
  EXPECT_EQ(key.values, (Texts{"0.2mm", "100 um"}));
  ASSERT_EQ(key.numbers.size(), 2U);
  EXPECT_DOUBLE_EQ(key.numbers[1], 0.1);
  EXPECT_EQ(key.unit, "mm");
  EXPECT_TRUE(one("body.plate.material=copper/seed,steel/4340").numbers.empty());
  EXPECT_TRUE(one("a=1mm,2us").numbers.empty());
}

TEST(SweptKeys, ARangeIsEvenlySpaced) {
  const SweptKey key = one("body.rod.velocity.angle=-5deg:-30deg:6");
  EXPECT_TRUE(key.is_range);
  EXPECT_EQ(key.numbers, (Numbers{-5, -10, -15, -20, -25, -30}));
  EXPECT_EQ(key.values.back(), "-30 deg");
  EXPECT_EQ(one("v=1km/s:1500m/s:3").values, (Texts{"1 km/s", "1.25 km/s", "1.5 km/s"}));
  EXPECT_EQ(one("v=200m/s:800m/s").numbers, (Numbers{200, 800}));
  EXPECT_EQ(one("time.cfl=0.1:0.3:3").values, (Texts{"0.1", "0.2", "0.3"}));
}

TEST(SweptKeys, CommasInQuotesAndBracketsBelongToAValue) {
  EXPECT_EQ(one(R"(domain.x=["-8 mm", "22 mm"],["-9 mm", "22 mm"])").values,
            (Texts{R"(["-8 mm", "22 mm"])", R"(["-9 mm", "22 mm"])"}));
  EXPECT_EQ(one(R"(title="a, b: c")").values, (Texts{R"("a, b: c")"}));
  EXPECT_EQ(one("shape={ kind = 'box', x = ['0 mm', '1 mm'] }").values.size(), 1U);
}

TEST(SweptKeys, MistakesHaveAPlaceAndACure) {
  const std::vector<std::pair<Texts, const char*>> wrong{{{"mesh.finest"}, "--set:1:1"},
                                                         {{"a=1mm,,2mm"}, "--set:1:7"},
                                                         {{"a=1mm,1mm"}, "--set:1:7"},
                                                         {{"a=1mm:2us"}, "--set:1:7"},
                                                         {{"a=1mm:2mm:1"}, "--set:1:11"},
                                                         {{"a=1mm:2mm:1.5"}, "--set:1:11"},
                                                         {{"a=1mm:1mm:3"}, "--set:1:7"},
                                                         {{"a=x:y"}, "--set:1:3"},
                                                         {{"b=1", "a=1mm", "a=2mm"}, "--set:3:1"}};
  for (const auto& [texts, place] : wrong) {
    EXPECT_NE(mistake(texts).find(place), std::string::npos) << mistake(texts);
    EXPECT_NE(mistake(texts).find("= help: "), std::string::npos) << mistake(texts);
  }
}

TEST(SweptKeys, EveryCombinationOnceTheLastKeyFastest) {
  config::Diagnostics found;
  const auto keys = read_swept_keys({"a=1,2", "b=7", "c=3,4,5"}, found);
  const auto all = combinations_of(keys);
  ASSERT_EQ(all.size(), 6U);
  EXPECT_EQ(changes_of(keys, all[1]), (Texts{"a=1", "b=7", "c=4"}));
  EXPECT_EQ(changes_of(keys, all[5]), (Texts{"a=2", "b=7", "c=5"}));
  EXPECT_EQ(combinations_of({}).size(), 1U);
}

TEST(SweptKeys, NamesOfFoldersArePlainAndShort) {
  EXPECT_EQ(folder_name({"body.flyer.velocity.x=300 m/s", "mesh.finest=0.1mm"}),
            "body.flyer.velocity.x=300m_s,mesh.finest=0.1mm");
  EXPECT_EQ(folder_name({}), "run");
  const std::string a = folder_name({std::string(300, 'a') + "1"}),
                    b = folder_name({std::string(300, 'a') + "2"});
  EXPECT_LT(a.size(), 230U);
  EXPECT_NE(a, b);
}

}  // namespace
}  // namespace recoil::app::swept_keys_test
