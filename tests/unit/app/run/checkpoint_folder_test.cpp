#include "app/run/checkpoint_folder.hpp"

#include <gtest/gtest.h>

#include <string>

namespace recoil::app::checkpoint_folder_test {
namespace {

CheckpointText text_with(const std::string& version, const std::string& finest) {
  CheckpointText t;
  t.version = version;
  t.keys = {{"mesh.finest", finest}, {"time.end", "1 us"}};
  return t;
}

TEST(Refusal, NamesWhatHasChanged) {
  const CheckpointText then = text_with("1", "0.1 mm");
  CheckpointText longer = then;
  longer.keys["time.end"] = "2 us";
  EXPECT_EQ(refusal(then, longer), "");
  const std::string why = refusal(then, text_with("1", "0.2 mm"));
  EXPECT_NE(why.find("other values of mesh.finest\n"), std::string::npos) << why;
  EXPECT_EQ(why.find("recoil 1"), std::string::npos) << why;
}

/// A newer version may have a key more, which is no change that the user has made.
TEST(Refusal, OfAnotherVersionSaysSo) {
  CheckpointText now = text_with("2", "0.1 mm");
  now.keys["limits.new"] = "0";
  const std::string why = refusal(text_with("1", "0.1 mm"), now);
  EXPECT_NE(why.find("the checkpoint is of recoil 1, this is 2"), std::string::npos) << why;
}

}  // namespace
}  // namespace recoil::app::checkpoint_folder_test
