#include "parallel/chain.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace recoil::parallel::chain_test {
namespace {

/// Items in a line, each beside the ones before and behind it.
std::vector<std::vector<int>> line(int items) {
  std::vector<std::vector<int>> beside(static_cast<std::size_t>(items));
  for (int i = 0; i + 1 < items; ++i) {
    beside[static_cast<std::size_t>(i)].push_back(i + 1);
    beside[static_cast<std::size_t>(i) + 1].push_back(i);
  }
  return beside;
}

std::vector<std::size_t> alike(int items) {
  return std::vector<std::size_t>(static_cast<std::size_t>(items), 1);
}

struct Chains : testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Threads, Chains, testing::Values(1, 2, 3));

/// Each phase adds to an item what lies beside it, as sums of whole numbers: any other order shows.
TEST_P(Chains, GiveWhatPhasesOneAfterTheOtherGive) {
  using Value = std::uint64_t;
  Team team(GetParam());
  for (const int items : {1, 2, 5, 23}) {
    constexpr int phases = 9;
    const auto beside = line(items);
    std::vector<Value> expected(static_cast<std::size_t>(items));
    for (std::size_t i = 0; i < expected.size(); ++i) expected[i] = i * i + 1;
    std::vector<std::vector<Value>> values(2, expected);
    for (int phase = 0; phase < phases; ++phase) {
      std::vector<Value> next = expected;
      for (std::size_t i = 0; i < next.size(); ++i)
        for (const int b : beside[i]) next[i] = 3 * next[i] + expected[static_cast<std::size_t>(b)];
      expected = next;
    }
    Chain chain(team, beside, alike(items));
    for (int round = 0; round < 50; ++round) {
      for (std::size_t i = 0; i < expected.size(); ++i) values[0][i] = i * i + 1;
      chain.run(phases, [&](int item, int phase, int) {
        const auto i = static_cast<std::size_t>(item);
        const auto& from = values[static_cast<std::size_t>(phase % 2)];
        Value sum = from[i];
        for (const int b : beside[i]) sum = 3 * sum + from[static_cast<std::size_t>(b)];
        values[static_cast<std::size_t>((phase + 1) % 2)][i] = sum;
      });
      ASSERT_EQ(values[phases % 2], expected);
    }
  }
}

/// What the other has not begun because it is late, whoever has time does; only what is beside must wait.
TEST(Chain, OthersDoWhatAThreadIsLateWith) {
  constexpr int items = 12, phases = 3;
  Team team(2);
  Chain chain(team, line(items), alike(items));
  std::atomic<int> others{0};
  const auto begun = std::chrono::steady_clock::now();
  const auto late = [&] { return std::chrono::steady_clock::now() - begun < std::chrono::seconds(20); };
  // Item 0 in phase 0 holds item 1 up in phase 1, and that item 2 in phase 2.
  chain.run(phases, [&](int item, int phase, int) {
    if (item != 0) ++others;
    while (item == 0 && phase == 0 && others < 11 + 10 + 9 && late()) std::this_thread::yield();
  });
  EXPECT_EQ(others, 11 * phases);
  EXPECT_TRUE(late()) << "items were waited for that are not beside";
}

TEST_P(Chains, ReportTheEarliestFailureAndDoAllUpToIt) {
  constexpr int items = 20;
  Team team(GetParam());
  Chain chain(team, line(items), alike(items));
  for (int round = 0; round < 20; ++round) {
    std::vector<std::atomic<int>> done(4);  // by phase
    try {
      chain.run(4, [&](int item, int phase, int) {
        ++done[static_cast<std::size_t>(phase)];
        if (phase == 1 && item == 7) std::this_thread::sleep_for(std::chrono::microseconds(200));
        if ((phase == 1 && (item == 7 || item == 18)) || (phase == 2 && item == 1))
          throw std::runtime_error(std::to_string(phase) + ", " + std::to_string(item));
      });
      FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& e) {
      EXPECT_STREQ(e.what(), "1, 7");
    }
    EXPECT_EQ(done[0], items);
    EXPECT_EQ(done[1], items);
    std::atomic<int> after{0};
    chain.run(2, [&](int, int, int) { ++after; });  // the chain goes on after a failure
    EXPECT_EQ(after, 2 * items);
  }
}

TEST(Chain, ThreadsGetTheSameCost) {
  Team team(3);
  const Chain chain(team, line(6), {6, 1, 1, 4, 2, 4});
  EXPECT_EQ(chain.first_of(0), 0);
  EXPECT_EQ(chain.first_of(1), 1);
  EXPECT_EQ(chain.first_of(2), 4);
  EXPECT_EQ(chain.first_of(3), 6);
}

/// What must wait for something from elsewhere holds up those beside it alone, and these go on once it is
/// there: one thread that waits for a message computes whatever does not need it.
TEST(Chain, WhatWaitsForAMessageHoldsUpWhatIsBesideItAlone) {
  constexpr int items = 12, phases = 3, possible = 11 + 10 + 9;
  for (const int threads : {1, 2}) {
    Team team(threads);
    Chain chain(team, line(items), alike(items));
    std::atomic<int> others{0}, asked{0};
    const auto begun = std::chrono::steady_clock::now();
    const auto late = [&] { return std::chrono::steady_clock::now() - begun < std::chrono::seconds(20); };
    int before_the_message = -1;
    chain.run(
        phases,
        [&](int item, int phase, int) {
          if (item != 0) ++others;
          if (item == 0 && phase == 0) before_the_message = others;
        },
        [&](int item, int phase, int worker) {
          if (item != 0 || phase != 0) return true;
          if (worker != 0) return false;
          ++asked;
          return others >= possible || !late();
        });
    EXPECT_EQ(before_the_message, possible);
    EXPECT_EQ(others, 11 * phases);
    EXPECT_GT(asked, 1);
  }
}

/// Of what a thread may do it does first what others wait for.
TEST(Chain, UrgentItemsComeFirst) {
  constexpr int items = 6;
  Team team(1);
  const std::vector<std::vector<int>> beside(items);
  Chain chain(team, beside, alike(items), {0, 0, 0, 1, 0, 1});
  std::vector<int> order;
  chain.run(1, [&](int item, int, int) { order.push_back(item); });
  EXPECT_EQ(order, (std::vector<int>{3, 5, 0, 1, 2, 4}));
}

}  // namespace
}  // namespace recoil::parallel::chain_test
