#include "picture/text.hpp"

#include <cairo.h>

#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "picture/recording.hpp"

namespace recoil {
namespace {

constexpr double kRaise = 0.36, kShrink = 0.68;

/// A part of a line at one height.
struct Piece {
  std::string text;
  bool raised = false;
};

/// Length of the code point that `text` begins with [bytes]; 0 where its bytes are no UTF-8.
std::size_t code_point_length(std::string_view text) {
  const auto byte = [&text](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return 1;
  const std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4 || text.size() < length) return 0;
  for (std::size_t k = 1; k < length; ++k)
    if ((byte(k) & 0xc0) != 0x80) return 0;
  const bool overlong = (lead == 0xe0 && byte(1) < 0xa0) || (lead == 0xf0 && byte(1) < 0x90);
  const bool surrogate = lead == 0xed && byte(1) > 0x9f, beyond = lead == 0xf4 && byte(1) > 0x8f;
  return overlong || surrogate || beyond ? 0 : length;
}

std::vector<Piece> pieces_of(std::string_view text) {
  std::vector<Piece> pieces(1);
  while (!text.empty()) {
    const bool raised = pieces.back().raised;
    if (!raised && text.starts_with("^{")) {
      pieces.push_back({{}, true});
      text.remove_prefix(2);
      continue;
    }
    if (raised && text.front() == '}') {
      pieces.push_back({{}, false});
      text.remove_prefix(1);
      continue;
    }
    const std::size_t length = text.front() == '\0' ? 0 : code_point_length(text);
    pieces.back().text += length > 0 ? text.substr(0, length) : std::string_view("\ufffd");
    text.remove_prefix(length > 0 ? length : 1);
  }
  return pieces;
}

struct FontDeleter {
  void operator()(cairo_scaled_font_t* font) const { cairo_scaled_font_destroy(font); }
};
using Font = std::unique_ptr<cairo_scaled_font_t, FontDeleter>;

/// The font at a size. Without hinting, so that a text has the same shape and width in every format.
Font font_of(double size, bool bold) {
  cairo_font_face_t* face = cairo_toy_font_face_create(
      "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL, bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_matrix_t em, page;
  cairo_matrix_init_scale(&em, size, size);
  cairo_matrix_init_identity(&page);
  Font font(cairo_scaled_font_create(face, &em, &page, options));
  cairo_font_options_destroy(options);
  cairo_font_face_destroy(face);
  require_drawn(cairo_scaled_font_status(font.get()));
  return font;
}

double width_of(const Piece& piece, double size, bool bold) {
  if (piece.text.empty()) return 0;
  const Font font = font_of(size * (piece.raised ? kShrink : 1), bold);
  cairo_text_extents_t extents;
  cairo_scaled_font_text_extents(font.get(), piece.text.c_str(), &extents);
  return extents.x_advance;
}

}  // namespace

double text_width(std::string_view text, double size, bool bold) {
  double width = 0;
  for (const Piece& piece : pieces_of(text)) width += width_of(piece, size, bold);
  return width;
}

void draw_text(Canvas& canvas, Point2 at, std::string_view text, const TextStyle& style) {
  const double width = text_width(text, style.size, style.bold);
  double left = 0, down = 0;  // of the start of the base line from the anchor, along and across the text
  if (style.horizontal == HorizontalAnchor::centre) left = -0.5 * width;
  if (style.horizontal == HorizontalAnchor::right) left = -width;
  if (style.vertical == VerticalAnchor::middle) down = 0.5 * kCapitalHeight * style.size;
  if (style.vertical == VerticalAnchor::top) down = kCapitalHeight * style.size;
  cairo_t* pen = canvas.recording().pen;
  cairo_save(pen);
  // The base line falls on the edge of a row of pixels: sharper small text.
  if (style.upwards) {
    cairo_translate(pen, std::round(at.x + down), at.y - left);
    cairo_rotate(pen, -0.5 * std::numbers::pi);
  } else {
    cairo_translate(pen, at.x + left, std::round(at.y + down));
  }
  cairo_set_source_rgb(pen, style.colour.r / 255.0, style.colour.g / 255.0, style.colour.b / 255.0);
  double x = 0;
  for (const Piece& piece : pieces_of(text)) {
    if (piece.text.empty()) continue;
    const double size = style.size * (piece.raised ? kShrink : 1);
    const Font font = font_of(size, style.bold);
    cairo_font_options_t* options = cairo_font_options_create();
    cairo_scaled_font_get_font_options(font.get(), options);
    cairo_set_font_options(pen, options);
    cairo_font_options_destroy(options);
    cairo_set_font_face(pen, cairo_scaled_font_get_font_face(font.get()));
    cairo_set_font_size(pen, size);
    cairo_move_to(pen, x, piece.raised ? -kRaise * style.size : 0);
    cairo_show_text(pen, piece.text.c_str());
    x += width_of(piece, style.size, style.bold);
  }
  cairo_restore(pen);
}

std::string shortened_text(std::string_view text, double room, double size, bool bold) {
  if (text_width(text, size, bold) <= room) return std::string(text);
  const auto inside_character = [&](std::size_t at) {
    return (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U;
  };
  std::string shorter;
  for (std::size_t length = text.size(); length > 0; --length) {
    if (length < text.size() && inside_character(length)) continue;
    shorter = std::string(text.substr(0, text.find_last_not_of(" ,;:", length - 1) + 1)) + "\u2026";
    if (text_width(shorter, size, bold) <= room) return shorter;
  }
  return shorter;
}

}  // namespace recoil
