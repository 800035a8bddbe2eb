#pragma once

#include <string>
#include <string_view>

#include "picture/canvas.hpp"

namespace recoil {

enum class HorizontalAnchor { left, centre, right };
enum class VerticalAnchor { baseline, middle, top };  ///< middle and top of a capital letter

/// Height of a capital letter of DejaVu Sans [em].
inline constexpr double kCapitalHeight = 0.729;

/// How a text is drawn, in DejaVu Sans; size is the em [pixels].
struct TextStyle {
  double size = 18;
  Rgb colour{32, 34, 38};
  HorizontalAnchor horizontal = HorizontalAnchor::left;
  VerticalAnchor vertical = VerticalAnchor::baseline;
  bool upwards = false;  ///< turned a quarter to the left, as the title of a vertical axis
  bool bold = false;
};

/// Draws one line of UTF-8 text with its anchor at `at`. `^{...}` raises and shrinks what is in braces.
/// Broken bytes are drawn as U+FFFD.
void draw_text(Canvas& canvas, Point2 at, std::string_view text, const TextStyle& style);

/// Width of that text [pixels].
double text_width(std::string_view text, double size, bool bold = false);

/// The text, or as much of its beginning as is no wider than `room` [pixels], and an ellipsis.
std::string shortened_text(std::string_view text, double room, double size, bool bold = false);

}  // namespace recoil
