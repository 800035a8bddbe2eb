#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "picture/axis.hpp"
#include "picture/canvas.hpp"
#include "picture/colour_map.hpp"

namespace recoil {

/// Which colour a value gets.
struct Colours {
  std::vector<Rgb> table;  ///< of the map, lowest first
  AxisScale shown;         ///< values of the bar; those beyond take the colours of its ends
  AxisScale mapped;        ///< values of the ends of the map: wider than shown where zero is its middle
  std::vector<Category> categories{};  ///< in place of all that, where there are any
  bool below = false, above = false;   ///< whether there are values beyond the ends of the bar

  /// Background where the value is NaN or in no category.
  Rgb at(double value) const;
};

/// What is asked of the colours.
struct ColourChoice {
  ColourMap map = ColourMap::sequential;
  std::optional<std::pair<double, double>> range{};  ///< none: of the values
  bool log = false;                                  ///< values at or below 0 take the lowest colour
  std::vector<Category> categories{};                ///< in place of all that, where there are any
};

/// The colours for these values; those that are not finite do not count. In a diverging map zero has the
/// middle colour; logarithmic colours go over six decades at most, unless a range is given.
Colours colours_of(const std::vector<double>& values, const ColourChoice& choice);

/// The bar, or list of categories, that tells what the colours mean.
struct ColourKey {
  Colours colours;
  std::string label;        ///< with unit
  bool horizontal = false;  ///< below the field, else on its right
};

/// What a key on the right takes of the width, its gap included [pixels].
double key_width(const ColourKey& key);

/// What a key below a field of that width takes of the height.
double key_height(const ColourKey& key, double width);

/// Draws it beside `area` (the field with its edge), or `below` pixels below it.
void draw_key(Canvas& canvas, const ColourKey& key, const PixelRect& area, double below);

}  // namespace recoil
