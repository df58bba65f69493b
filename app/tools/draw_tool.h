#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/session/live/draw_surface.h"
#include "app/tools/drawn_shape.h"
#include "app/tools/radius_handles.h"
#include "app/tools/tie_stroke.h"
#include "app/tools/trim_brush.h"
#include "app/ui/ui.h"
#include "app/view/scene_mouse.h"
#include "engine/render/draw_list.h"
#include "plugins/plant/plant_pick.h"

namespace pedicel::app {

/// Drawing and editing plants in the scene: strokes, control points and their radii, fruits and
/// leaves put on and moved, strings, cuts. What it does to the document are the session's commands.
class DrawTool {
 public:
  /// To be called right after the item that is the scene's picture. Whether the left button is the
  /// tool's now. Takes the wheel while a stroke is in hand.
  bool update(Ui& ui, const SceneFrame& frame);
  /// The stroke in hand, the snap, control points of the chosen stem with their radii, cuts.
  void add_to(render::DrawList& list, const Ui& ui, const SceneFrame& frame) const;
  /// What the stroke is, or would be: "on truss/stem"; empty where nothing is to be said.
  std::string label(const Ui& ui) const;
  Vec3 label_place() const;  ///< m, W
  /// Drops the stroke or the drag in hand; false where there is none.
  bool cancel(Ui& ui);
  /// Takes away the chosen point, organ or stem, or what lies beyond a place.
  void remove_selected(Ui& ui);
  /// From here on the stroke in hand gets thicker by so many steps (< 0: thinner); false where none
  /// is in hand.
  bool thicken(double steps);

 private:
  enum class Hand { idle, stroke, point, radius, organ, trim, tie };

  void press(Ui& ui, const SceneFrame& frame);
  bool press_handle(Ui& ui, const SceneFrame& frame);
  bool press_organ(Ui& ui, const SceneFrame& frame);
  void drag(Ui& ui, const SceneFrame& frame);
  void release(Ui& ui);
  void begin_stroke(Ui& ui, const SceneFrame& frame);
  void extend_stroke(const Ui& ui, const SceneFrame& frame);
  void end_stroke(Ui& ui);
  void put_organ(Ui& ui, const StemHit& place);
  void move_point(Ui& ui, const SceneFrame& frame);
  void move_radius(Ui& ui);
  void move_organ(Ui& ui, const SceneFrame& frame);
  /// The control point of the chosen stem under the pointer; -1: none.
  int point_under(const Ui& ui, const SceneFrame& frame) const;
  void choose_point(Ui& ui, int point);
  void add_points(render::DrawList& list, const Ui& ui, const SceneFrame& frame) const;
  void add_stroke(render::DrawList& list, const Ui& ui, const SceneFrame& frame) const;

  Hand hand_ = Hand::idle;
  std::optional<StemHit> foot_;  // where the stroke begins, or would begin

  // A stroke: places (m, W) with how thick it is there (1: as the options say).
  std::vector<plant::StrokeSample> stroke_;
  double thickness_ = 1.0;
  std::unique_ptr<Surfaces> surfaces_;  // only for strokes that creep over things
  std::optional<StrokeProjector> projector_;

  // A drag.
  std::string plant_, stem_, organ_;  // whose point, radius or organ
  int point_ = -1;
  RadiusHandle handle_;
  ImVec2 pressed_at_{0, 0}, grip_{0, 0};    // px; grip: from the organ's foot to the pointer
  float travel_ = 0.0f;                     // px, the farthest that the pointer was from the press
  std::optional<plant::StemPicker> stems_;  // of the plant whose organ is dragged
  Vec3 moved_ = Vec3::Zero();               // m, by the simulation from the drawing, at the organ
  TrimBrush trim_;
  TieStroke tie_;
};

}  // namespace pedicel::app
