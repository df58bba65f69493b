#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "app/session/session_files.h"
#include "app/window/desktop.h"
#include "tests/support/places.h"

namespace pedicel::app {

/// A desktop off screen with a small plant in it, led by real input events.
class Desk {
 public:
  explicit Desk(int width = 1280, int height = 720, double scale = 1.0,
                const std::string& platform = "offscreen") {
    PlatformOptions where;
    where.size = {width, height};
    where.scale = scale;
    std::string why;
    if (platform == "null")
      platform_ = open_null(where);
    else
      platform_ = open_offscreen(where, why);
    if (!platform_) {
      why_ = why;
      return;
    }
    session_ = std::make_unique<Session>();
    desktop_ = std::make_unique<Desktop>(*platform_, *session_, DesktopOptions{});
    desktop_->ui().preferences.seen_hint = true;
  }

  bool available() const { return desktop_ != nullptr; }
  const std::string& why() const { return why_; }
  Desktop& desktop() { return *desktop_; }
  Ui& ui() { return desktop_->ui(); }
  Session& session() { return *session_; }

  void open(const std::filesystem::path& path) {
    session_->files().open(path);
    settle();
  }
  /// So that a picture costs little.
  void draw_coarsely() {
    ui().view.automatic_quality = false;
    ui().view.quality = CanvasQuality::coarsest;
  }
  /// A scene with nothing in it, drawn coarsely.
  void open_empty() {
    draw_coarsely();
    session_->files().open_empty();
    settle();
  }
  /// Lets the simulation do what it was told, and the window show it.
  void settle() {
    session_->control().wait();
    frames(3);
  }
  void frames(int count) {
    for (int i = 0; i < count; ++i) desktop_->frame();
  }
  /// Frames until all input was taken in, and one more.
  void drain() {
    do desktop_->frame();
    while (desktop_->input_waits());
    frames(2);
  }

  /// Without a picture in between.
  void send(const InputEvent& event) { platform_->send(event); }
  void move(double x, double y) { platform_->send(InputEvent::move(x, y)), drain(); }
  void button(int which, bool down) { platform_->send(InputEvent::press(which, down)), drain(); }
  void click(double x, double y, int which = 0) {
    move(x, y);
    platform_->send(InputEvent::press(which, true));
    platform_->send(InputEvent::press(which, false));
    drain();
    frames(25);  // two clicks are not a double click
  }
  void drag(const std::vector<ImVec2>& way, int which = 0) {
    move(way.front().x, way.front().y);
    button(which, true);
    for (const ImVec2& at : way) move(at.x, at.y);
    button(which, false);
  }
  void hold(Key key, bool down) { platform_->send(InputEvent::press(key, down)), drain(); }
  void key(Key key, bool control = false, bool shift = false) {
    if (control) hold(Key::left_control, true);
    if (shift) hold(Key::left_shift, true);
    hold(key, true);
    hold(key, false);
    if (shift) hold(Key::left_shift, false);
    if (control) hold(Key::left_control, false);
  }
  void type(const std::string& text) { platform_->send(InputEvent::typed(text)), drain(); }
  void wheel(double steps) { platform_->send(InputEvent::wheel(steps)), drain(); }
  void drop(const std::string& path) { platform_->send(InputEvent::drop(path)), drain(); }

  /// Where a point of the world is in the window.
  ImVec2 at(const Vec3& p_W) {
    return desktop_->scene().frame().project(p_W).value_or(ImVec2(-1, -1));
  }
  void show(const std::string& panel) {
    ui().show_panel = panel;
    frames(6);  // a scroll bar comes after the first, and then all gets narrower
  }
  std::shared_ptr<const Snapshot> snapshot() { return session_->snapshot(); }
  const render::GlFunctions* gl() const { return platform_->gl(); }
  render::Image picture() { return desktop_->window().picture().value(); }

 private:
  std::unique_ptr<ScriptedPlatform> platform_;
  std::unique_ptr<Session> session_;
  std::unique_ptr<Desktop> desktop_;
  std::string why_;
};

inline std::filesystem::path scene_file(const std::string& name) {
  return pedicel::test::source_folder() / "assets" / "scenes" / name;
}

/// A child window of a dock's tab: "left", "Plants".
inline const ImGuiWindow* panel_window(const std::string& dock, const std::string& panel) {
  (void)panel;
  for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows) {
    const std::string name = window->Name;
    if (window->WasActive && name.starts_with(dock + "/") &&
        name.find("/body") != std::string::npos)
      return window;
  }
  return nullptr;
}

/// Pixels of a part of a picture that are not its most common colour, as a share.
inline double drawn_share(const render::Image& image, const ImRect& area) {
  std::map<std::array<int, 3>, long> colours;
  long all = 0, most = 0;
  for (int y = std::max(0, static_cast<int>(area.Min.y));
       y < std::min(image.height, static_cast<int>(area.Max.y)); ++y)
    for (int x = std::max(0, static_cast<int>(area.Min.x));
         x < std::min(image.width, static_cast<int>(area.Max.x)); ++x) {
      const std::uint8_t* p = image.at(x, y);
      most = std::max(most, ++colours[{p[0], p[1], p[2]}]);
      ++all;
    }
  return all ? 1.0 - static_cast<double>(most) / static_cast<double>(all) : 0.0;
}

}  // namespace pedicel::app
