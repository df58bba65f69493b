#include <algorithm>
#include <array>
#include <cmath>

#include "app/pictures.h"
#include "app/window/desktop.h"
#include "app/window/draw_tool.h"
#include "session/organ_place.h"

namespace pedicel::app {

namespace {

constexpr std::array<double, 9> speeds = {0.01, 0.05, 0.1, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0};

double next_speed(double now, int direction) {
  if (now == 0.0) return direction < 0 ? speeds.back() : 0.0;
  auto at = std::ranges::lower_bound(speeds, now * (1.0 - 1e-9));
  if (direction > 0)
    at = *at > now * (1.0 + 1e-9) ? at : at + 1;
  else if (at != speeds.begin())
    --at;
  return at == speeds.end() ? 0.0 : *at;
}

/// Neighbours in the tree of organs: the organ that carries one, or the first that grows from it.
int parent_element(const cosserat::RodModel& model, int element) {
  const int organ = model.elements[static_cast<std::size_t>(element)].organ;
  for (int e = element; e >= 0; e = model.elements[static_cast<std::size_t>(e)].parent)
    if (model.elements[static_cast<std::size_t>(e)].organ != organ) return e;
  return element;
}

int child_element(const cosserat::RodModel& model, int element) {
  const int organ = model.elements[static_cast<std::size_t>(element)].organ;
  for (int e = 0; e < model.size(); ++e) {
    const int parent = model.elements[static_cast<std::size_t>(e)].parent;
    if (parent >= 0 && model.elements[static_cast<std::size_t>(parent)].organ == organ &&
        model.elements[static_cast<std::size_t>(e)].organ != organ)
      return e;
  }
  return element;
}

}  // namespace

void Desktop::perform_all() {
  while (!ui_.actions.empty()) {
    const Action action = ui_.actions.front();
    ui_.actions.pop_front();
    perform(action);
  }
}

void Desktop::perform(Action action) {
  RunControl& control = ui_.session.control();
  switch (action) {
    case Action::play_pause:
      if (ui_.snapshot->mode == RunMode::playing)
        control.pause();
      else
        control.play();
      break;
    case Action::step:
      control.step();
      break;
    case Action::step_back:
      control.step_back();
      break;
    case Action::reset:
      control.reset();
      break;
    case Action::reload:
      ui_.session.reload();
      break;
    case Action::faster:
      control.set_speed(next_speed(ui_.snapshot->speed, 1));
      break;
    case Action::slower:
      control.set_speed(next_speed(ui_.snapshot->speed, -1));
      break;
    case Action::real_time:
      control.set_speed(1.0);
      break;
    case Action::quit:
      quits_ = true;
      break;
    default:
      perform_file(action);
      perform_view(action);
      perform_edit(action);
  }
}

void Desktop::perform_file(Action action) {
  switch (action) {
    case Action::open:
      ui_.dialog = Dialog::open;
      break;
    case Action::save_as:
      ui_.dialog = Dialog::save_as;
      break;
    case Action::save: {
      if (ui_.session.path().empty()) {
        ui_.dialog = Dialog::save_as;
        break;
      }
      const Result saved = ui_.session.save();
      ui_.say(saved.ok && saved.text.empty() ? "saved" : saved.text);
      break;
    }
    case Action::new_document:
      if (ui_.session.dirty())
        ui_.say("not saved yet: save first, or undo the edits");
      else
        ui_.session.open_empty();
      break;
    case Action::screenshot:
      take_screenshot();
      break;
    case Action::video:
      toggle_video();
      break;
    default:
      break;
  }
}

void Desktop::perform_view(Action action) {
  Preferences& p = ui_.preferences;
  const int cameras =
      ui_.snapshot->assets ? static_cast<int>(ui_.snapshot->assets->scene.cameras.size()) : 0;
  switch (action) {
    case Action::frame_all:
      ui_.frame_box = list_.bounds();
      break;
    case Action::frame_selection: {
      const Eigen::AlignedBox3d box = bounds_of(ui_.selection, *ui_.snapshot, view_.shapes());
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

void Desktop::perform_edit(Action action) {
  const auto walk = [&](auto neighbour) {
    if (ui_.selection.kind != Selection::Kind::element) return;
    const auto& model = *ui_.snapshot->plants[static_cast<std::size_t>(ui_.selection.plant)].model;
    ui_.selection.element = neighbour(model, ui_.selection.element);
  };
  switch (action) {
    case Action::undo:
      ui_.report(ui_.session.undo());
      break;
    case Action::redo:
      ui_.report(ui_.session.redo());
      break;
    case Action::draw_mode:
      ui_.draw.on = !ui_.draw.on;
      if (ui_.draw.on) ui_.show_panel = "Draw";
      break;
    case Action::select_child:
      walk(child_element);
      break;
    case Action::select_parent:
      walk(parent_element);
      break;
    case Action::remove:
      draw_tool_->remove_selected(ui_);
      break;
    case Action::accept:
      break;
    case Action::cancel:
      if (ui_.dialog != Dialog::none)
        ui_.dialog = Dialog::none;
      else if (draw_tool_->cancel(ui_))
        break;
      else if (ui_.draw.on)
        ui_.draw.on = false;
      else
        ui_.selection = {};
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

void Desktop::take_screenshot() {
  const auto picture = window_picture();
  if (!picture) return;
  const std::filesystem::path path = free_name("pedicel", ".png");
  try {
    render::write_png(path, *picture);
    ui_.say("picture in " + std::filesystem::absolute(path).string());
  } catch (const render::OutputError& error) {
    ui_.say(error.what());
  }
}

}  // namespace pedicel::app
