#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "app/platform/platform.h"
#include "app/window/desktop_actions.h"
#include "app/window/fonts.h"
#include "app/window/gui_input.h"
#include "app/window/scene_pane.h"
#include "app/window/shown_document.h"
#include "app/window/window_film.h"
#include "app/window/window_painter.h"

struct ImGuiContext;

namespace pedicel::app {

struct DesktopOptions {
  std::filesystem::path preferences;  ///< where they are kept; empty: nowhere
  Theme theme = Theme::dark;          ///< without a file of preferences
  bool theme_given = false;           ///< `theme` goes before what the file says
};

/// The desktop: a session seen and led by hand. The same on every platform; on the null platform
/// everything but the pictures.
class Desktop {
 public:
  /// Both must outlive it. Throws std::runtime_error where the driver refuses our shaders.
  Desktop(Platform& platform, Session& session, const DesktopOptions& options);
  ~Desktop();
  Desktop(const Desktop&) = delete;
  Desktop& operator=(const Desktop&) = delete;

  /// One picture: input, panels, scene. False once the user quits.
  bool frame();
  Ui& ui() { return ui_; }
  const Layout& layout() const { return layout_; }
  ScenePane& scene() { return scene_; }
  /// The whole window, as it was painted last.
  const WindowPainter& window() const { return window_; }
  /// The file that the letters come from; empty: ImGui's own.
  const std::string& letters() const { return fonts_.file; }
  bool input_waits() const { return input_.has_more(); }

 private:
  struct Context;  // ImGui's, first made and last destroyed

  void follow_fonts();
  void follow_snapshot();

  Platform& platform_;
  std::filesystem::path preferences_path_;
  std::unique_ptr<Context> context_;
  Ui ui_;
  Preferences written_;
  GuiInput input_;
  Fonts fonts_;
  double fonts_for_ = 0.0;
  std::optional<Theme> theme_;
  Layout layout_;
  WindowPainter window_;
  ScenePane scene_;
  WindowFilm film_;
  DesktopActions actions_;
  ShownDocument shown_;
};

}  // namespace pedicel::app
