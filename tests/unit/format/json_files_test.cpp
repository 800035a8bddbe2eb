#include "format/json_files.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "../support/scratch_folder.hpp"
#include "core/error.hpp"

namespace recoil::json_files_test {
namespace {

std::string contents(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

TEST(JsonFiles, ReplacesTheWholeFileAndLeavesNothingElse) {
  const ScratchFolder folder;
  write_atomically(folder / "status.json", std::string(100000, 'x'));
  write_atomically(folder / "status.json", "{\"step\": 7}\n");
  EXPECT_EQ(contents(folder / "status.json"), "{\"step\": 7}\n");
  const auto files = std::filesystem::directory_iterator(folder.path());
  EXPECT_EQ(std::distance(begin(files), end(files)), 1);
}

TEST(JsonFiles, SaysWhyAFileCannotBeWritten) {
  const ScratchFolder folder;
  try {
    write_atomically(folder / "missing" / "status.json", "{}");
    FAIL() << "no error";
  } catch (const EnvironmentError& error) {
    EXPECT_NE(std::string(error.what()).find("No such file"), std::string::npos) << error.what();
  }
  std::filesystem::create_directory(folder / "taken");
  EXPECT_THROW(write_atomically(folder / "taken", "{}"), EnvironmentError);
  const auto files = std::filesystem::directory_iterator(folder.path());
  EXPECT_EQ(std::distance(begin(files), end(files)), 1) << "the temporary file stayed";
}

}  // namespace
}  // namespace recoil::json_files_test
