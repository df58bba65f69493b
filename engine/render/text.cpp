#include "engine/render/text.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/render/font.h"

namespace pedicel::render {

namespace {

using Eigen::Vector2d;

double pen_width(const TextStyle& style) {
  return style.weight * style.cap_height;
}
double unit(const TextStyle& style) {
  return style.cap_height / font::cap_height;
}
double line_height(const TextStyle& style) {
  return 1.75 * style.cap_height;
}
/// Half a pixel of softened edge on either side of the pen.
double border(const TextStyle& style) {
  return 0.5 * pen_width(style) + 0.5;
}

double line_width(const std::vector<char32_t>& line, const TextStyle& style) {
  double width = 0.0;
  for (const char32_t c : line) width += glyph(c).width + font::gap;
  return line.empty() ? 0.0 : (width - font::gap) * unit(style) + 2.0 * border(style);
}

std::vector<std::vector<char32_t>> lines_of(std::string_view text) {
  std::vector<std::vector<char32_t>> lines(1);
  for (const char32_t c : decode_utf8(text)) {
    if (c == '\n')
      lines.emplace_back();
    else
      lines.back().push_back(c);
  }
  return lines;
}

double distance_to_segment(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
  const Vector2d along = b - a;
  const double square = along.squaredNorm();
  const double t = square > 0.0 ? std::clamp((p - a).dot(along) / square, 0.0, 1.0) : 0.0;
  return (p - a - t * along).norm();
}

double distance_to(const Glyph& shape, const Vector2d& p) {
  double nearest = 1e9;
  for (const auto& stroke : shape.strokes)
    for (std::size_t i = 0; i < stroke.size(); ++i)
      nearest = std::min(nearest, distance_to_segment(p, stroke[i ? i - 1 : 0], stroke[i]));
  return nearest;
}

/// `x`, `baseline`: where the glyph's origin lies, px.
void draw_glyph(Image& image, double x, double baseline, const Glyph& shape,
                const TextStyle& style) {
  const double scale = unit(style), reach = border(style);
  const int left = static_cast<int>(std::floor(x - reach));
  const int right = static_cast<int>(std::ceil(x + shape.width * scale + reach));
  const int top = static_cast<int>(std::floor(baseline - font::ascent * scale - reach));
  const int bottom = static_cast<int>(std::ceil(baseline + font::descent * scale + reach));
  for (int row = std::max(top, 0); row < std::min(bottom, image.height); ++row)
    for (int column = std::max(left, 0); column < std::min(right, image.width); ++column) {
      const Vector2d p((column + 0.5 - x) / scale, (baseline - row - 0.5) / scale);
      const double covered = reach - distance_to(shape, p) * scale;
      if (covered > 0.0) blend(image, column, row, style.colour, std::min(covered, 1.0));
    }
}

}  // namespace

void blend(Image& image, int x, int y, const Colour& colour, double share) {
  const float parts[] = {colour.r, colour.g, colour.b};
  std::uint8_t* pixel = image.at(x, y);
  for (int i = 0; i < 3; ++i)
    pixel[i] = static_cast<std::uint8_t>(
        std::lround(pixel[i] + share * (255.0 * static_cast<double>(parts[i]) - pixel[i])));
}

TextSize text_size(std::string_view text, const TextStyle& style) {
  const auto lines = lines_of(text);
  double width = 0.0;
  for (const auto& line : lines) width = std::max(width, line_width(line, style));
  const double last = (font::ascent + font::descent) * unit(style) + 2.0 * border(style);
  return {width, static_cast<double>(lines.size() - 1) * line_height(style) + last};
}

void draw_text(Image& image, double x, double y, std::string_view text, const TextStyle& style) {
  double baseline = y + font::ascent * unit(style) + border(style);
  for (const auto& line : lines_of(text)) {
    double pen = x + border(style);
    for (const char32_t c : line) {
      const Glyph& shape = glyph(c);
      draw_glyph(image, pen, baseline, shape, style);
      pen += (shape.width + font::gap) * unit(style);
    }
    baseline += line_height(style);
  }
}

}  // namespace pedicel::render
