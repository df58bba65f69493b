#include <algorithm>
#include <cmath>

#include "pedicel/app/tools/tool_handles.h"

/// How the handles look.
namespace pedicel::app {

namespace {

constexpr std::array<ImU32, 3> colours = {IM_COL32(224, 62, 52, 255), IM_COL32(70, 176, 62, 255),
                                          IM_COL32(58, 116, 232, 255)};
constexpr ImU32 taken = IM_COL32(255, 210, 74, 255), white = IM_COL32(245, 247, 249, 255);
constexpr ImU32 edge = IM_COL32(18, 22, 26, 160);
constexpr ImU32 missed = IM_COL32(236, 90, 40, 255), missed_ground = IM_COL32(170, 40, 34, 235);
constexpr ImU32 dark_ground = IM_COL32(18, 22, 26, 205);

ImU32 faint(ImU32 colour, float alpha) {
  ImVec4 c = ImGui::ColorConvertU32ToFloat4(colour);
  c.w *= alpha;
  return ImGui::ColorConvertFloat4ToU32(c);
}

/// Words on a plate that stays whole within the picture.
void plate(ImDrawList& list, const SceneFrame& frame, ImVec2 at, const std::string& text,
           ImU32 ground, float scale) {
  const float room = frame.size.x - 40.0f * scale;
  const ImVec2 extent =
      ImGui::CalcTextSize(text.c_str(), nullptr, false, std::min(room, 330.0f * scale));
  const ImVec2 pad(8.0f * scale, 4.0f * scale);
  const ImVec2 size(extent.x + 2 * pad.x, extent.y + 2 * pad.y);
  at.x = std::clamp(at.x - 0.5f * size.x, frame.low.x + 6.0f,
                    std::max(frame.low.x + 6.0f, frame.low.x + frame.size.x - size.x - 6.0f));
  at.y = std::clamp(at.y, frame.low.y + 6.0f,
                    std::max(frame.low.y + 6.0f, frame.low.y + frame.size.y - size.y - 6.0f));
  list.AddRectFilled(at, ImVec2(at.x + size.x, at.y + size.y), ground, 4.0f * scale);
  list.AddText(nullptr, 0.0f, ImVec2(at.x + pad.x, at.y + pad.y), white, text.c_str(), nullptr,
               std::min(room, 330.0f * scale));
}

}  // namespace

void ToolHandles::draw_arrow(ImDrawList& list, const SceneFrame& frame, int axis) const {
  const auto from = frame.project(pose_.position + 0.12 * length_ * direction(axis));
  const auto to = frame.project(pose_.position + length_ * direction(axis));
  if (!from || !to) return;
  const Eigen::Vector2f way(to->x - from->x, to->y - from->y);
  const Part part = static_cast<Part>(1 + axis);
  const ImU32 colour =
      part == (dragging() ? dragged_ : under_) ? taken : colours[static_cast<std::size_t>(axis)];
  const float s = scale_;
  if (way.norm() < 4.0f * s) {  // seen from its end
    list.AddCircleFilled(*to, 5.0f * s, colour);
    return;
  }
  const Eigen::Vector2f along = way.normalized(), across(-along.y(), along.x());
  const auto corner = [&](float a, float b) {
    return ImVec2(to->x + a * along.x() + b * across.x(), to->y + a * along.y() + b * across.y());
  };
  list.AddLine(*from, *to, edge, 5.0f * s);
  list.AddTriangleFilled(corner(14 * s, 0), corner(-2 * s, 7.5f * s), corner(-2 * s, -7.5f * s),
                         edge);
  list.AddLine(*from, *to, colour, 3.0f * s);
  list.AddTriangleFilled(corner(12 * s, 0), corner(-1 * s, 6 * s), corner(-1 * s, -6 * s), colour);
}

void ToolHandles::draw_ring(ImDrawList& list, const SceneFrame& frame, int axis) const {
  const std::vector<Vec3> points = ring(axis);
  const Part part = static_cast<Part>(4 + axis);
  const ImU32 colour =
      part == (dragging() ? dragged_ : under_) ? taken : colours[static_cast<std::size_t>(axis)];
  const Vec3 to_eye = frame.camera.eye - pose_.position;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const auto a = frame.project(points[i - 1]), b = frame.project(points[i]);
    if (!a || !b) continue;
    const bool front = (points[i] - pose_.position).dot(to_eye) > -0.05 * length_ * to_eye.norm();
    list.AddLine(*a, *b, front ? faint(colour, 0.95f) : faint(colour, 0.25f),
                 (front ? 2.4f : 1.4f) * scale_);
  }
}

/// Dashes from where the tool goes to where it was asked to go.
void ToolHandles::draw_missed(ImDrawList& list, const SceneFrame& frame) const {
  const auto a = frame.project(goal_.nearest_W.position), b = frame.project(pose_.position);
  if (!a || !b) return;
  const float length = std::hypot(b->x - a->x, b->y - a->y), dash = 7.0f * scale_;
  const auto at = [&](float share) {
    return ImVec2(a->x + share * (b->x - a->x), a->y + share * (b->y - a->y));
  };
  const int count = std::min(200, static_cast<int>(length / dash));
  for (int i = 0; i < count; i += 2)
    list.AddLine(at(static_cast<float>(i) / static_cast<float>(count)),
                 at(static_cast<float>(i + 1) / static_cast<float>(count)), missed, 2.5f * scale_);
  list.AddCircle(*a, 8.0f * scale_, missed, 24, 2.5f * scale_);
}

void ToolHandles::draw(ImDrawList& list, const Ui& ui, const SceneFrame& frame) const {
  if (!seen_) return;
  if (!goal_.reached) draw_missed(list, frame);
  for (int axis = 0; axis < 3; ++axis) draw_ring(list, frame, axis);
  // The arrow that is farthest first.
  std::array<int, 3> order = {0, 1, 2};
  std::ranges::sort(order, [&](int a, int b) {
    const Vec3 back = frame.camera.eye - pose_.position;
    return direction(a).dot(back) < direction(b).dot(back);
  });
  for (const int axis : order) draw_arrow(list, frame, axis);
  const auto centre = frame.project(pose_.position);
  if (!centre) return;
  const bool held = (dragging() ? dragged_ : under_) == Part::knob;
  list.AddCircleFilled(*centre, 7.5f * scale_, edge, 24);
  list.AddCircleFilled(*centre, 6.0f * scale_, held ? taken : goal_.reached ? white : missed, 24);
  const std::string text = words(ui);
  if (text.empty()) return;
  plate(list, frame, ImVec2(centre->x, centre->y + (static_cast<float>(1.3 * 84.0)) * scale_), text,
        goal_.reached && ui.view.goal_hits.empty() ? dark_ground : missed_ground, scale_);
}

}  // namespace pedicel::app
