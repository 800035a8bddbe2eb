#include "record/events.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace recoil {
namespace {

constexpr double dt = 1e-9;

/// Two bodies and what happens to their contact, step by step.
struct Story {
  EventWatch watch;
  long step = 0;
  double impulse = 0;

  explicit Story(config::Geometry g = config::Geometry::line) : watch({"flyer", "target"}, g) {
    watch.begin({{2, {20, 0, 0}}, {8, {0, 0, 0}}});
  }
  void go(int steps, double area) {
    for (int n = 0; n < steps; ++n) {
      PairSample s;
      s.area = area;
      if (area > 0) impulse -= 1;  // on the flyer, each step
      s.impulse = {impulse, 0, 0};
      s.place = {0.003 * area, 0, 0};
      watch.step(static_cast<double>(++step) * dt, dt, {s});
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
  s.go(opening_steps - 1, 0);
  EXPECT_EQ(s.kinds(), std::vector<std::string>{"contact"}) << "not yet believed";
  s.go(1, 0);
  ASSERT_EQ(s.kinds(), (std::vector<std::string>{"contact", "opening"}));
  const PairStory story = s.end();
  EXPECT_NEAR(story.made, 5 * dt, 1e-15);
  EXPECT_NEAR(story.opens, 35 * dt, 1e-15) << "the end of the last step in contact";
  EXPECT_FALSE(story.recloses);
  EXPECT_NEAR(s.watch.events()[1].place.at(0), 0.003, 1e-15);
  EXPECT_EQ(s.watch.events()[1].detail, "flyer -5 m/s, target 3.75 m/s");
}

TEST(Events, FlickerIsOneContact) {
  Story s;
  s.go(10, 1);
  for (int n = 0; n < 6; ++n) {
    s.go(opening_steps - 1, 0);
    s.go(1, 1);
  }
  EXPECT_TRUE(std::isnan(s.watch.stories()[0].opens));
  s.go(3, 0);
  const PairStory story = s.end();
  EXPECT_NEAR(story.opens, (10 + 6 * opening_steps) * dt, 1e-15) << "the end of the run believes the rest";
  EXPECT_FALSE(story.recloses);
}

TEST(Events, Reclosure) {
  Story s;
  s.go(3, 1);
  s.go(opening_steps, 0);
  s.go(1, 1);
  EXPECT_TRUE(s.watch.stories()[0].recloses);
  s.go(opening_steps, 0);
  const PairStory story = s.end();
  EXPECT_NEAR(story.opens, 3 * dt, 1e-15) << "the first opening";
  EXPECT_NEAR(story.closes_again, (3 + opening_steps) * dt, 1e-15);
  EXPECT_NEAR(story.opens_again, (4 + opening_steps) * dt, 1e-15);
  EXPECT_EQ(s.kinds(), (std::vector<std::string>{"contact", "opening", "reclosure", "opening"}));
}

TEST(Events, InThePlaneHalfTheAreaDecides) {
  Story s(config::Geometry::planar);
  s.go(5, 1e-3);
  s.go(5, 4e-3);
  s.go(40, 2.1e-3);
  EXPECT_TRUE(std::isnan(s.watch.stories()[0].opens));
  s.go(40, 1.9e-3);
  EXPECT_NEAR(s.watch.stories()[0].opens, 50 * dt, 1e-15);
  s.go(40, 1.99e-3);
  EXPECT_FALSE(s.watch.stories()[0].recloses);
  s.go(1, 2e-3);
  EXPECT_TRUE(s.watch.stories()[0].recloses);
}

TEST(Events, RicochetIsAReversal) {
  Story back;
  back.go(30, 1);  // 10 m/s forwards, 30 kg m/s backwards: -5 m/s
  back.go(30, 0);
  back.end();
  ASSERT_EQ(back.kinds(), (std::vector<std::string>{"contact", "opening", "ricochet"}));
  EXPECT_EQ(back.watch.events()[2].detail.find("flyer: 10 m/s towards target before, 5 m/s away"), 0U)
      << back.watch.events()[2].detail;

  // From 10 m/s to -5 m/s, and the target of four times the mass to 3.75 m/s.
  EXPECT_NEAR(back.watch.stories()[0].restitution, (3.75 + 5) / 10, 1e-12);

  Story slowed;
  slowed.go(10, 1);  // still 5 m/s forwards
  slowed.go(30, 0);
  slowed.end();
  EXPECT_EQ(slowed.kinds(), (std::vector<std::string>{"contact", "opening"}));
}

TEST(Events, RestitutionAgainstAMovingWall) {
  EventWatch watch({"wall", "ball"}, config::Geometry::line);
  watch.begin({{0, {}, {2, 0, 0}}, {3, {-12, 0, 0}, {}}});  // -4 m/s towards 2 m/s
  for (int n = 1; n <= 60; ++n) {
    PairSample s;
    s.area = n <= 30 ? 1 : 0;
    s.impulse = {-std::min(n, 30) * 1.0, 0, 0};  // on the wall; the ball leaves at 6 m/s
    watch.step(n * dt, dt, {s});
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
}  // namespace recoil
