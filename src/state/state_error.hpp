#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"

namespace recoil {

/// A state of a body at a place, beyond what the equations admit.
struct StateError : PhysicsError {
  StateError(std::string of_body, std::vector<double> at, const std::string& text)
      : PhysicsError(text), body(std::move(of_body)), place(std::move(at)) {}

  std::string body;
  std::vector<double> place;  // m
};

}  // namespace recoil
