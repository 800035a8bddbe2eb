#pragma once

#include <string>
#include <string_view>

#include "picture/canvas.hpp"

namespace recoil {

enum class HorizontalAnchor { left, centre, right };
enum class VerticalAnchor { baseline, middle, top };  ///< middle and top of a capital letter

/// How a text is drawn; size is the em [pixels], capitals are 0.7 of it.
struct TextStyle {
  double size = 20;
  Rgb colour{32, 34, 38};
  HorizontalAnchor horizontal = HorizontalAnchor::left;
  VerticalAnchor vertical = VerticalAnchor::baseline;
  bool upwards = false;  ///< turned a quarter to the left, as the title of a vertical axis
  bool bold = false;
};

/// Draws one line of UTF-8 text with its anchor at `at`. `^{...}` raises and shrinks what is in braces.
void draw_text(Image& image, Point2 at, std::string_view text, const TextStyle& style);

/// Width of that text [pixels].
double text_width(std::string_view text, double size);

}  // namespace recoil
