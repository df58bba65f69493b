#include "pedicel/app/tools/tool_handles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pedicel/app/session/session_robot.h"
#include "pedicel/app/ui/widgets.h"
#include "pedicel/app/view/picking.h"

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

}  // namespace pedicel::app
