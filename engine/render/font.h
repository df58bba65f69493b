#pragma once

#include <Eigen/Core>
#include <string_view>
#include <vector>

namespace pedicel::render {

/// A character of the built-in font as pen strokes. Units: the cap height is 12; x to the right
/// from the glyph's left, y up from the baseline.
struct Glyph {
  double width = 0.0;                                 ///< from the first to the last pen position
  std::vector<std::vector<Eigen::Vector2d>> strokes;  ///< polylines
};

namespace font {
inline constexpr double cap_height = 12.0;
inline constexpr double ascent = 13.0;  ///< highest pen position above the baseline
inline constexpr double descent = 4.0;  ///< lowest below
inline constexpr double gap = 3.2;      ///< between the pens of neighbouring characters
inline constexpr double space = 4.0;    ///< width of a space
}  // namespace font

/// The glyph of a character (ASCII, and the degree sign, micro, plus-minus, times, dot, squares,
/// dash, arrow, at most, at least); a box for all others.
const Glyph& glyph(char32_t character);

/// The characters of a UTF-8 text; bytes that are none become U+FFFD.
std::vector<char32_t> decode_utf8(std::string_view text);

}  // namespace pedicel::render
