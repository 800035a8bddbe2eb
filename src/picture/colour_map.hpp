#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "picture/image.hpp"

namespace recoil {

/// Colours for numbers. In each, equal steps of the value look like equal steps of the colour (they are
/// drawn in Oklab: B. Ottosson, "A perceptual color space for image processing", 2020).
enum class ColourMap {
  sequential,  ///< dark violet, blue, green, yellow: positive fields (pressure, strain, speed)
  heat,        ///< black, purple, red, orange, pale yellow: temperature
  diverging,   ///< blue, near white in the middle, red: signed fields (stress, velocity component)
  grey         ///< dark to light grey: schlieren
};

/// One of the few values that a field takes, by name.
struct Category {
  double value = 0;
  std::string name;
  Rgb colour;
};

/// Colours of curves, told apart also by people who see few of them: they differ in lightness as well. After
/// the last the first comes again.
Rgb curve_colour(std::size_t which);

/// The same, paler, for areas.
Rgb area_colour(std::size_t which);

/// The map as a table of `count` colours, from the lowest value to the highest; count >= 2.
std::vector<Rgb> colour_table(ColourMap map, int count);

/// The colour at `t` in 0..1 of a table; values outside take the colour of the end.
Rgb colour_at(const std::vector<Rgb>& table, double t);

}  // namespace recoil
