#include "engine/render/colormap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/render/colour_space.h"

namespace pedicel::render {

namespace {

/// CIE 1976 L*a*b* (white D65) to linear sRGB, which may lie outside [0, 1].
Vec3 lab_to_linear(double l, double a, double b) {
  const auto inverse = [](double t) {
    return t > 6.0 / 29.0 ? t * t * t : 3.0 * (6.0 / 29.0) * (6.0 / 29.0) * (t - 4.0 / 29.0);
  };
  const double fy = (l + 16.0) / 116.0;
  const Vec3 xyz(0.95047 * inverse(fy + a / 500.0), inverse(fy), 1.08883 * inverse(fy - b / 200.0));
  Mat3 to_rgb;
  to_rgb << 3.2404542, -1.5371385, -0.4985314, -0.9692660, 1.8760108, 0.0415560, 0.0556434,
      -0.2040259, 1.0572252;
  return to_rgb * xyz;
}

Vec3 lch_to_linear(double l, double chroma, double hue) {
  return lab_to_linear(l, chroma * std::cos(hue), chroma * std::sin(hue));
}

bool shown(const Vec3& rgb) {
  return rgb.minCoeff() >= 0.0 && rgb.maxCoeff() <= 1.0;
}

Colour computed(double fraction) {
  const double l = 25.0 + 66.0 * fraction;
  const double hue = (305.0 - 207.0 * fraction) * std::numbers::pi / 180.0;
  double low = 0.0, high = 58.0;
  if (!shown(lch_to_linear(l, high, hue))) {
    for (int i = 0; i < 30; ++i) {
      const double middle = 0.5 * (low + high);
      (shown(lch_to_linear(l, middle, hue)) ? low : high) = middle;
    }
    high = low;
  }
  const Vec3 rgb = lch_to_linear(l, high, hue);
  const auto part = [](double c) { return from_linear(static_cast<float>(c)); };
  return {part(rgb.x()), part(rgb.y()), part(rgb.z())};
}

}  // namespace

Colour strain_colour(double fraction) {
  static const auto table = [] {
    std::array<Colour, 256> colours;
    for (int i = 0; i < 256; ++i) colours[i] = computed(i / 255.0);
    return colours;
  }();
  if (std::isnan(fraction)) return {0.5f, 0.5f, 0.5f};
  return table[static_cast<int>(std::lround(std::clamp(fraction, 0.0, 1.0) * 255.0))];
}

double lightness(const Colour& colour) {
  const Colour c = to_linear(colour);
  const double y = 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
  return y > 216.0 / 24389.0 ? 116.0 * std::cbrt(y) - 16.0 : y * 24389.0 / 27.0;
}

}  // namespace pedicel::render
