#pragma once

#include <vector>

#include "picture/canvas.hpp"

namespace recoil {

/// One character of the built-in font: centre lines of its strokes in units of the em, x from the left
/// end of the character, y upwards from the base line. Capitals are 0.70 high, small letters 0.50.
struct Glyph {
  double advance = 0;  ///< distance to the next character [em]
  std::vector<Polyline> strokes;
};

/// The glyph of a Unicode code point; a small box for one that the font does not have.
/// It has ASCII and what titles with units need: minus, degree, micro, times, middle dot, some Greek.
const Glyph& glyph(char32_t code);

/// True where the font has its own drawing for the code point.
bool has_glyph(char32_t code);

}  // namespace recoil
