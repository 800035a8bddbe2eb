#pragma once

#include <gtest/gtest.h>

#include <type_traits>

namespace recoil {

/// For TYPED_TEST_SUITE: a suite that runs in one, two and three dimensions.
using Dimensions = testing::Types<std::integral_constant<int, 1>, std::integral_constant<int, 2>,
                                  std::integral_constant<int, 3>>;

/// For what has no meaning on a line.
using PlaneAndSpace = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

}  // namespace recoil
