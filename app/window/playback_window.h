#pragma once

#include <memory>

#include "app/platform/platform.h"
#include "app/playback/log_film.h"
#include "app/view/scene_canvas.h"
#include "app/view/view_camera.h"
#include "app/window/fonts.h"
#include "app/window/gui_input.h"
#include "app/window/window_painter.h"

namespace pedicel::app {

/// A window that plays a log: a view to turn, a time line, play and pause. Space plays, Left and
/// Right go a picture back and on, Home and End to the ends, + and - change the speed, F shows all,
/// Ctrl+Q quits.
class PlaybackWindow {
 public:
  /// Both must outlive it.
  PlaybackWindow(Platform& platform, const LogFilm& log);
  ~PlaybackWindow();
  PlaybackWindow(const PlaybackWindow&) = delete;
  PlaybackWindow& operator=(const PlaybackWindow&) = delete;

  /// One picture. False once the user quits.
  bool frame();
  double time() const { return time_; }  ///< s, of the log
  bool playing() const { return playing_; }
  const WindowPainter& window() const { return window_; }

 private:
  struct Context;  // ImGui's, first made and last destroyed
  void follow_keys();
  void advance(double seconds);
  void draw_scene(float height);
  void draw_time_line(float height);
  void lead_camera(int height);

  Platform& platform_;
  const LogFilm& log_;
  std::unique_ptr<Context> context_;
  GuiInput input_;
  Fonts fonts_;
  WindowPainter window_;
  std::unique_ptr<SceneCanvas> canvas_;  // null without OpenGL
  CanvasQuality quality_;
  ViewCamera camera_;
  render::DrawList list_;
  double time_ = 0.0, speed_ = 1.0, now_ = 0.0;  // s, 1, s
  bool playing_ = true, framed_ = false, drawn_anew_ = false, quits_ = false;
};

}  // namespace pedicel::app
