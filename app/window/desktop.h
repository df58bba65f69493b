#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "pedicel/app/panels/layout.h"
#include "pedicel/app/platform/platform.h"
#include "pedicel/app/session/film.h"
#include "pedicel/app/session/live/robot_contacts.h"
#include "pedicel/app/tools/tool_handles.h"
#include "pedicel/app/view/measured_marks.h"
#include "pedicel/app/view/scene_canvas.h"
#include "pedicel/app/view/scene_mouse.h"
#include "pedicel/app/view/snapshot_view.h"
#include "pedicel/app/window/fonts.h"
#include "pedicel/app/window/gui_input.h"
#include "pedicel/app/window/gui_painter.h"
#include "pedicel/render/video.h"

struct ImGuiContext;

namespace pedicel::app {

class DrawTool;

struct DesktopOptions {
  std::filesystem::path preferences;  ///< where they are kept; empty: nowhere
  Theme theme = Theme::dark;          ///< without a file of preferences
  bool theme_given = false;           ///< `theme` goes before what the file says
};

/// The desktop: a session seen and led by hand. The same on every platform; on the null platform
/// everything but the pictures.
class Desktop : private FilmMaker {
 public:
  /// Both must outlive it. Throws std::runtime_error where the driver refuses our shaders.
  Desktop(Platform& platform, Session& session, const DesktopOptions& options);
  ~Desktop() override;
  Desktop(const Desktop&) = delete;
  Desktop& operator=(const Desktop&) = delete;

  /// One picture: input, panels, scene. False once the user quits.
  bool frame();
  Ui& ui() { return ui_; }
  ViewCamera& camera() { return camera_; }
  const Layout& layout() const { return layout_; }
  /// Where the scene is in the window, and how it is seen.
  const SceneFrame& scene() const { return scene_; }
  const ToolHandles& tool_handles() const { return tool_handles_; }
  /// The file that the letters come from; empty: ImGui's own.
  const std::string& letters() const { return fonts_.file; }
  bool input_waits() const { return input_.has_more(); }

  /// Sees the scene by one of its cameras. One that follows something goes with it until the view
  /// is led by hand.
  void use_camera(int index);

  /// The last picture with the interface; a still one of the scene alone, in any size. Nothing on
  /// the null platform.
  std::optional<render::Image> window_picture() const;
  std::optional<render::Image> scene_picture(int width, int height);

 private:
  struct Context;  // ImGui's, first made and last destroyed

  void follow_fonts();
  void follow_snapshot();
  void follow_document();
  void frame_new_plant();
  void frame_new_robot();
  void follow_camera();
  void keys();
  void draw_scene(const LayoutAreas& areas);
  void draw_labels();
  void paint();
  bool has_to_paint();
  void perform_all();
  void perform(Action action);
  void perform_file(Action action);
  void perform_view(Action action);
  void perform_edit(Action action);
  void take_screenshot();
  void toggle_video();
  // Films: the session's commands begin and end them.
  void begin(const FilmRequest& request) override;
  bool running() const override { return video_ != nullptr; }
  void add() override;
  std::string end() override;
  render::Image film_picture();
  void lead_film();
  void drop_film();

  Platform& platform_;
  std::filesystem::path preferences_path_;
  std::unique_ptr<Context> context_;
  Ui ui_;
  Preferences written_;
  GuiInput input_;
  Fonts fonts_;
  double fonts_for_ = 0.0;
  std::optional<Theme> theme_;
  std::unique_ptr<GuiPainter> painter_;
  std::unique_ptr<SceneCanvas> canvas_;
  std::unique_ptr<render::RenderTarget> target_;
  Layout layout_;
  SnapshotView view_;
  MeasuredMarks measured_;
  RobotContacts robot_contacts_;
  render::DrawList list_;
  ViewCamera camera_;
  SceneMouse mouse_;
  std::unique_ptr<DrawTool> draw_tool_;
  ToolHandles tool_handles_;
  SceneFrame scene_;
  CanvasQuality quality_;
  std::filesystem::path shown_path_;
  std::set<std::string> shown_plants_;  // that were in the picture last
  bool framed_ = false, quits_ = false, full_screen_ = false;
  std::unique_ptr<render::VideoWriter> video_;
  FilmRequest film_;
  double next_video_picture_ = 0.0;  // s, of the platform's clock
  double film_time_ = 0.0;           // s, simulated, that the run may go to
  bool picture_due_ = false, film_runs_ = false;
  bool scene_drawn_ = false;       // anew, in this picture
  double scene_seconds_ = 0.0;     // s, that it took in this picture
  std::uint64_t painted_key_ = 0;  // of the interface as it was painted last
  double painted_at_ = -1.0;       // s
};

}  // namespace pedicel::app
