#include <algorithm>

#include "pedicel/app/draw/pictures.h"
#include "pedicel/app/session/live/organ_place.h"
#include "pedicel/app/window/desktop.h"
#include "pedicel/app/window/framing.h"

/// Actions that change how the scene is seen.
namespace pedicel::app {

void Desktop::perform_view(Action action) {
  Preferences& p = ui_.preferences;
  const int cameras =
      ui_.snapshot->assets ? static_cast<int>(ui_.snapshot->assets->scene.cameras.size()) : 0;
  switch (action) {
    case Action::frame_all:
      ui_.frame_box = list_.bounds();
      break;
    case Action::frame_selection: {
      const Eigen::AlignedBox3d box = frame_of(ui_, view_.shapes());
      ui_.frame_box = box.isEmpty() ? list_.bounds() : box;
      break;
    }
    case Action::previous_camera:
      if (cameras) use_camera((std::max(ui_.view.camera, 0) + cameras - 1) % cameras);
      break;
    case Action::next_camera:
      if (cameras) use_camera((ui_.view.camera + 1) % cameras);
      break;
    case Action::panels: {
      const bool any = p.show_left || p.show_right || p.show_bottom;
      p.show_left = p.show_right = !any;
      p.show_bottom = false;
      break;
    }
    case Action::rods:
      ui_.view.rods = !ui_.view.rods;
      break;
    case Action::contacts:
      ui_.view.contacts = !ui_.view.contacts;
      break;
    case Action::frames:
      ui_.view.frames = !ui_.view.frames;
      break;
    case Action::tool_handles:
      ui_.view.tool_handles = !ui_.view.tool_handles;
      break;
    case Action::help:
      ui_.dialog = ui_.dialog == Dialog::help ? Dialog::none : Dialog::help;
      break;
    case Action::info:
      ui_.dialog = ui_.dialog == Dialog::info ? Dialog::none : Dialog::info;
      break;
    case Action::profiler:
      ui_.show_panel = "Profiler";
      break;
    case Action::plots:
      ui_.show_panel = "Plots";
      break;
    case Action::full_screen:
      platform_.set_full_screen(full_screen_ = !full_screen_);
      break;
    case Action::larger_text:
      p.font_scale = std::min(2.0, 1.1 * p.font_scale);
      break;
    case Action::smaller_text:
      p.font_scale = std::max(0.7, p.font_scale / 1.1);
      break;
    default:
      break;
  }
}

void Desktop::use_camera(int index) {
  if (!ui_.snapshot->assets) return;
  const auto& cameras = ui_.snapshot->assets->scene.cameras;
  if (index < 0 || index >= static_cast<int>(cameras.size())) return;
  const world::SceneCamera& camera = cameras[static_cast<std::size_t>(index)];
  // What follows something that is not there starts about the middle of the scene.
  const Vec3 middle = list_.bounds().isEmpty() ? Vec3(Vec3::Zero()) : Vec3(list_.bounds().center());
  camera_.set(camera_of(camera, place_of(*ui_.snapshot, camera.follow).value_or(middle)));
  ui_.view.camera = index;
}

void Desktop::follow_camera() {
  if (ui_.view.camera < 0 || !ui_.snapshot->assets) return;
  const auto& cameras = ui_.snapshot->assets->scene.cameras;
  const auto index = static_cast<std::size_t>(ui_.view.camera);
  if (index >= cameras.size() || cameras[index].follow.kind == world::Anchor::Kind::none) return;
  if (const auto place = place_of(*ui_.snapshot, cameras[index].follow))
    camera_.set(camera_of(cameras[index], *place));
}

}  // namespace pedicel::app
