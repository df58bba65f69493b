#include "app/window/scene_pane.h"

#include <imgui.h>

#include <chrono>

#include "app/draw/pictures.h"
#include "app/session/live/organ_place.h"
#include "app/session/live/robot_goal.h"
#include "app/tools/draw_tool.h"
#include "app/window/measured_image.h"
#include "app/window/scene_labels.h"

namespace pedicel::app {

namespace {

constexpr double least_above_ground = 0.01;  // m, of the eye

double passed_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

ScenePane::ScenePane(Ui& ui, const render::GlFunctions* gl)
    : ui_(ui), draw_tool_(std::make_unique<DrawTool>()) {
  if (gl) canvas_ = std::make_unique<SceneCanvas>(*gl);
}

ScenePane::~ScenePane() = default;

void ScenePane::draw(const LayoutAreas& areas) {
  drawn_anew_ = false;
  seconds_ = 0.0;
  const ImVec2 size(areas.scene_max.x - areas.scene_min.x, areas.scene_max.y - areas.scene_min.y);
  if (size.x < 8 || size.y < 8) return;
  begin_window(areas);
  frame_ = {areas.scene_min, size, camera_.camera()};
  take_mouse();
  settle_camera();
  const auto start = std::chrono::steady_clock::now();
  fill_list();
  ui_.times.list = passed_since(start);
  if (canvas_) {
    show_picture(areas);
    seconds_ = passed_since(start);
    ui_.times.scene += 0.2 * (seconds_ - ui_.times.scene);
  }
  tool_handles_.draw(*ImGui::GetWindowDrawList(), ui_, frame_);
  draw_measured_image(ui_, frame_);
  draw_scene_labels(ui_, frame_, *draw_tool_);
  ImGui::End();
}

void ScenePane::begin_window(const LayoutAreas& areas) const {
  const ImVec2 size(areas.scene_max.x - areas.scene_min.x, areas.scene_max.y - areas.scene_min.y);
  ImGui::SetNextWindowPos(areas.scene_min);
  ImGui::SetNextWindowSize(size);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0f);
  ImGui::Begin("scene", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoBackground);
  ImGui::PopStyleVar(2);
  ImGui::InvisibleButton("picture", size,
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                             ImGuiButtonFlags_MouseButtonMiddle);
}

// Handles lie over everything, so they come first; the camera gets what no tool took.
void ScenePane::take_mouse() {
  const bool handle = tool_handles_.update(ui_, frame_);
  const bool tool = (ui_.dialog == Dialog::none && draw_tool_->update(ui_, frame_)) || handle;
  mouse_.update(ui_, camera_, frame_, view_.shapes(), tool);
}

void ScenePane::settle_camera() {
  if (const auto* assets = ui_.snapshot->assets.get();
      ui_.view.camera < 0 && assets && assets->scene.ground)
    camera_.stay_above(assets->scene.ground->height + least_above_ground);
  if (ui_.frame_box) {
    camera_.frame(*ui_.frame_box, frame_.size.x / frame_.size.y);
    ui_.frame_box.reset();
    ui_.view.camera = ui_.view.measured.camera = -1;
  }
  frame_.camera = camera_.camera();
  if (const discrepancy::Camera* through = looked_through(ui_))
    frame_.camera = camera_through(*through, frame_.size);
  ui_.view_eye = frame_.camera.eye, ui_.view_target = frame_.camera.target;
  ui_.view_fov = frame_.camera.field_of_view;
}

void ScenePane::fill_list() {
  list_.clear();
  ui_.view.goal_hits.clear();
  if (const auto ghost = robot_ghost(*ui_.snapshot))
    ui_.view.goal_hits = robot_contacts_.at_goal(*ui_.snapshot, ghost->links);
  measured_.update(ui_.view, ui_.session, *ui_.snapshot);
  measured_scene_.update(ui_.view, ui_.session);
  view_.fill(list_, *ui_.snapshot, ui_.view, ui_.selection, ui_.hover);
  measured_.add_to(list_);
  measured_scene_.add_to(list_);
  draw_tool_->add_to(list_, ui_, frame_);
}

void ScenePane::show_picture(const LayoutAreas& areas) {
  quality_.automatic = ui_.view.automatic_quality;
  if (!quality_.automatic) quality_.level = ui_.view.quality;
  drawn_anew_ = canvas_->draw(list_, frame_.camera, frame_.width(), frame_.height(), quality_,
                              ui_.view.shadows);
  ui_.view.quality = ui_.times.quality = quality_.level;
  ui_.times.triangles = canvas_->triangles();
  const auto texture =
      reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(canvas_->texture()));
  ImGui::GetWindowDrawList()->AddImage(texture, areas.scene_min, areas.scene_max, ImVec2(0, 1),
                                       ImVec2(1, 0));
}

std::optional<render::Image> ScenePane::picture(int width, int height) {
  if (!canvas_) return {};
  return canvas_->still(list_, frame_.camera, width, height);
}

void ScenePane::use_camera(int index) {
  if (!ui_.snapshot->assets) return;
  const auto& cameras = ui_.snapshot->assets->scene.cameras;
  if (index < 0 || index >= static_cast<int>(cameras.size())) return;
  const world::SceneCamera& camera = cameras[static_cast<std::size_t>(index)];
  // What follows something that is not there starts about the middle of the scene.
  const Vec3 middle = list_.bounds().isEmpty() ? Vec3(Vec3::Zero()) : Vec3(list_.bounds().center());
  camera_.set(camera_of(camera, place_of(*ui_.snapshot, camera.follow).value_or(middle)));
  ui_.view.camera = index;
  ui_.view.measured.camera = -1;
}

void ScenePane::follow_camera() {
  if (ui_.view.camera < 0 || !ui_.snapshot->assets) return;
  const auto& cameras = ui_.snapshot->assets->scene.cameras;
  const auto index = static_cast<std::size_t>(ui_.view.camera);
  if (index >= cameras.size() || cameras[index].follow.kind == world::Anchor::Kind::none) return;
  if (const auto place = place_of(*ui_.snapshot, cameras[index].follow))
    camera_.set(camera_of(cameras[index], *place));
}

}  // namespace pedicel::app
