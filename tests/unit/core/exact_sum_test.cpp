#include "core/exact_sum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/exact_batch.hpp"
#include "random.hpp"

namespace recoil::exact_sum_test {
namespace {

double sum_of(const std::vector<double>& terms) {
  ExactSum sum;
  for (const double x : terms) sum += x;
  return sum.value();
}

TEST(ExactSum, RoundsOnce) {
  const double tiny = std::ldexp(1, -60), half = std::ldexp(1, -53);
  EXPECT_EQ(sum_of({}), 0);
  EXPECT_EQ(sum_of({1e28, 1, -1e28}), 1);
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
    std::for_each(terms.begin(), cut, [&](double x) { first += x; });
    std::for_each(cut, terms.end(), [&](double x) { second += x; });
    second += first;
    EXPECT_EQ(second.value(), wanted) << "nor on how it is split";
  }
}

TEST(ExactSum, TakesAway) {
  ExactSum sum, other;
  sum += 3.25, other += 1e20, other += -7;
  sum -= other;
  EXPECT_EQ(sum.value(), 10.25 - 1e20);
  sum += other, sum -= 3.25;
  EXPECT_TRUE(sum.is_zero());
}

TEST(ExactSum, SaysWhatItCannotHold) {
  const double least = std::ldexp(1, -160), most = std::ldexp(1, 94);
  EXPECT_EQ(sum_of({least, -1, 1}), least);
  EXPECT_EQ(sum_of({0.75 * least, least}), least) << "what is below the last digit is cut off";
  EXPECT_EQ(sum_of({1.5 * most, -most}), 0.5 * most);
  for (const double x : {2 * most, -2 * most, std::numeric_limits<double>::infinity(),
                         std::numeric_limits<double>::quiet_NaN()})
    EXPECT_TRUE(std::isnan(sum_of({1, x, -x, 2}))) << x;
  EXPECT_TRUE(std::isnan(sum_of({1.5 * most, 1.5 * most, -1.5 * most}))) << "nor a sum beyond its range";
  EXPECT_TRUE(std::isnan(sum_of({-1.5 * most, -1.5 * most, 1.5 * most})));
}

TEST(ExactSum, AddsUpByDigits) {
  Random random(11);
  for (int round = 0; round < 200; ++round) {
    std::array<std::int64_t, ExactSum::digits> digits{};
    ExactSum all;
    for (int rank = 0; rank < 9; ++rank) {
      ExactSum own;
      for (int k = 0; k < 4; ++k) own += random(-1, 1) * std::pow(10, random(-30, 25));
      own.add_to(digits);
      all += own;
    }
    EXPECT_EQ(ExactSum::from(digits).value(), all.value());
  }
}

/// The same digits as one by one, whatever the sizes of the terms: alike, spread, cancelling, out of range.
TEST(ExactSum, ManyAtATime) {
  Random random(11);
  for (int round = 0; round < 300; ++round) {
    const double spread = random(0, 60);
    std::vector<double> terms;
    for (int k = 0; k < 1 + 7 * (round % 140); ++k) {
      const double x = random(-1, 1) * std::pow(10, random(-spread, spread > 25 ? 25 : spread));
      terms.push_back(k % 11 == 3 ? 0 : k % 17 == 5 && k > 5 ? -terms[static_cast<std::size_t>(k - 1)] : x);
    }
    ExactSum one_by_one, together;
    for (const double x : terms) one_by_one += x;
    add_all(terms, together);
    together -= one_by_one;
    ASSERT_TRUE(together.is_zero()) << "round " << round;
  }
  ExactSum lost;
  std::vector<double> terms = {1, std::numeric_limits<double>::quiet_NaN(), 2};
  add_all(terms, lost);
  EXPECT_TRUE(lost.is_lost());
}

}  // namespace
}  // namespace recoil::exact_sum_test
