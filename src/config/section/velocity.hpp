#pragma once

#include "config/declare/entry.hpp"

namespace recoil::config {

struct Body;

/// The declaration of Body::velocity: components, or a speed and a direction.
Custom<Body> custom_velocity();

}  // namespace recoil::config
