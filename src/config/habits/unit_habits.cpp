#include "config/habits/unit_habits.hpp"

#include <algorithm>
#include <array>
#include <cctype>

namespace recoil::config {

namespace {

struct Habit {
  std::string_view written, meant;
};

constexpr std::array habits{Habit{"mps", "m/s"},    Habit{"kps", "km/s"},  Habit{"kmps", "km/s"},
                            Habit{"kms", "km/s"},   Habit{"mmps", "mm/s"}, Habit{"fps", "ft/s"},
                            Habit{"kph", "km/h"},   Habit{"kmh", "km/h"},  Habit{"kmph", "km/h"},
                            Habit{"mph", "mile/h"}, Habit{"gcc", "g/cm3"}, Habit{"gpcc", "g/cm3"}};

/// Capital letters or not.
bool same_word(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char p, char q) {
    return std::tolower(static_cast<unsigned char>(p)) == std::tolower(static_cast<unsigned char>(q));
  });
}

}  // namespace

std::string_view meant_by(std::string_view unit) {
  for (const Habit& h : habits)
    if (same_word(h.written, unit)) return h.meant;
  return {};
}

std::string_view degrees_of(std::string_view unit) {
  if (unit == "C") return "C is the coulomb; did you mean 'degC'?";
  if (unit == "F") return "F is the farad; did you mean 'degF'?";
  return {};
}

}  // namespace recoil::config
