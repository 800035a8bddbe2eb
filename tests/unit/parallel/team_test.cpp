#include "parallel/team.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "core/error.hpp"

namespace recoil::parallel::team_test {
namespace {

struct Teams : testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Threads, Teams, testing::Values(1, 3));

TEST_P(Teams, EveryItemIsDoneOnce) {
  Team team(GetParam());
  EXPECT_EQ(team.threads(), GetParam());
  for (const int items : {0, 1, 3, 4, 5, 200}) {
    for (int round = 0; round < 20; ++round) {
      std::vector<std::atomic<int>> done(static_cast<std::size_t>(items));
      std::atomic<bool> stranger{false};
      team.run(items, [&](int item, int worker) {
        ++done[item];
        if (worker < 0 || worker >= team.threads()) stranger = true;
      });
      for (const auto& n : done) ASSERT_EQ(n, 1);
      ASSERT_FALSE(stranger);
    }
  }
}

TEST(Team, WhatAThreadIsLateWithIsDoneByTheOther) {
  Team team(2);
  std::atomic<int> others{0};
  const auto begun = std::chrono::steady_clock::now();
  team.run(20, [&](int item, int) {
    if (item != 0) ++others;
    while (item == 0 && others < 19 && std::chrono::steady_clock::now() - begun < std::chrono::seconds(20))
      std::this_thread::yield();
  });
  EXPECT_EQ(others, 19);
  EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(20)) << "items were waited for";
}

TEST_P(Teams, TheFailureOfTheLowestItemIsReported) {
  Team team(GetParam());
  for (int round = 0; round < 20; ++round) {
    std::atomic<int> done{0};
    try {
      team.run(50, [&](int item, int) {
        ++done;
        // The higher one fails first in time, where threads are several.
        if (item == 7) std::this_thread::sleep_for(std::chrono::microseconds(200));
        if (item == 7 || item == 9 || item == 40) throw std::runtime_error(std::to_string(item));
      });
      FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& e) {
      EXPECT_STREQ(e.what(), "7");
    }
    EXPECT_EQ(done, 50);
    done = 0;
    team.run(10, [&](int, int) { ++done; });  // the team goes on after a failure
    EXPECT_EQ(done, 10);
  }
}

TEST_P(Teams, EveryBlockStartsWithAnEmptyScratch) {
  Team team(GetParam());
  std::vector<int> blocks;
  for (int b = 0; b < 40; ++b) blocks.push_back(3 * b);
  std::vector<const void*> start(static_cast<std::size_t>(team.threads()));
  for (int w = 0; w < team.threads(); ++w) {
    const Scratch::Frame frame(team.scratch(w));
    start[w] = team.scratch(w).take<double>(100);
  }
  std::atomic<int> sum{0}, elsewhere{0};
  for_each_block(team, blocks, [&](int block, Scratch& scratch) {
    sum += block;
    const double* a = scratch.take<double>(100);
    bool known = false;
    for (int w = 0; w < team.threads(); ++w)
      if (&scratch == &team.scratch(w)) known = a == start[w];
    if (!known) ++elsewhere;
  });
  EXPECT_EQ(sum, 3 * 39 * 40 / 2);
  EXPECT_EQ(elsewhere, 0);
}

TEST(Team, HasAThread) { EXPECT_THROW(Team(0), InternalError); }

}  // namespace
}  // namespace recoil::parallel::team_test
