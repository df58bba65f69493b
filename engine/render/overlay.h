#pragma once

#include <string>
#include <string_view>

#include "engine/render/camera.h"
#include "engine/render/image.h"
#include "engine/render/text.h"

namespace pedicel::render {

enum class Corner { top_left, top_right, bottom_left, bottom_right };

/// A rectangle of a picture, px.
struct Area {
  double x = 0.0, y = 0.0, width = 0.0, height = 0.0;
};

/// Mixes a rounded rectangle of one colour into a picture.
void draw_panel(Image& image, const Area& area, const Colour& colour, double opacity,
                double rounding);

/// White text on a dark, half transparent panel in a corner; '\n' begins a new line. Sized by the
/// picture's height (`scale` multiplies it), so that it reads the same in every resolution. Returns
/// the panel's area.
Area draw_caption(Image& image, std::string_view text, Corner corner, double scale = 1.0);

/// What the colour bar says.
struct Legend {
  std::string title = "strain";  ///< with its unit
  double low = 0.0, high = 1.0;
  double mark = -1.0;  ///< a value to mark (a threshold); outside [low, high]: none
};

/// The scale of strain_colour() with its numbers. Returns the panel's area.
Area draw_legend(Image& image, const Legend& legend, Corner corner, double scale = 1.0);

/// A small label with a dot at a point of the world. Returns false, and draws nothing, where the
/// point lies behind the camera or outside the picture.
bool draw_label(Image& image, const Camera& camera, const Vec3& p_W, std::string_view text,
                double scale = 1.0);

}  // namespace pedicel::render
