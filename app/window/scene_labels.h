#pragma once

#include "app/ui/ui.h"
#include "app/view/scene_canvas.h"
#include "app/view/scene_mouse.h"

namespace pedicel::app {

class DrawTool;

/// Writes beside what happens in the scene: the force of a pull, the length of a stroke, what came
/// off, what is unstable. Into ImGui's present window.
void draw_scene_labels(const Ui& ui, const SceneFrame& scene, const DrawTool& draw_tool);

}  // namespace pedicel::app
