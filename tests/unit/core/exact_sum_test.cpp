#include "core/exact_sum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "random.hpp"

namespace recoil {
namespace {

double sum_of(const std::vector<double>& terms) {
  ExactSum sum;
  for (const double x : terms) sum.add(x);
  return sum.value();
}

TEST(ExactSum, RoundsOnce) {
  const double tiny = std::ldexp(1, -60), half = std::ldexp(1, -53);
  EXPECT_EQ(sum_of({}), 0);
  EXPECT_EQ(sum_of({1e100, 1, -1e100}), 1);
  EXPECT_EQ(sum_of({1, half}), 1) << "a tie goes to the even one";
  EXPECT_EQ(sum_of({1, half, tiny}), 1 + 2 * half) << "and what is left over breaks it";
  EXPECT_EQ(sum_of({1, half, -tiny}), 1);
  EXPECT_EQ(sum_of({tiny, -1, -half}), -1) << "the same below zero";
  EXPECT_EQ(sum_of({-1, -half, -tiny}), -1 - 2 * half);
}

TEST(ExactSum, DoesNotDependOnTheOrder) {
  Random random(7);
  std::vector<double> terms;
  for (int k = 0; k < 300; ++k) terms.push_back(random(-1, 1) * std::pow(10, random(-20, 20)));
  const double wanted = sum_of(terms);
  for (int k = 0; k < 20; ++k) {
    for (std::size_t i = terms.size() - 1; i > 0; --i)
      std::swap(terms[i], terms[static_cast<std::size_t>(random(0, static_cast<double>(i)))]);
    EXPECT_EQ(sum_of(terms), wanted);
    const auto cut = terms.begin() + 100;
    ExactSum first, second;
    std::for_each(terms.begin(), cut, [&](double x) { first.add(x); });
    std::for_each(cut, terms.end(), [&](double x) { second.add(x); });
    second.add(first);
    EXPECT_EQ(second.value(), wanted) << "nor on how it is split";
  }
}

}  // namespace
}  // namespace recoil
