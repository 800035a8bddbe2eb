#pragma once

#include <string>

#include "config/declare/reading.hpp"
#include "config/formula/formula.hpp"

namespace recoil::config {

/// What the value of a formula must be, and how messages speak of it.
struct FormulaGoal {
  const char* noun;  // "velocity"
  Dimension dimension;
  std::string example;  // as in TOML
  const char* one_of;   // a value for examples: "5*m/s"
  Formula::Of of = Formula::Of::place;
};

/// Reports what is wrong with the formula at a key: faults of the text, and values of another dimension.
void check_formula(const TableReading& reading, const char* key, const std::string& text,
                   const FormulaGoal& goal);

}  // namespace recoil::config
