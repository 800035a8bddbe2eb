#include "config/habits/choice_habits.hpp"

#include <algorithm>
#include <array>

namespace recoil::config {

namespace {

/// A word that other programs have, one of the choices where it may be meant, and what it is here.
struct ChoiceHabit {
  std::string_view written, among, help;
};

constexpr std::string_view two_dimensions =
    "two dimensions are \"planar\" (plane strain) or \"axisymmetric\" (r, z)";
constexpr std::string_view wall =
    "a wall is a body with rigid = true; \"symmetry\" is a plane along which matter slides";

constexpr std::array choice_habits{
    ChoiceHabit{"2d", "planar", two_dimensions}, ChoiceHabit{"2D", "planar", two_dimensions},
    ChoiceHabit{"fixed", "outflow", wall},       ChoiceHabit{"wall", "outflow", wall},
    ChoiceHabit{"rigid", "outflow", wall},       ChoiceHabit{"reflecting", "outflow", wall}};

}  // namespace

std::string_view help_for_choice(std::string_view written, std::span<const std::string> choices) {
  for (const ChoiceHabit& h : choice_habits)
    if (h.written == written && std::ranges::find(choices, h.among) != choices.end()) return h.help;
  return {};
}

}  // namespace recoil::config
