#pragma once

#include <imgui.h>

#include <optional>
#include <string>

#include "app/ui/ui.h"
#include "app/view/rigid_shapes.h"
#include "app/view/scene_mouse.h"
#include "engine/render/draw_list.h"

namespace pedicel::app {

/// A string that is drawn from a stem or a fruit to where it ends: a stem or fruit, a place of
/// something that stands still, or a point in the air. Release adds it to the scene.
class TieStroke {
 public:
  /// From what is under the pointer. False where no string can begin there, which is said.
  bool begin(Ui& ui);
  void lead(const Ui& ui, const SceneFrame& frame, const ImVec2& to);
  void apply(Ui& ui);
  void clear() { from_.reset(), to_.reset(); }

  /// The string in hand, and how long it is.
  void add_to(render::DrawList& list) const;
  std::string label() const;
  const Vec3& place() const { return to_W_; }

 private:
  struct Foot {
    std::string organ;         // "PLANT/STEM", "PLANT/FRUIT"
    std::optional<double> at;  // from the stem's foot; none of a fruit
    Vec3 now_W;                // m
  };
  static std::optional<Foot> foot_of(const Ui& ui, const Selection& hit);

  std::optional<Foot> from_, to_;  // the other end, where that is on a plant
  Vec3 to_W_ = Vec3::Zero();
  std::string moves_;  // what it would end at, where that moves
  RigidShapes shapes_;
};

}  // namespace pedicel::app
