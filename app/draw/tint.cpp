#include "app/draw/tint.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pedicel::app {

namespace {

render::Shading tint_of(render::Shading material, double hue, double value) {
  material.colour = tinted(material.colour, hue, value);
  return material;
}

}  // namespace

render::Colour tinted(const render::Colour& colour, double hue, double value) {
  if (hue == 0.0 && value == 1.0) return colour;
  // HSV: hue in sixths of a turn.
  const double high = std::max({colour.r, colour.g, colour.b});
  const double range = high - std::min({colour.r, colour.g, colour.b});
  double sixth = 0.0;
  if (range > 0.0) {
    if (high == colour.r)
      sixth = (colour.g - colour.b) / range;
    else if (high == colour.g)
      sixth = 2.0 + (colour.b - colour.r) / range;
    else
      sixth = 4.0 + (colour.r - colour.g) / range;
  }
  const double turned = sixth + hue * 3.0 / std::numbers::pi;
  const double bright = std::min(1.0, high * value);
  const double saturation = high > 0.0 ? range / high : 0.0;
  const auto part = [&](double offset) {
    double k = std::fmod(offset + turned, 6.0);
    if (k < 0.0) k += 6.0;
    return static_cast<float>(bright *
                              (1.0 - saturation * std::clamp(std::min(k, 4.0 - k), 0.0, 1.0)));
  };
  return {part(5.0), part(3.0), part(1.0)};
}

PlantLook tinted(PlantLook look, const world::SceneLook& scene) {
  look.stem = tint_of(look.stem, scene.stem_hue, scene.stem_value);
  look.fruit.stalk = tint_of(look.fruit.stalk, scene.stem_hue, scene.stem_value);
  look.vein = tint_of(look.vein, scene.leaf_hue, scene.leaf_value);
  look.blade = tint_of(look.blade, scene.leaf_hue, scene.leaf_value);
  look.fruit.calyx = tint_of(look.fruit.calyx, scene.leaf_hue, scene.leaf_value);
  look.fruit.skin = tint_of(look.fruit.skin, scene.fruit_hue, scene.fruit_value);
  look.fruit.unripe = tinted(look.fruit.unripe, scene.fruit_hue, scene.fruit_value);
  return look;
}

render::RenderSettings light_of(const world::SceneLook& scene, render::RenderSettings settings) {
  const world::SceneLook plain;
  settings.sun = scene.sun;
  settings.exposure = scene.exposure;
  if (scene.azimuth != plain.azimuth || scene.elevation != plain.elevation)
    settings.to_sun = {std::cos(scene.elevation) * std::cos(scene.azimuth),
                       std::cos(scene.elevation) * std::sin(scene.azimuth),
                       std::sin(scene.elevation)};
  return settings;
}

}  // namespace pedicel::app
