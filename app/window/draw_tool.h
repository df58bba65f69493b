#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/panels/ui.h"
#include "app/window/drawn_shape.h"
#include "app/window/scene_mouse.h"
#include "render/draw_list.h"

namespace pedicel::app {

/// Drawing and editing plants in the scene: strokes, control points, fruits and leaves put on and
/// moved. What it does to the document are the session's commands.
class DrawTool {
 public:
  /// To be called right after the item that is the scene's picture. Whether the left button is the
  /// tool's now.
  bool update(Ui& ui, const SceneFrame& frame, const RigidShapes& shapes);
  /// The stroke in hand, the snap, control points of the chosen stem.
  void add_to(render::DrawList& list, const Ui& ui, const SceneFrame& frame) const;
  /// What the stroke is, or would be: "branch of truss/stem"; empty where nothing is to be said.
  std::string label() const;
  Vec3 label_place() const;  ///< m, W
  /// Drops the stroke or the drag in hand; false where there is none.
  bool cancel(Ui& ui);
  /// Takes away the chosen point, organ or stem.
  void remove_selected(Ui& ui);

 private:
  enum class Hand { idle, stroke, point, organ };

  void press(Ui& ui, const SceneFrame& frame);
  void begin_stroke(Ui& ui, const SceneFrame& frame);
  void extend_stroke(Ui& ui, const SceneFrame& frame, const RigidShapes& shapes);
  void end_stroke(Ui& ui);
  void put_organ(Ui& ui, const StemPlace& place);
  void move_point(Ui& ui, const SceneFrame& frame);
  void move_organ(Ui& ui);
  /// The control point of the chosen stem under the pointer; -1: none.
  int point_under(const Ui& ui, const SceneFrame& frame) const;
  Vec3 plane_normal(const Ui& ui, const SceneFrame& frame) const;
  void add_points(render::DrawList& list, const Ui& ui, const SceneFrame& frame) const;

  Hand hand_ = Hand::idle;
  std::optional<StemPlace> foot_;     // where the stroke begins, or would begin
  std::vector<Vec3> stroke_W_;        // m
  Vec3 start_W_ = Vec3::Zero();       // m, of the stroke, as it is in the simulation
  std::string plant_, stem_, organ_;  // whose point or organ is dragged
  int point_ = -1;
};

}  // namespace pedicel::app
