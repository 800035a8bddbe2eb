#include "record/resumed_table.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <fstream>
#include <iterator>
#include <string>

#include "../support/scratch_folder.hpp"
#include "core/error.hpp"

namespace recoil::resumed_table_test {
namespace {

class ResumedTable : public ::testing::Test {
 protected:
  const ScratchFolder folder;

  /// What is left of a table when a run goes on from the rows of 2 us, or the error.
  std::string cut(const std::string& text, std::size_t rows = 1) const {
    const auto path = folder / "history.csv";
    std::ofstream(path) << text;
    try {
      cut_back(path, 2e-6, rows);
    } catch (const InputError& error) {
      return error.what();
    }
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }
  bool lacks(const std::string& text, const std::string& what, std::size_t rows = 1) const {
    const std::string error = cut(text, rows);
    return error.find("rows are lost") != std::string::npos && error.find(what) != std::string::npos &&
           error.find("history.csv") != std::string::npos;
  }
};

TEST_F(ResumedTable, EndsWithTheRowsBeforeTheCheckpoint) {
  EXPECT_EQ(cut("time [us],v\n0,1\n2,3\n3,4\n4,"), "time [us],v\n0,1\n2,3\n");
  EXPECT_EQ(cut("time [us],v\n0,1\n2,3\n2,4\n3,4\n", 2), "time [us],v\n0,1\n2,3\n2,4\n");
}

TEST_F(ResumedTable, IsRefusedWithoutThem) {
  EXPECT_TRUE(lacks("time [us],v\n0,1\n1.5,3\n", "ends at 1.5 us"));
  EXPECT_TRUE(lacks("time [us],v\n0,1\n1.5,3\n2,", "ends at 1.5 us")) << "the last row is torn";
  EXPECT_TRUE(lacks("time [us],v\n", "holds no row"));
  EXPECT_TRUE(lacks("time [us],v\n0,1\n2,3\n", "holds 1 of 2 rows", 2));
  EXPECT_TRUE(lacks("time [us],v\n0,1\n1.5,3\n5,6\n", "ends at 1.5 us")) << "a hole in it";
}

}  // namespace
}  // namespace recoil::resumed_table_test
