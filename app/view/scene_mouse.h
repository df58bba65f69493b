#pragma once

#include <imgui.h>

#include "app/ui/ui.h"
#include "app/view/picking.h"
#include "app/view/view_camera.h"

namespace pedicel::app {

/// The picture's place in the window, and the camera it is seen with.
struct SceneFrame {
  ImVec2 low, size;  ///< px
  render::Camera camera;

  int width() const { return std::max(1, static_cast<int>(size.x)); }
  int height() const { return std::max(1, static_cast<int>(size.y)); }
  /// The ray through a place of the window.
  geometry::Ray ray(const ImVec2& at) const {
    return camera.unproject(at.x - low.x, at.y - low.y, width(), height());
  }
  /// Where a point of the world lies in the window; nothing behind the eye.
  std::optional<ImVec2> project(const Vec3& p_W) const;
  /// What `px` is as an angle.
  double angle(double px) const { return px / camera.focal_length(height()); }
};

/// What the mouse does over the scene: camera, selection, pulling. Drawing is another's
/// (draw_tool.h), which takes the left button while its mode is on.
class SceneMouse {
 public:
  /// To be called right after the item that is the scene's picture. `tool_has_left`: the left
  /// button is the draw tool's.
  void update(Ui& ui, ViewCamera& camera, const SceneFrame& frame, const RigidShapes& shapes,
              bool tool_has_left);
  bool pulling() const { return drag_ == Drag::pull; }

 private:
  enum class Drag { none, undecided, orbit, pan, dolly, pull };

  Drag choose(const Ui& ui, int button, bool tool_has_left) const;
  void press(Ui& ui, const SceneFrame& frame, int button, bool tool_has_left);
  void move(Ui& ui, ViewCamera& camera, const SceneFrame& frame);
  void release(Ui& ui);
  void click(Ui& ui, ViewCamera& camera);
  void move_pull(Ui& ui, const SceneFrame& frame);

  Drag drag_ = Drag::none, meant_ = Drag::none;
  int button_ = 0;
  ImVec2 pressed_at_{0, 0};
  Vec3 grabbed_W_ = Vec3::Zero();  // m, of a pull
  Selection pressed_on_;
  std::shared_ptr<const Snapshot> pressed_in_;  // that it is of
  bool to_tip_ = false;                         // Alt was down: from there to the tip
};

}  // namespace pedicel::app
