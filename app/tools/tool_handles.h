#pragma once

#include <imgui.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/session/live/robot_goal.h"
#include "app/ui/ui.h"
#include "app/view/scene_mouse.h"

namespace pedicel::app {

/// Handles at the place that the robot's tool is asked to go to, as RViz and Gazebo have them:
/// three arrows to shift it along, three rings to turn it by, a knob to move it across the view.
/// Dragging one sends the session's command `tool`. Seen while the Robot panel is in front or a
/// link is chosen, until they are put away.
class ToolHandles {
 public:
  /// To be called right after the item that is the scene's picture. Whether the left button is
  /// theirs now.
  bool update(Ui& ui, const SceneFrame& frame);
  void draw(ImDrawList& list, const Ui& ui, const SceneFrame& frame) const;
  bool dragging() const { return dragged_ != Part::none; }
  /// Where a handle can be taken hold of, px of the window: "x", "ry", "knob"; nothing where it is
  /// not seen.
  std::optional<ImVec2> grip(const std::string& part, const SceneFrame& frame) const;

 private:
  enum class Part { none, x, y, z, turn_x, turn_y, turn_z, knob };

  bool visible(const Ui& ui) const;
  static int axis_of(Part part) { return (static_cast<int>(part) - 1) % 3; }
  static bool shifts(Part part) { return part >= Part::x && part <= Part::z; }
  static bool turns(Part part) { return part >= Part::turn_x && part <= Part::turn_z; }
  Vec3 direction(int axis) const;
  std::vector<Vec3> ring(int axis) const;
  Part part_under(const ImVec2& mouse, const SceneFrame& frame) const;
  void press(const SceneFrame& frame, Part part);
  void move(Ui& ui, const SceneFrame& frame);
  void send(Ui& ui, const Pose& pose, bool turned);
  std::string words(const Ui& ui) const;
  void draw_arrow(ImDrawList& list, const SceneFrame& frame, int axis) const;
  void draw_ring(ImDrawList& list, const SceneFrame& frame, int axis) const;
  void draw_missed(ImDrawList& list, const SceneFrame& frame) const;

  bool seen_ = false;
  ToolGoal goal_;
  Pose pose_;            // X_W, of the handles
  Quat axes_;            // of the arrows and rings, in the world
  double length_ = 0.1;  // m, of an arrow
  float scale_ = 1.0f;   // px
  Part under_ = Part::none, dragged_ = Part::none;
  Pose start_;  // X_W, when the drag began
  Quat start_axes_;
  Vec3 grabbed_W_ = Vec3::Zero();  // m, the place that was taken hold of
  double amount_ = 0.0;            // m or rad, of the drag
};

}  // namespace pedicel::app
