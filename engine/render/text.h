#pragma once

#include <string_view>

#include "engine/render/draw_list.h"
#include "engine/render/image.h"

namespace pedicel::render {

/// How text looks on a picture.
struct TextStyle {
  double cap_height = 13.0;  ///< px
  Colour colour = Colour::hex(0xffffff);
  double weight = 0.135;  ///< width of the pen as a fraction of the cap height
};

struct TextSize {
  double width = 0.0, height = 0.0;  ///< px
};

/// The box that a text fills: the widest line, and all lines ('\n').
TextSize text_size(std::string_view text, const TextStyle& style);

/// Draws smooth text (UTF-8, '\n' begins a new line) with the upper left corner of its box at (x,
/// y), px. What lies outside the picture is cut off; nothing outside the box is touched.
void draw_text(Image& image, double x, double y, std::string_view text, const TextStyle& style);

/// Mixes a colour into a pixel; `share` in [0, 1].
void blend(Image& image, int x, int y, const Colour& colour, double share);

}  // namespace pedicel::render
