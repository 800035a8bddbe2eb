#include "core/scratch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace recoil::scratch_test {
namespace {

bool aligned(const void* p) { return reinterpret_cast<std::uintptr_t>(p) % 64 == 0; }

TEST(Scratch, ArraysAreAlignedAndDoNotOverlap) {
  Scratch scratch;
  const Scratch::Frame frame(scratch);
  std::vector<std::pair<int*, std::size_t>> taken;
  for (const std::size_t n : {1U, 3U, 1000U, 17U, 400000U, 5U, 2000000U, 33U}) {
    int* a = scratch.take<int>(n);
    EXPECT_TRUE(aligned(a));
    std::iota(a, a + n, static_cast<int>(100000 * taken.size()));
    taken.emplace_back(a, n);
  }
  for (std::size_t k = 0; k < taken.size(); ++k)
    for (std::size_t i = 0; i < taken[k].second; ++i)
      ASSERT_EQ(taken[k].first[i], static_cast<int>(100000 * k + i));
}

TEST(Scratch, AFrameGivesBackWhatWasTakenInIt) {
  Scratch scratch;
  const Scratch::Frame outer(scratch);
  const double* kept = scratch.take_filled<double>(10, 1.5);
  const double* first = nullptr;
  {
    const Scratch::Frame inner(scratch);
    first = scratch.take<double>(10);
    EXPECT_NE(first, kept);
    const Scratch::Frame innermost(scratch);
    scratch.take_filled<double>(10, -1.0);
  }
  EXPECT_EQ(scratch.take<double>(10), first);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(kept[i], 1.5);
}

TEST(Scratch, GrowsAndThenReusesItsMemory) {
  Scratch scratch;
  const auto round = [&] {
    const Scratch::Frame frame(scratch);
    std::vector<const void*> places{scratch.take<char>(100)};
    {
      const Scratch::Frame large(scratch);
      places.push_back(scratch.take<char>(std::size_t{6} << 20));  // larger than a chunk
      places.push_back(scratch.take<char>(std::size_t{3} << 20));
      places.push_back(scratch.take<char>(std::size_t{3} << 20));
    }
    places.push_back(scratch.take<char>(100));
    return places;
  };
  const auto once = round();
  EXPECT_EQ(round(), once);
  for (const void* p : once) EXPECT_TRUE(aligned(p));
}

TEST(Scratch, FillsEveryValue) {
  Scratch scratch;
  const int* a = scratch.take_filled<int>(777, 42);
  EXPECT_EQ(std::count(a, a + 777, 42), 777);
}

}  // namespace
}  // namespace recoil::scratch_test
