#include "app/tools/tool_handles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/session/session_robot.h"
#include "app/ui/widgets.h"
#include "app/view/picking.h"

namespace pedicel::app {

namespace {

constexpr double arrow_px = 84.0, ring_share = 0.78;  // 1, of the arrow's length
constexpr double handle_reach_px = 8.0, knob_px = 9.0;
constexpr int ring_parts = 64;

double distance_to(const ImVec2& p, const ImVec2& a, const ImVec2& b) {
  const Eigen::Vector2d pa(p.x - a.x, p.y - a.y), ba(b.x - a.x, b.y - a.y);
  const double along = std::clamp(pa.dot(ba) / std::max(ba.squaredNorm(), 1e-12), 0.0, 1.0);
  return (pa - along * ba).norm();
}

/// m from `point` along a unit direction to the place of that line nearest to the ray; nothing
/// where one looks along it.
std::optional<double> along_line(const geometry::Ray& ray, const Vec3& point,
                                 const Vec3& direction) {
  const double cosine = direction.dot(ray.direction), across = 1.0 - cosine * cosine;
  if (across < 1e-3) return {};
  const Vec3 w = point - ray.origin;
  return (cosine * ray.direction.dot(w) - direction.dot(w)) / across;
}

/// rad about a unit axis from one direction to another.
double angle_about(const Vec3& axis, const Vec3& from, const Vec3& to) {
  return std::atan2(axis.dot(from.cross(to)), from.dot(to));
}

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

bool ToolHandles::visible(const Ui& ui) const {
  return ui.view.tool_handles && !ui.draw.on && ui.dialog == Dialog::none &&
         (ui.view.robot_panel || ui.selection.kind == Selection::Kind::link || dragging());
}

Vec3 ToolHandles::direction(int axis) const {
  return axes_ * Vec3(Vec3::Unit(axis));
}

std::vector<Vec3> ToolHandles::ring(int axis) const {
  const Vec3 a = direction((axis + 1) % 3), b = direction((axis + 2) % 3);
  std::vector<Vec3> points;
  for (int i = 0; i <= ring_parts; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / ring_parts;
    points.push_back(pose_.position +
                     ring_share * length_ * (std::cos(angle) * a + std::sin(angle) * b));
  }
  return points;
}

ToolHandles::Part ToolHandles::part_under(const ImVec2& mouse, const SceneFrame& frame) const {
  const auto centre = frame.project(pose_.position);
  if (!centre) return Part::none;
  if (distance_to(mouse, *centre, *centre) < knob_px * scale_) return Part::knob;
  Part best = Part::none;
  double nearest = handle_reach_px * scale_;
  const auto offer = [&](const Vec3& from, const Vec3& to, int part) {
    const auto a = frame.project(from), b = frame.project(to);
    if (!a || !b) return;
    const double distance = distance_to(mouse, *a, *b);
    if (distance < nearest) nearest = distance, best = static_cast<Part>(part);
  };
  for (int axis = 0; axis < 3; ++axis)
    offer(pose_.position + 0.2 * length_ * direction(axis),
          pose_.position + 1.1 * length_ * direction(axis), 1 + axis);
  if (best != Part::none) return best;
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<Vec3> points = ring(axis);
    for (std::size_t i = 1; i < points.size(); ++i) offer(points[i - 1], points[i], 4 + axis);
  }
  return best;
}

bool ToolHandles::update(Ui& ui, const SceneFrame& frame) {
  const ImGuiIO& io = ImGui::GetIO();
  const auto goal = visible(ui) ? ui.session.robot().tool_goal() : std::nullopt;
  seen_ = goal.has_value();
  ui.view.goal_missed = false;
  if (!seen_) {
    under_ = dragged_ = Part::none;
    return false;
  }
  goal_ = *goal;
  ui.view.goal_missed = !goal_.reached;
  if (!dragging()) pose_ = goal_.asked_W;
  axes_ = dragging() ? start_axes_ : ui.view.tool_axes ? pose_.rotation : Quat::Identity();
  scale_ = ui.scale;
  const double depth = (pose_.position - frame.camera.eye)
                           .dot((frame.camera.target - frame.camera.eye).normalized());
  length_ = std::max(depth, 1e-3) * frame.angle(arrow_px * scale_);
  const bool any_down = io.MouseDown[0] || io.MouseDown[1] || io.MouseDown[2];
  if (dragging()) {
    move(ui, frame);
  } else {
    const bool over = ImGui::IsItemHovered() && !io.KeyCtrl && !io.KeyShift;
    const bool pressed = over && ImGui::IsMouseClicked(0);
    if (!any_down || pressed) under_ = over ? part_under(io.MousePos, frame) : Part::none;
    if (pressed && under_ != Part::none) press(frame, under_);
  }
  return dragging() || under_ != Part::none;
}

void ToolHandles::press(const SceneFrame& frame, Part part) {
  dragged_ = part;
  start_ = pose_;
  start_axes_ = axes_;
  amount_ = 0.0;
  const geometry::Ray ray = frame.ray(ImGui::GetIO().MousePos);
  const Vec3 back = (frame.camera.eye - frame.camera.target).normalized();
  grabbed_W_ = pose_.position;
  if (part == Part::knob) grabbed_W_ = meet(ray, {pose_.position, back}).value_or(grabbed_W_);
  if (shifts(part)) {
    const Vec3 along = direction(axis_of(part));
    grabbed_W_ += along_line(ray, pose_.position, along).value_or(0.0) * along;
  }
  if (!turns(part)) return;
  // The place of the ring under the pointer.
  double nearest = 1e9;
  for (const Vec3& point : ring(axis_of(part))) {
    const auto at = frame.project(point);
    if (!at) continue;
    const double distance = distance_to(ImGui::GetIO().MousePos, *at, *at);
    if (distance < nearest) nearest = distance, grabbed_W_ = point;
  }
}

void ToolHandles::move(Ui& ui, const SceneFrame& frame) {
  const ImGuiIO& io = ImGui::GetIO();
  if (ImGui::IsKeyPressed(static_cast<int>(Key::escape), false)) {
    std::erase(ui.actions, Action::cancel);
    send(ui, start_, true);
    dragged_ = under_ = Part::none;
    return;
  }
  if (!io.MouseDown[0]) {
    dragged_ = Part::none;
    return;
  }
  if (io.MouseDelta.x == 0.0f && io.MouseDelta.y == 0.0f) return;
  const geometry::Ray ray = frame.ray(io.MousePos);
  const Vec3 axis = direction(axis_of(dragged_));
  Pose pose = start_;
  if (dragged_ == Part::knob) {
    const Vec3 back = (frame.camera.eye - frame.camera.target).normalized();
    const auto at = meet(ray, {grabbed_W_, back});
    if (!at) return;
    pose.position += *at - grabbed_W_;
    amount_ = (*at - grabbed_W_).norm();
  } else if (shifts(dragged_)) {
    const auto at = along_line(ray, grabbed_W_, axis);
    if (!at) return;
    amount_ = *at;
    pose.position += amount_ * axis;
  } else {
    const Vec3 arm = grabbed_W_ - start_.position;
    const auto at = meet(ray, {start_.position, axis});
    // Seen from its edge, a ring is turned along its tangent.
    if (std::abs(axis.dot(ray.direction)) < 0.2 || !at) {
      const Vec3 tangent = axis.cross(arm).normalized();
      const auto way = along_line(ray, grabbed_W_, tangent);
      if (!way) return;
      amount_ = *way / arm.norm();
    } else {
      const double turn = angle_about(axis, arm, *at - start_.position);
      amount_ += std::remainder(turn - amount_, 2.0 * std::numbers::pi);
    }
    pose.rotation = (Eigen::AngleAxisd(amount_, axis) * start_.rotation).normalized();
  }
  send(ui, pose, turns(dragged_));
}

void ToolHandles::send(Ui& ui, const Pose& pose, bool turned) {
  pose_ = pose;
  const Eigen::Vector4d c = pose.rotation.coeffs();
  const std::vector<double> turn{c[0], c[1], c[2], c[3]};
  const Command command =
      turned ? Command("tool", {{"to", pose.position}, {"turn", turn}, {"near", 1}})
             : Command("tool", {{"to", pose.position}, {"near", 1}});
  const Result result = ui.session.run(command);
  if (!result.ok) ui.report(result);
  if (const auto goal = ui.session.robot().tool_goal()) goal_ = *goal;
  ui.view.goal_missed = !goal_.reached;
}

std::optional<ImVec2> ToolHandles::grip(const std::string& part, const SceneFrame& frame) const {
  if (!seen_) return {};
  if (part == "knob") return frame.project(pose_.position);
  const int axis = part.back() - 'x';
  if (part.size() == 1) return frame.project(pose_.position + 0.95 * length_ * direction(axis));
  // A place of the ring that no other handle is near.
  const Part wanted = static_cast<Part>(4 + axis);
  for (const Vec3& point : ring(axis)) {
    const auto at = frame.project(point);
    const auto clear = [&](float dx, float dy) {
      return part_under(ImVec2(at->x + dx, at->y + dy), frame) == wanted;
    };
    if (at && clear(0, 0) && clear(4, 0) && clear(-4, 0) && clear(0, 4) && clear(0, -4)) return at;
  }
  return {};
}

std::string ToolHandles::words(const Ui& ui) const {
  const std::string& hits = ui.view.goal_hits;
  if (!goal_.reached) return goal_.sentence + (hits.empty() ? "" : "; hits: " + hits);
  if (!hits.empty()) return "hits: " + hits;
  if (!dragging()) return {};
  std::string text = dragged_ == Part::knob ? quantity_text(amount_, "m")
                     : shifts(dragged_)
                         ? std::string(1, static_cast<char>('x' + axis_of(dragged_))) + " " +
                               number_text(1e3 * amount_, 3) + " mm"
                         : number_text(amount_ * 180.0 / std::numbers::pi, 3) + "\xC2\xB0 about " +
                               static_cast<char>('x' + axis_of(dragged_));
  if (ui.snapshot->mode == RunMode::paused) text += " (held: Space lets the arm go there)";
  return text;
}

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
