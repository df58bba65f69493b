#pragma once

#include "app/ui/view_state.h"
#include "engine/render/draw_list.h"

namespace pedicel::app {

class MeasuredScene;
class Session;
struct SceneInstant;

/// A measured run of a robot in the picture of the scene: the robot as its joints were measured,
/// plants as a model has them, markers and their errors.
class MeasuredSceneMarks {
 public:
  /// Makes what add_to() adds, and says in `view` what it stands for.
  void update(ViewState& view, const Session& session);
  void add_to(render::DrawList& list) const;

 private:
  void add_plants(const MeasuredScene& scene, const SceneInstant& instant);
  void add_markers(const SceneInstant& instant, const MeasuredView& view);

  render::DrawList list_;
};

}  // namespace pedicel::app
