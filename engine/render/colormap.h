#pragma once

#include "engine/render/draw_list.h"

namespace pedicel::render {

/// The colour of a fraction in [0, 1] of a scale (values beyond are clamped, NaN is grey): violet
/// over blue, teal and green to yellow. Computed in CIE L*C*h (D65): lightness rises linearly from
/// 25 to 91, so that the order of colours survives a grey printer and colour blindness; hue turns
/// from 305 to 98 degrees; chroma is 58, or what sRGB can show.
Colour strain_colour(double fraction);

/// CIE 1976 lightness L* of a colour, 0 .. 100 (D65).
double lightness(const Colour& colour);

}  // namespace pedicel::render
