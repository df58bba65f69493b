#include "app/view/scene_mouse.h"

#include <cmath>

#include "app/session/live/pull.h"
#include "app/ui/selection_follow.h"

namespace pedicel::app {

namespace {

constexpr float click_reach = 4.0f;  // px that a click may move
constexpr double slack_px = 6.0;     // px that a thin stem may be missed by

bool can_be_pulled(const Selection& s) {
  return s.kind == Selection::Kind::element || s.kind == Selection::Kind::fruit;
}

}  // namespace

std::optional<ImVec2> SceneFrame::project(const Vec3& p_W) const {
  const render::PixelPoint p = camera.project(p_W, width(), height());
  if (p.depth <= camera.near_plane) return {};
  return ImVec2(low.x + static_cast<float>(p.x), low.y + static_cast<float>(p.y));
}

/// The habits of conventions: Gazebo's and MuJoCo's, or Blender's.
SceneMouse::Drag SceneMouse::choose(const Ui& ui, int button, bool tool_has_left) const {
  const ImGuiIO& io = ImGui::GetIO();
  const bool left = button == 0, blender = ui.preferences.mouse == MousePreset::blender;
  if (left && io.KeyCtrl && io.KeyShift) return Drag::dolly;
  if (left && io.KeyCtrl && !tool_has_left) return Drag::pull;
  if (button == 1 && io.KeyCtrl && !io.KeyShift) return Drag::pull;
  if (tool_has_left && left) return io.KeyAlt ? Drag::orbit : Drag::none;
  if (blender && button == 2)
    return io.KeyShift ? Drag::pan : io.KeyCtrl ? Drag::dolly : Drag::orbit;
  if (blender && left) return Drag::none;
  return left && !io.KeyShift ? Drag::orbit : Drag::pan;
}

void SceneMouse::press(Ui& ui, const SceneFrame& frame, int button, bool tool_has_left) {
  button_ = button;
  pressed_at_ = ImGui::GetIO().MousePos;
  pressed_on_ = ui.hover;
  pressed_in_ = ui.snapshot;
  to_tip_ = button == 0 && ImGui::GetIO().KeyAlt;
  meant_ = choose(ui, button, tool_has_left);
  drag_ = Drag::undecided;
  if (meant_ != Drag::pull) return;
  if (!can_be_pulled(ui.hover)) {
    ui.say("Ctrl+drag pulls a plant: begin on a stem or a fruit");
    drag_ = Drag::none;
    return;
  }
  drag_ = Drag::pull;
  grabbed_W_ = ui.hover.place_W;
  PullPlace place{ui.hover.plant, ui.hover.element, ui.hover.back};
  place.stiffness = ui.preferences.pull_stiffness;
  ui.session.begin_pull(place, grabbed_W_);
  ui.selection = ui.hover;
  (void)frame;
}

/// The pulled point goes with the pointer in the plane across the view; with Shift up and down
/// only. With the right button it is pushed along the view: away from the eye while the pointer
/// goes up.
void SceneMouse::move_pull(Ui& ui, const SceneFrame& frame) {
  if (button_ == 1) {
    const Vec3 way = grabbed_W_ - frame.camera.eye;
    const double up = pressed_at_.y - ImGui::GetIO().MousePos.y;
    return ui.session.control().move_pull(grabbed_W_ + frame.angle(up) * way);
  }
  const DrawPlane across = view_plane(frame.camera.target - frame.camera.eye, grabbed_W_);
  const auto at = meet(frame.ray(ImGui::GetIO().MousePos), across);
  if (!at) return;
  Vec3 target = *at;
  if (ImGui::GetIO().KeyShift) target.head<2>() = grabbed_W_.head<2>();
  ui.session.control().move_pull(target);
}

void SceneMouse::move(Ui& ui, ViewCamera& camera, const SceneFrame& frame) {
  const ImGuiIO& io = ImGui::GetIO();
  const float way = std::hypot(io.MousePos.x - pressed_at_.x, io.MousePos.y - pressed_at_.y);
  ImVec2 moved = io.MouseDelta;
  if (drag_ == Drag::undecided && way > click_reach) {
    drag_ = meant_;
    moved = ImVec2(io.MousePos.x - pressed_at_.x, io.MousePos.y - pressed_at_.y);
  }
  const Preferences& p = ui.preferences;
  if (drag_ == Drag::orbit)
    camera.orbit(p.orbit_sensitivity * moved.x,
                 p.orbit_sensitivity * (p.invert_orbit ? -moved.y : moved.y), frame.height());
  if (drag_ == Drag::pan) camera.pan(moved.x, moved.y, frame.height());
  if (drag_ == Drag::dolly) camera.dolly(-0.04 * moved.y, camera.target());
  if (drag_ == Drag::pull) move_pull(ui, frame);
  if (drag_ == Drag::orbit || drag_ == Drag::pan || drag_ == Drag::dolly)
    ui.view.camera = ui.view.measured.camera = -1;
}

void SceneMouse::click(Ui& ui, ViewCamera& camera) {
  if (button_ != 0 && !(button_ == 1 && ImGui::IsMouseDoubleClicked(1))) return;
  pressed_on_ = follow_selection(pressed_on_, *pressed_in_, *ui.snapshot);
  ui.selection = pressed_on_;
  ui.selection.to_tip = to_tip_ && pressed_on_.kind == Selection::Kind::element;
  if (pressed_on_.kind == Selection::Kind::element || pressed_on_.kind == Selection::Kind::fruit)
    ui.session.control().log().watch(describe(pressed_on_, *ui.snapshot));
  (void)camera;
}

void SceneMouse::release(Ui& ui) {
  if (drag_ == Drag::pull) ui.session.control().end_pull();
  drag_ = Drag::none;
}

void SceneMouse::update(Ui& ui, ViewCamera& camera, const SceneFrame& frame,
                        const RigidShapes& shapes, bool tool_has_left) {
  const ImGuiIO& io = ImGui::GetIO();
  const bool hovered = ImGui::IsItemHovered(), held = drag_ != Drag::none;
  if (!held) ui.hover = {};
  if (hovered && !held) {
    ui.hover = pick(*ui.snapshot, shapes, frame.ray(io.MousePos), frame.angle(slack_px));
    for (const int button : {0, 1, 2})
      if (ImGui::IsMouseClicked(button)) press(ui, frame, button, tool_has_left);
    // Both habits: the left double click selects and centres, the right one centres. What a tool
    // has begun on would move away from under the pointer: its second press is no double click.
    const bool left_is_ours = !tool_has_left || io.KeyAlt;
    if ((left_is_ours && ImGui::IsMouseDoubleClicked(0)) || ImGui::IsMouseDoubleClicked(1)) {
      if (ui.hover) camera.look_at(ui.hover.place_W), ui.view.camera = ui.view.measured.camera = -1;
    }
  }
  if (hovered && io.MouseWheel != 0.0f) {
    const double steps = ui.preferences.invert_wheel ? -io.MouseWheel : io.MouseWheel;
    const geometry::Ray ray = frame.ray(io.MousePos);
    const Vec3 forward = (frame.camera.target - frame.camera.eye).normalized();
    // The place under the pointer; beside things at most as far as the target, so that the wheel
    // does not fly past it towards the floor behind.
    const double far = camera.distance() / std::max(ray.direction.dot(forward), 0.2);
    const double reach = ui.hover ? ui.hover.distance : std::min(ui.hover.distance, far);
    camera.dolly(steps, reach > 0.0 ? Vec3(ray.origin + reach * ray.direction) : camera.target());
    ui.view.camera = ui.view.measured.camera = -1;
  }
  if (drag_ == Drag::none) return;
  move(ui, camera, frame);
  if (ImGui::IsMouseDown(button_)) return;
  // In the draw mode a plain click is the tool's; with Alt it chooses there, too.
  if (drag_ == Drag::undecided && (to_tip_ || !(tool_has_left && button_ == 0))) click(ui, camera);
  release(ui);
}

}  // namespace pedicel::app
