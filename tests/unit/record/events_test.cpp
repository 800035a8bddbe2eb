#include "record/events.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace recoil::events_test {
namespace {

constexpr double dt = 1e-9;
constexpr int held = 20;  // steps

/// Two bodies of 2 and 8 kg and what happens to their contact, step by step.
struct Story {
  EventWatch watch;
  long step = 0;
  double impulse = 0, gap = 0;
  double touch_gap = 0;  // m, where they touch, at the start of the step

  explicit Story(config::Geometry g = config::Geometry::line,
                 ContactRule rule = {{held * dt}, 1e-6, 0, 0, {}})
      : watch({"flyer", "target"}, g, std::move(rule)) {
    watch.begin({sample(0)});
  }
  PairSample sample(double area) const {
    PairSample s;
    s.area = area;
    s.force = {area > 0 ? -1 / dt : 0, 0, 0};
    s.impulse = {impulse, 0, 0};
    s.place = {0.003 * area, 0, 0};
    s.smallest_gap = gap;
    s.gap = touch_gap * area;
    return s;
  }
  /// The flyer begins with 10 m/s. @param push impulse of each step; no force without area.
  void go(int steps, double area, double push = 1) {
    for (int n = 0; n < steps; ++n) {
      if (area > 0) impulse -= push;
      PairSample s = sample(area);
      s.force[0] *= push;
      watch.step(static_cast<double>(++step) * dt, dt, {s},
                 {{2, {20 + impulse, 0, 0}}, {8, {-impulse, 0, 0}}});
    }
  }
  PairStory end() {
    watch.finish();
    return watch.stories().front();
  }
  std::vector<std::string> kinds() const {
    std::vector<std::string> all;
    for (const Event& e : watch.events()) all.push_back(e.kind);
    return all;
  }
};

TEST(Events, ContactAndOpening) {
  Story s;
  s.go(5, 0);
  s.go(30, 1);
  s.go(held - 1, 0);
  EXPECT_EQ(s.kinds(), std::vector<std::string>{"contact"}) << "not yet believed";
  s.go(1, 0);
  ASSERT_EQ(s.kinds(), (std::vector<std::string>{"contact", "opening"}));
  const PairStory story = s.end();
  EXPECT_NEAR(story.made, 5 * dt, 1e-15);
  EXPECT_NEAR(story.opens, 35 * dt, 1e-15) << "the end of the last step in contact";
  EXPECT_FALSE(story.recloses);
  EXPECT_TRUE(std::isnan(story.separates)) << "the gap has stayed closed";
  EXPECT_NEAR(s.watch.events()[1].place.at(0), 0.003, 1e-15);
  EXPECT_EQ(s.watch.events()[1].detail, "flyer -5 m/s, target 3.75 m/s");
}

TEST(Events, FlickerIsOneContact) {
  Story s;
  s.go(10, 1);
  for (int n = 0; n < 6; ++n) {
    s.go(held - 1, 0);
    s.go(1, 1);
  }
  EXPECT_TRUE(std::isnan(s.watch.stories()[0].opens));
  s.go(3, 0);
  const PairStory story = s.end();
  EXPECT_NEAR(story.opens, (10 + 6 * held) * dt, 1e-15) << "the end of the run believes the rest";
  EXPECT_FALSE(story.recloses);
}

TEST(Events, AGluedPairIsInContactWhileItHasArea) {
  Story s(config::Geometry::line, {{held * dt}, 1e-6, 0, 0, {true}});
  s.go(10, 1);
  s.go(3 * held, 1, 0);
  EXPECT_EQ(s.kinds(), std::vector<std::string>{"contact"});
  s.go(held, 0);
  EXPECT_NEAR(s.end().opens, (10 + 3 * held) * dt, 1e-15);
}

TEST(Events, AContactAtAStandOffIsTimedByIt) {
  Story s(config::Geometry::line, {{held * dt}, 1e-6, 5e-8, 0.5, {}});
  for (int n = 0; n < 4; ++n) {
    s.gap = 8.7e-8 - n * 1e-8;  // 10 m/s
    s.go(1, 0);
  }
  s.gap = 4.7e-8;
  s.touch_gap = 5.2e-8;  // of the middle of the step
  s.go(1, 1);
  EXPECT_NEAR(s.end().made, (1 + 3.7) * dt, 1e-14);
}

TEST(Events, ReclosureAcrossAGap) {
  Story s;
  s.go(3, 1);
  s.gap = 2e-6;
  s.go(held + 1, 0);
  s.gap = 0;
  s.go(1, 1);
  EXPECT_TRUE(s.watch.stories()[0].recloses);
  s.go(held, 0);
  const PairStory story = s.end();
  EXPECT_NEAR(story.opens, 3 * dt, 1e-15) << "the first opening";
  EXPECT_NEAR(story.separates, 3.5 * dt, 1e-15) << "from 0 to 2 um in that step";
  EXPECT_NEAR(story.closes_again, (4 + held) * dt, dt);
  EXPECT_NEAR(story.opens_again, (5 + held) * dt, 1e-15);
  EXPECT_EQ(s.kinds(),
            (std::vector<std::string>{"contact", "opening", "separation", "reclosure", "opening"}));
}

TEST(Events, BodiesThatFlyOnInTouchDoNotRecloseAtEachKnock) {
  Story s;
  s.go(10, 1);
  for (int n = 0; n < 40; ++n) {
    s.go(held + 5, 0);
    s.go(3, 1);
  }
  EXPECT_EQ(s.kinds(), (std::vector<std::string>{"contact", "opening"}));
  EXPECT_NEAR(s.end().opens, 10 * dt, 1e-15);

  Story pressed;
  pressed.go(10, 1);
  pressed.go(held + 5, 0);
  pressed.go(held + 1, 1);  // in touch all the time, but pressed for the hold time
  EXPECT_TRUE(pressed.end().recloses);
  EXPECT_NEAR(pressed.watch.stories()[0].closes_again, (10 + held + 5) * dt, 1e-15);
}

TEST(Events, AShrinkingContactLastsToTheEndOfItsForce) {
  Story s(config::Geometry::planar);
  s.go(5, 1e-3);
  s.go(5, 4e-3);
  s.go(40, 1e-4, 2e-3);
  EXPECT_TRUE(std::isnan(s.watch.stories()[0].opens)) << "two thousandths of the force are a force";
  s.go(40, 1e-4, 1e-4);
  EXPECT_NEAR(s.watch.stories()[0].opens, 50 * dt, 1e-15) << "a ten-thousandth is none";
  EXPECT_EQ(s.kinds(), (std::vector<std::string>{"contact", "opening"}));
}

TEST(Events, FirstTouchFollowsFromTheGapAndItsRate) {
  Story s;
  s.gap = 10e-6;
  s.go(1, 0);
  s.gap = 7e-6;
  s.go(1, 0);
  s.gap = 4e-6;
  s.go(1, 0);
  s.gap = 1e-6;  // 3 um in each step: a third of the next is left
  s.go(1, 0);
  s.gap = 0;
  s.touch_gap = 1e-6;
  s.go(1, 1);
  EXPECT_NEAR(s.end().made, (4 + 1.0 / 3) * dt, 1e-15);
  EXPECT_NEAR(s.watch.events()[0].time, (4 + 1.0 / 3) * dt, 1e-15);
  EXPECT_EQ(s.watch.events()[0].detail, "flyer 10 m/s, target 0 m/s") << "before the first impulse";
}

TEST(Events, ATipTouchesWhereItIsAndNotAtTheCentresOfCells) {
  Story s;
  for (const double gap : {6e-6, 5e-6, 4e-6}) {  // of the centres of cells, 3.7 um too wide
    s.gap = gap;
    s.go(1, 0);
  }
  s.touch_gap = 0.3e-6;
  s.go(1, 1);
  EXPECT_NEAR(s.end().made, 3.3 * dt, 1e-15);
}

TEST(Events, TouchInTheFirstStepFollowsFromTheVelocities) {
  EventWatch watch({"flyer", "target"}, config::Geometry::line, {{held * dt}, 1e-6});
  PairSample s;
  s.smallest_gap = 4e-9;
  watch.begin({s});
  s.gap = 4e-9;  // at 10 m/s: 0.4 steps
  s.area = 1, s.force = {-1, 0, 0}, s.impulse = {-1, 0, 0}, s.smallest_gap = 0;
  watch.step(dt, dt, {s}, {{2, {19, 0, 0}}, {8, {1, 0, 0}}});
  EXPECT_NEAR(watch.stories()[0].made, 0.4 * dt, 1e-15);
}

TEST(Events, VelocitiesNameTheirAxes) {
  Story plane(config::Geometry::planar), ring(config::Geometry::axisymmetric);
  plane.go(1, 1);
  ring.go(1, 1);
  EXPECT_EQ(plane.watch.events()[0].detail, "flyer x 10 y 0 m/s, target x 0 y 0 m/s");
  EXPECT_EQ(ring.watch.events()[0].detail, "flyer z 0 m/s, target z 0 m/s") << "none along r";
}

TEST(Events, RicochetIsAReversal) {
  Story back;
  back.go(30, 1);  // 10 m/s forwards, 30 kg m/s backwards: -5 m/s
  back.go(30, 0);
  back.end();
  ASSERT_EQ(back.kinds(), (std::vector<std::string>{"contact", "opening", "ricochet"}));
  EXPECT_EQ(back.watch.events()[2].detail,
            "flyer: 10 m/s before, -5 m/s after; along the impulse 10 m/s towards target, then 5 m/s away");

  // From 10 m/s to -5 m/s, and the target of four times the mass to 3.75 m/s.
  EXPECT_NEAR(back.watch.stories()[0].restitution, (3.75 + 5) / 10, 1e-12);

  Story slowed;
  slowed.go(10, 1);  // still 5 m/s forwards
  slowed.go(30, 0);
  slowed.end();
  EXPECT_EQ(slowed.kinds(), (std::vector<std::string>{"contact", "opening"}));
}

TEST(Events, WhatPushesAfterTheOpeningDoesNotCount) {
  EventWatch watch({"flyer", "target", "other"}, config::Geometry::line,
                   {{held * dt, held * dt, held * dt}, 1e-6});
  double first = 0, second = 0;
  for (int n = 1; n <= 60; ++n) {
    std::vector<PairSample> s(3);  // flyer-target, flyer-other, target-other
    if (n <= 30) first -= 1, s[0].area = 1, s[0].force = {-1, 0, 0};
    if (n > 30) second += 1, s[1].area = 1, s[1].force = {1, 0, 0};
    s[0].impulse = {first, 0, 0}, s[1].impulse = {second, 0, 0};
    watch.step(n * dt, dt, s, {{2, {20 + first + second, 0, 0}}, {8, {-first, 0, 0}}, {1, {-second, 0, 0}}});
  }
  EXPECT_NEAR(watch.stories()[0].restitution, (3.75 + 5) / 10, 1e-12);
}

TEST(Events, RestitutionAgainstAMovingWall) {
  EventWatch watch({"wall", "ball"}, config::Geometry::line, {{held * dt}, 1e-6});
  for (int n = 1; n <= 60; ++n) {
    PairSample s;
    s.area = n <= 30 ? 1 : 0;
    s.force = {-s.area, 0, 0};
    s.impulse = {-std::min(n, 30) * 1.0, 0,
                 0};  // on the wall; the ball comes with -4 m/s and leaves at 6 m/s
    watch.step(n * dt, dt, {s}, {{0, {}, {2, 0, 0}}, {3, {-12 - s.impulse[0], 0, 0}, {}}});
  }
  EXPECT_NEAR(watch.stories()[0].restitution, 4.0 / 6, 1e-12);
}

TEST(Events, NewsComeOnceAndLiftOffTwice) {
  Story s(config::Geometry::planar);
  s.go(10, 1);
  EXPECT_EQ(s.watch.take_news().size(), 1U);
  EXPECT_TRUE(s.watch.take_news().empty());
  for (int n = 3; n < 8; ++n) s.watch.lift_off(0, n * dt, {0.001 * n, 0});
  EXPECT_EQ(s.watch.take_news().size(), 1U);
  const PairStory story = s.end();
  EXPECT_NEAR(story.lift_first, 3 * dt, 1e-15);
  EXPECT_NEAR(story.lift_last, 7 * dt, 1e-15);
  EXPECT_EQ(s.kinds(), (std::vector<std::string>{"contact", "lift-off", "lift-off"}));
  EXPECT_NEAR(s.watch.events()[2].place.at(0), 0.007, 1e-15);
}

}  // namespace
}  // namespace recoil::events_test
