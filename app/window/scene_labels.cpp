#include "app/window/scene_labels.h"

#include <imgui.h>

#include "app/session/live/organ_place.h"
#include "app/tools/draw_tool.h"
#include "app/ui/widgets.h"
#include "app/view/scene_marks.h"

namespace pedicel::app {

namespace {

/// A text beside a place of the world, on a dark plate.
void label(const SceneFrame& scene, const Vec3& place_W, const std::string& text, float scale) {
  const auto at = scene.project(place_W);
  if (!at) return;
  const ImVec2 extent = ImGui::CalcTextSize(text.c_str()), pad(6.0f * scale, 3.0f * scale);
  const ImVec2 end(scene.low.x + scene.size.x, scene.low.y + scene.size.y);
  ImVec2 low(at->x + 12.0f * scale, at->y - 0.5f * extent.y - pad.y);
  // Whole in the picture, or on the other side of the place.
  if (low.x + extent.x + 2 * pad.x > end.x) low.x = at->x - 12.0f * scale - extent.x - 2 * pad.x;
  if (low.x < scene.low.x || low.y < scene.low.y || low.y + extent.y + 2 * pad.y > end.y) return;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(low, ImVec2(low.x + extent.x + 2 * pad.x, low.y + extent.y + 2 * pad.y),
                     IM_COL32(18, 22, 26, 205), 4.0f * scale);
  list.AddText(ImVec2(low.x + pad.x, low.y + pad.y), IM_COL32(240, 243, 245, 255), text.c_str());
}

}  // namespace

void draw_scene_labels(const Ui& ui, const SceneFrame& scene, const DrawTool& draw_tool) {
  const Snapshot& s = *ui.snapshot;
  if (s.pull.active)
    label(scene, s.pull.target_W, quantity_text(s.pull.force_W.norm(), "N"), ui.scale);
  if (const std::string text = draw_tool.label(ui); ui.draw.on && !text.empty())
    label(scene, draw_tool.label_place(), text, ui.scale);
  for (const world::Event& event : recent_breaks(s))
    if (const auto place = place_of_break(s, event))
      label(scene, *place, event.organ + ": came off", ui.scale);
  if (s.culprit_plant >= 0 && s.culprit_element >= 0 &&
      s.culprit_plant < static_cast<int>(s.plants.size())) {
    const auto& state = s.plants[static_cast<std::size_t>(s.culprit_plant)].state;
    if (s.culprit_element < state.size())
      label(scene, state.position[static_cast<std::size_t>(s.culprit_element)], s.culprit,
            ui.scale);
  }
}

}  // namespace pedicel::app
