#include <gtest/gtest.h>

#include "state/body.hpp"

namespace recoil {
namespace {

/// Blocks see their cells in an order that depends on their sizes.
TEST(FailureRecord, DoesNotDependOnTheOrderOfCells) {
  const Index<2> low{{9, 3}}, high{{2, 7}};
  FailureRecord<2> up, down;
  up.note(1e-6, low), up.note(1e-6, high), up.note(2e-6, {{0, 0}});
  down.note(1e-6, high), down.note(1e-6, low);
  EXPECT_EQ(up.cell, low);
  EXPECT_EQ(down.cell, low);
  EXPECT_EQ(down.time, 1e-6);
}

}  // namespace
}  // namespace recoil
