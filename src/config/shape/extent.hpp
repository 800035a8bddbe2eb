#pragma once

#include <limits>

#include "config/section/domain.hpp"

namespace recoil::config {

/// The extent of a shape along each axis of the case, where its faces are at right angles to them.
struct Extent {
  bool plain = false;
  Vector lo{}, hi{};  // m
};

inline constexpr double endless = std::numeric_limits<double>::infinity();

}  // namespace recoil::config
