#include "parallel/exact_sums.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

namespace recoil::exact_sums_test {
namespace {

TEST(ExactSums, DoNotDependOnTheOrderOfAdding) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> wide(-1, 1);
  std::vector<double> values(200);
  for (double& v : values) v = wide(random) * std::pow(10, 12 * wide(random));
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), 0U);
  double first = 0;
  for (int round = 0; round < 5; ++round) {
    ExactSums sums;
    const int a = sums.item(1), b = sums.item(2, 1);
    for (const std::size_t n : order) {
      sums.add(a)[0] += values[n];
      const SumRow row = sums.add(b);
      row[1] += values[n];
      row.raise(2, values[n]);
    }
    sums.reduce(parallel::World{});
    if (round == 0) first = sums.total(a)[0];
    EXPECT_EQ(sums.total(a)[0], first);
    EXPECT_EQ(sums.total(b)[0], 0);
    EXPECT_EQ(sums.total(b)[1], first);
    EXPECT_EQ(sums.total(b)[2], *std::max_element(values.begin(), values.end()));
    std::shuffle(order.begin(), order.end(), random);
  }
}

TEST(ExactSums, KeepWhatPlainSummationLoses) {
  ExactSums sums;
  const int a = sums.item(1);
  const double terms[] = {1, 1e17, 1, -1e17};
  for (const double x : terms) sums.add(a)[0] += x;
  sums.reduce(parallel::World{});
  EXPECT_EQ(sums.total(a)[0], 2);
}

TEST(ExactSums, ForgetWhenCleared) {
  ExactSums sums;
  const int a = sums.item(1, 1), b = sums.item(1);
  sums.add(a)[0] += 3;
  sums.reduce(parallel::World{});
  EXPECT_TRUE(sums.any(a));
  EXPECT_FALSE(sums.any(b));
  sums.clear();
  sums.reduce(parallel::World{});
  EXPECT_FALSE(sums.any(a));
  EXPECT_EQ(sums.total(a)[0], 0);
  EXPECT_EQ(sums.total(a)[1], -std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace recoil::exact_sums_test
