#include "format/csv.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "../support/scratch_folder.hpp"
#include "core/error.hpp"

namespace recoil::csv_test {
namespace {

std::string contents(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void put(const std::filesystem::path& path, const std::string& text) { std::ofstream(path) << text; }

/// The message of the InputError that `call` throws.
template <class Call>
std::string input_error(const Call& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no InputError";
}

TEST(Csv, NumbersComeBackToTheBit) {
  const ScratchFolder folder;
  const std::vector<double> numbers{0.1, 1.0 / 3.0, -2.5e-300, 6.02214076e23, std::nextafter(1.0, 2.0),
                                    0.0, 450,       -1e22,     5e-324,        1.7976931348623157e308};
  {
    CsvWriter csv(folder / "gauge.csv", {"time [us]", "velocity [m/s]"}, {"gauge rear", "at r = 10 mm"});
    for (const double v : numbers) csv.row(std::vector<double>{v, -v});
  }
  const auto table = read_csv(folder / "gauge.csv");
  EXPECT_EQ(table.columns, (std::vector<std::string>{"time [us]", "velocity [m/s]"}));
  EXPECT_EQ(table.comments, (std::vector<std::string>{"gauge rear", "at r = 10 mm"}));
  EXPECT_EQ(table.numbers("time [us]"), numbers);
  EXPECT_EQ(table.numbers("time"), numbers);
  EXPECT_EQ(table.unit("velocity"), "m/s");
  EXPECT_TRUE(table.has("velocity"));
  EXPECT_FALSE(table.has("velo"));
}

TEST(Csv, HeaderIsOneLineAfterTheComments) {
  const ScratchFolder folder;
  CsvWriter csv(folder / "a.csv", {"time [us]", "p [GPa]"}, {"note"});
  csv.row(std::vector<double>{0.5, 2});
  csv.flush();
  EXPECT_EQ(contents(folder / "a.csv"), "# note\ntime [us],p [GPa]\n0.5,2\n");
}

TEST(Csv, TextsMayHoldCommasAndQuotes) {
  const ScratchFolder folder;
  const std::string text = "opening, \"wide\" #1";
  CsvWriter csv(folder / "events.csv", {"time [us]", "event", "bodies"});
  csv.row({0.697, text, std::string("flyer-target")});
  csv.flush();
  const auto table = read_csv(folder / "events.csv");
  EXPECT_EQ(table.texts("event"), std::vector<std::string>{text});
  EXPECT_EQ(table.texts("bodies"), std::vector<std::string>{"flyer-target"});
  EXPECT_EQ(table.numbers("time"), std::vector<double>{0.697});
}

TEST(Csv, NotANumberAndInfinityAreReadAsSuch) {
  const ScratchFolder folder;
  CsvWriter csv(folder / "a.csv", {"v"});
  csv.row(std::vector<double>{std::numeric_limits<double>::quiet_NaN()});
  csv.row(std::vector<double>{-std::numeric_limits<double>::infinity()});
  csv.flush();
  const auto v = read_csv(folder / "a.csv").numbers("v");
  EXPECT_TRUE(std::isnan(v.at(0)));
  EXPECT_EQ(v.at(1), -std::numeric_limits<double>::infinity());
}

TEST(Csv, AppendGoesOnAfterTheLastCompleteRow) {
  const ScratchFolder folder;
  put(folder / "a.csv", "t [us],v\n1,10\n2,2");  // the second row was cut by a crash
  {
    CsvWriter csv(folder / "a.csv", {"t [us]", "v"}, {"not again"}, CsvMode::append);
    csv.row(std::vector<double>{2, 20});
  }
  EXPECT_EQ(contents(folder / "a.csv"), "t [us],v\n1,10\n2,20\n");
  EXPECT_THROW(CsvWriter(folder / "a.csv", {"t [ms]", "v"}, {}, CsvMode::append), InputError);
  CsvWriter fresh(folder / "b.csv", {"t"}, {"c"}, CsvMode::append);
  EXPECT_EQ(contents(folder / "b.csv"), "# c\nt\n");
}

TEST(Csv, TruncationKeepsRowsUpToTheTimeAndTheComments) {
  const ScratchFolder folder;
  put(folder / "a.csv", "# c\nt [us],v\n0,1\n0.5,2\n# in between\n1,3\n1.5,4\n2,");
  truncate_csv(folder / "a.csv", 1.0);
  EXPECT_EQ(contents(folder / "a.csv"), "# c\nt [us],v\n0,1\n0.5,2\n# in between\n1,3\n");
}

TEST(Csv, MistakesNameFileAndLine) {
  const ScratchFolder folder;
  const auto file = (folder / "a.csv").string();
  EXPECT_NE(input_error([&] { read_csv(file); }).find("a.csv"), std::string::npos);
  put(file, "# only a comment\n");
  EXPECT_NE(input_error([&] { read_csv(file); }).find("no header"), std::string::npos);
  put(file, "t,v\n1,2\n\n3\n");
  EXPECT_NE(input_error([&] { read_csv(file); }).find("a.csv:4"), std::string::npos);
  put(file, "t,v\r\n1,2\r\n 3 , four\r\n");
  const auto table = read_csv(file);
  EXPECT_EQ(table.numbers("t"), (std::vector<double>{1, 3}));
  EXPECT_NE(input_error([&] { table.numbers("v"); }).find("a.csv:3"), std::string::npos);
  EXPECT_NE(input_error([&] { table.numbers("w"); }).find("it has t, v"), std::string::npos);
}

TEST(Csv, AFullDiskIsAnError) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  EXPECT_THROW(CsvWriter("/dev/full", {"t"}), EnvironmentError);
}

RC_GTEST_PROP(CsvOfAnything, NumbersAndTextsComeBack, (const std::vector<double>& numbers)) {
  const ScratchFolder folder;
  const auto texts = *rc::gen::container<std::vector<std::string>>(
      numbers.size(), rc::gen::container<std::string>(rc::gen::inRange<char>(' ', '~')));
  {
    CsvWriter writer(folder / "a.csv", {"t [us]", "what"});
    for (std::size_t k = 0; k < numbers.size(); ++k) writer.row({numbers[k], "x" + texts[k] + "x"});
  }
  const CsvTable table = read_csv(folder / "a.csv");
  RC_ASSERT(table.numbers("t") == numbers);
  for (std::size_t k = 0; k < texts.size(); ++k) RC_ASSERT(table.texts("what")[k] == "x" + texts[k] + "x");
}

}  // namespace
}  // namespace recoil::csv_test
