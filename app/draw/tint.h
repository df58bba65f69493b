#pragma once

#include "app/draw/plant_drawing.h"
#include "engine/render/renderer.h"
#include "engine/world/sensors.h"

namespace pedicel::app {

/// A colour with another hue (turned by rad) and brightness (times a factor, at most white's).
render::Colour tinted(const render::Colour& colour, double hue, double value);

/// A plant's looks as a scene wants them; unchanged where it wants nothing.
PlantLook tinted(PlantLook look, const world::SceneLook& scene);

/// The light of a scene.
render::RenderSettings light_of(const world::SceneLook& scene,
                                render::RenderSettings settings = {});

}  // namespace pedicel::app
