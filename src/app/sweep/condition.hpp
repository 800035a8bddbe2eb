#pragma once

#include <string>

#include "app/run/run_quantities.hpp"

namespace recoil::app {

/// What --find asks of a run: "body.plate.failed-mass > 0", or a flag alone, "event.ricochet".
struct Condition {
  std::string text;  // as given
  std::string quantity;
  std::string comparison;  // one of < <= > >=; empty: the flag `quantity`
  double value = 0;        // SI
  std::string unit;        // as written; empty: none

  /// @param known what a run can tell. @throws InputError where the quantity is of another dimension, or a
  /// number that is compared with nothing.
  void check(const Quantities& known) const;
  /// Whether it holds. What did not happen (a time of failure) fulfils no comparison.
  /// @throws InputError where the run has no such quantity or no value for it, or one of another dimension.
  bool holds(const RunQuantities& run) const;
};

/// @throws InputError with a cure.
Condition parse_condition(const std::string& text);

}  // namespace recoil::app
