#include <algorithm>

#include "pedicel/app/window/desktop_actions.h"
#include "pedicel/app/window/framing.h"

/// Actions that change how the scene is seen.
namespace pedicel::app {

void DesktopActions::perform_view(Action action) {
  Preferences& p = ui_.preferences;
  const int cameras =
      ui_.snapshot->assets ? static_cast<int>(ui_.snapshot->assets->scene.cameras.size()) : 0;
  switch (action) {
    case Action::frame_all:
      ui_.frame_box = scene_.bounds();
      break;
    case Action::frame_selection: {
      const Eigen::AlignedBox3d box = frame_of(ui_, scene_.shapes());
      ui_.frame_box = box.isEmpty() ? scene_.bounds() : box;
      break;
    }
    case Action::previous_camera:
      if (cameras) scene_.use_camera((std::max(ui_.view.camera, 0) + cameras - 1) % cameras);
      break;
    case Action::next_camera:
      if (cameras) scene_.use_camera((ui_.view.camera + 1) % cameras);
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

}  // namespace pedicel::app
