#include "pedicel/app/window/desktop_actions.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "pedicel/app/draw/pictures.h"
#include "pedicel/app/session/session_files.h"
#include "pedicel/app/session/session_robot.h"
#include "pedicel/app/ui/free_file_name.h"
#include "pedicel/app/window/gui_input.h"

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

}  // namespace pedicel::app
