#pragma once

#include <cmath>

#include "engine/render/draw_list.h"

namespace pedicel::render {

/// The sRGB transfer function and its inverse (IEC 61966-2-1), per channel in [0, 1].
inline float to_linear(float c) {
  return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
}
inline float from_linear(float c) {
  return c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1.0f / 2.4f) - 0.055f;
}
inline Colour to_linear(const Colour& c) {
  return {to_linear(c.r), to_linear(c.g), to_linear(c.b)};
}

}  // namespace pedicel::render
