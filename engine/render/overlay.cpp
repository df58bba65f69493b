#include "engine/render/overlay.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "engine/render/colormap.h"

namespace pedicel::render {

namespace {

constexpr Colour panel_colour = Colour::hex(0x1b2229);
constexpr double panel_opacity = 0.72;

/// Cap height of normal text: 13 px in a picture of 720 rows, never too small to read.
double cap_height(const Image& image, double scale) {
  return scale * std::max(7.0, 13.0 * image.height / 720.0);
}

Area placed(const Image& image, double width, double height, Corner corner, double margin) {
  const bool right = corner == Corner::top_right || corner == Corner::bottom_right;
  const bool bottom = corner == Corner::bottom_left || corner == Corner::bottom_right;
  return {right ? image.width - margin - width : margin,
          bottom ? image.height - margin - height : margin, width, height};
}

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

void draw_bar(Image& image, const Area& bar) {
  const int top = static_cast<int>(bar.y), bottom = static_cast<int>(bar.y + bar.height);
  for (int y = std::max(top, 0); y < std::min(bottom, image.height); ++y)
    for (int x = std::max(static_cast<int>(bar.x), 0);
         x < std::min(static_cast<int>(bar.x + bar.width), image.width); ++x)
      blend(image, x, y, strain_colour(1.0 - (y + 0.5 - bar.y) / bar.height), 1.0);
}

}  // namespace

void draw_panel(Image& image, const Area& area, const Colour& colour, double opacity,
                double rounding) {
  const double cx = area.x + 0.5 * area.width, cy = area.y + 0.5 * area.height;
  const double r = std::min({rounding, 0.5 * area.width, 0.5 * area.height});
  const int left = std::max(static_cast<int>(std::floor(area.x)), 0);
  const int right = std::min(static_cast<int>(std::ceil(area.x + area.width)), image.width);
  const int top = std::max(static_cast<int>(std::floor(area.y)), 0);
  const int bottom = std::min(static_cast<int>(std::ceil(area.y + area.height)), image.height);
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x) {
      // Signed distance to the rounded rectangle.
      const double dx = std::abs(x + 0.5 - cx) - 0.5 * area.width + r;
      const double dy = std::abs(y + 0.5 - cy) - 0.5 * area.height + r;
      const double outside =
          std::hypot(std::max(dx, 0.0), std::max(dy, 0.0)) + std::min(std::max(dx, dy), 0.0) - r;
      blend(image, x, y, colour, opacity * std::clamp(0.5 - outside, 0.0, 1.0));
    }
}

Area draw_caption(Image& image, std::string_view text, Corner corner, double scale) {
  const TextStyle style{cap_height(image, scale)};
  const TextSize size = text_size(text, style);
  const double inset = 0.7 * style.cap_height;
  const Area area = placed(image, size.width + 2 * inset, size.height + 1.2 * inset, corner,
                           1.1 * style.cap_height);
  draw_panel(image, area, panel_colour, panel_opacity, 0.5 * style.cap_height);
  draw_text(image, area.x + inset, area.y + 0.6 * inset, text, style);
  return area;
}

Area draw_legend(Image& image, const Legend& legend, Corner corner, double scale) {
  const TextStyle style{0.85 * cap_height(image, scale)};
  const double em = style.cap_height, bar_width = 1.6 * em, bar_height = 14.0 * em;
  const TextSize title = text_size(legend.title, style);
  double labels = text_size("0.000", style).width;
  for (const double value : {legend.low, legend.high, legend.mark})
    labels = std::max(labels, text_size(short_number(value), style).width);
  const double inset = 0.8 * em;
  const Area area =
      placed(image, std::max(title.width, bar_width + 1.0 * em + labels) + 2.0 * inset,
             title.height + bar_height + 3.0 * inset, corner, 1.3 * em);
  draw_panel(image, area, panel_colour, panel_opacity, 0.6 * em);
  draw_text(image, area.x + inset, area.y + 0.6 * inset, legend.title, style);
  const Area bar{area.x + inset, area.y + title.height + 1.6 * inset, bar_width, bar_height};
  draw_bar(image, bar);
  const auto draw_value = [&](double value, const Colour& colour) {
    const double y = bar.y + bar.height * (legend.high - value) / (legend.high - legend.low);
    TextStyle coloured = style;
    coloured.colour = colour;
    const std::string label = short_number(value);
    draw_panel(image, {bar.x + bar.width, y - 0.75, 0.6 * em, 1.5}, colour, 1.0, 0.0);
    draw_text(image, bar.x + bar.width + em, y - 0.5 * text_size(label, style).height, label,
              coloured);
    return y;
  };
  for (const double share : {0.0, 0.5, 1.0})
    draw_value(legend.low + share * (legend.high - legend.low), Colour::hex(0xe8ecef));
  if (legend.mark >= legend.low && legend.mark <= legend.high) {
    const double y = bar.y + bar.height * (legend.high - legend.mark) / (legend.high - legend.low);
    draw_panel(image, {bar.x - 0.3 * em, y - 1.0, bar.width + 0.9 * em, 2.0}, Colour::hex(0xff5a4d),
               1.0, 0.0);
  }
  return area;
}

bool draw_label(Image& image, const Camera& camera, const Vec3& p_W, std::string_view text,
                double scale) {
  const PixelPoint p = camera.project(p_W, image.width, image.height);
  if (p.depth <= camera.near_plane || p.x < 0 || p.y < 0 || p.x >= image.width ||
      p.y >= image.height)
    return false;
  const TextStyle style{0.8 * cap_height(image, scale)};
  const TextSize size = text_size(text, style);
  const double em = style.cap_height;
  draw_panel(image, {p.x - 0.25 * em, p.y - 0.25 * em, 0.5 * em, 0.5 * em}, Colour::hex(0xffffff),
             1.0, em);
  const Area area{p.x + 0.7 * em, p.y - 0.5 * size.height - 0.2 * em, size.width + 0.8 * em,
                  size.height + 0.4 * em};
  draw_panel(image, area, panel_colour, panel_opacity, 0.4 * em);
  draw_text(image, area.x + 0.4 * em, area.y + 0.2 * em, text, style);
  return true;
}

}  // namespace pedicel::render
