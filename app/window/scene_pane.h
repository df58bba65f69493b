#pragma once

#include <memory>
#include <optional>

#include "app/panels/layout.h"
#include "app/session/live/robot_contacts.h"
#include "app/tools/tool_handles.h"
#include "app/view/measured_marks.h"
#include "app/view/measured_scene_marks.h"
#include "app/view/scene_canvas.h"
#include "app/view/scene_mouse.h"
#include "app/view/snapshot_view.h"

namespace pedicel::app {

class DrawTool;

/// The part of the window that shows the scene: its camera, its picture, and the tools that are
/// used in it.
class ScenePane {
 public:
  /// Keeps references to both. `gl` null: everything but the picture.
  ScenePane(Ui& ui, const render::GlFunctions* gl);
  ~ScenePane();

  /// Takes the mouse in, and draws the scene as it is now; between ImGui's frame begin and end.
  void draw(const LayoutAreas& areas);
  /// Whether draw() made another picture than the last one, and how long (s) the scene took.
  bool is_drawn_anew() const { return drawn_anew_; }
  double seconds() const { return seconds_; }
  /// A still one of the scene alone, in any size; nothing without `gl`.
  std::optional<render::Image> picture(int width, int height);

  ViewCamera& camera() { return camera_; }
  /// Sees the scene by one of its cameras. One that follows something goes with it until the view
  /// is led by hand.
  void use_camera(int index);
  /// Goes with what the scene's camera follows.
  void follow_camera();

  /// Where the scene is in the window, and how it is seen.
  const SceneFrame& frame() const { return frame_; }
  const ToolHandles& tool_handles() const { return tool_handles_; }
  DrawTool& draw_tool() { return *draw_tool_; }
  const RigidShapes& shapes() const { return view_.shapes(); }
  /// The box (m, W) of all that was drawn last; may be empty.
  Eigen::AlignedBox3d bounds() const { return list_.bounds(); }

 private:
  void begin_window(const LayoutAreas& areas) const;
  void take_mouse();
  void settle_camera();
  void fill_list();
  void show_picture(const LayoutAreas& areas);

  Ui& ui_;
  std::unique_ptr<SceneCanvas> canvas_;
  SnapshotView view_;
  MeasuredMarks measured_;
  MeasuredSceneMarks measured_scene_;
  RobotContacts robot_contacts_;
  render::DrawList list_;
  ViewCamera camera_;
  SceneMouse mouse_;
  std::unique_ptr<DrawTool> draw_tool_;
  ToolHandles tool_handles_;
  SceneFrame frame_;
  CanvasQuality quality_;
  bool drawn_anew_ = false;
  double seconds_ = 0.0;
};

}  // namespace pedicel::app
