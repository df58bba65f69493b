#include "app/window/desktop_actions.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/draw/pictures.h"
#include "app/editors/point_editor.h"
#include "app/editors/thing_editor.h"
#include "app/platform/platform.h"
#include "app/session/session_files.h"
#include "app/session/session_robot.h"
#include "app/tools/draw_tool.h"
#include "app/ui/free_file_name.h"
#include "app/ui/ui.h"
#include "app/window/framing.h"
#include "app/window/gui_input.h"
#include "app/window/scene_pane.h"
#include "app/window/window_film.h"
#include "app/window/window_painter.h"

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

/// Undo, redo, copy, cut, paste, choose all: those of the text that is typed.
bool edits_text(const Binding& binding) {
  constexpr std::array keys{Key::z, Key::y, Key::c, Key::x, Key::v, Key::a};
  return binding.control && std::ranges::find(keys, binding.key) != keys.end();
}

/// What neither the document nor the run nor the view behind a dialog feels.
bool acts_over_dialogs(Action action) {
  switch (action) {
    case Action::cancel:
    case Action::reload:  // of a file that could not be read
    case Action::help:
    case Action::info:
    case Action::screenshot:
    case Action::video:
    case Action::full_screen:
    case Action::larger_text:
    case Action::smaller_text:
    case Action::quit:
      return true;
    default:
      return false;
  }
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

void DesktopActions::ask_by_keys() {
  const ImGuiIO& io = ImGui::GetIO();
  for (const Binding& binding : bindings()) {
    if (ui_.dialog != Dialog::none && !acts_over_dialogs(binding.action)) continue;
    // While a text is typed, only what cannot be part of it.
    if (types_text() && (edits_text(binding) || (!binding.control && binding.key < Key::f1)))
      continue;
    if (binding.control != io.KeyCtrl || binding.shift != io.KeyShift) continue;
    const bool repeats = binding.action == Action::step || binding.action == Action::step_back;
    if (ImGui::IsKeyPressed(static_cast<int>(binding.key), repeats)) ui_.ask(binding.action);
  }
}

void DesktopActions::perform_all() {
  while (!ui_.actions.empty()) {
    const Action action = ui_.actions.front();
    ui_.actions.pop_front();
    perform(action);
  }
}

void DesktopActions::perform(Action action) {
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
    case Action::reset: {
      // The scene's program would take the robot out of the hand that leads it.
      const bool led = ui_.session.robot().is_led();
      ui_.run(Command("reset", {}));
      if (led && ui_.snapshot->robot.present) {
        ui_.run(Command("stop robot", {}));
        ui_.say("The robot stays in your hand; its program begins by Restart in the panel Robot");
      }
      break;
    }
    case Action::reload:
      ui_.session.files().reload();
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
      ui_.leave_document([this] {
        ui_.session.files().give_up_edits();
        quits_ = true;
      });
      break;
    default:
      perform_file(action);
      perform_view(action);
      perform_edit(action);
  }
}

void DesktopActions::perform_file(Action action) {
  switch (action) {
    case Action::open:
      ui_.dialog = Dialog::open;
      break;
    case Action::save_as:
      ui_.dialog = Dialog::save_as;
      break;
    case Action::save:
      ui_.save();
      break;
    case Action::new_document:
      ui_.leave_document([this] { ui_.session.files().open_empty(); });
      break;
    case Action::screenshot:
      take_screenshot();
      break;
    case Action::video:
      film_.toggle();
      break;
    default:
      break;
  }
}

void DesktopActions::take_screenshot() {
  const auto picture = ui_.view.panels_in_pictures ? window_.picture() : scene_.picture(1280, 720);
  if (!picture) return;
  const std::filesystem::path path = free_file_name(ui_.output_stem().string(), ".png");
  try {
    render::write_png(path, *picture);
    ui_.say("picture in " + std::filesystem::absolute(path).string());
  } catch (const render::OutputError& error) {
    ui_.say(error.what());
  }
}

void DesktopActions::perform_edit(Action action) {
  const auto walk = [&](auto neighbour) {
    if (ui_.selection.kind != Selection::Kind::element) return;
    const auto& model = *ui_.snapshot->plants[static_cast<std::size_t>(ui_.selection.plant)].model;
    ui_.selection.element = neighbour(model, ui_.selection.element);
    ui_.selection.to_tip = false;
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
    case Action::point_kind:
      change_point_kind(ui_);
      break;
    case Action::insert_point:
      insert_point(ui_);
      break;
    case Action::smooth:
      smooth_points(ui_);
      break;
    case Action::select_child:
      if (!scene_.draw_tool().thicken(1.0)) walk(child_element);
      break;
    case Action::select_parent:
      if (!scene_.draw_tool().thicken(-1.0)) walk(parent_element);
      break;
    case Action::duplicate:
      duplicate_thing(ui_);
      break;
    case Action::remove:
      if (!remove_thing(ui_)) scene_.draw_tool().remove_selected(ui_);
      break;
    case Action::accept:
      break;
    case Action::cancel:
      if (GImGui->OpenPopupStack.Size > 0)
        ImGui::ClosePopupToLevel(0, false);  // a list, a menu
      else if (ui_.dialog != Dialog::none)
        ui_.dialog = Dialog::none;
      else if (scene_.draw_tool().cancel(ui_))
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
