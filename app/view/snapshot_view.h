#pragma once

#include <memory>
#include <vector>

#include "app/draw/plant_drawing.h"
#include "app/session/live/snapshot.h"
#include "app/ui/view_state.h"
#include "app/view/rigid_shapes.h"

namespace pedicel::app {

/// Turns snapshots into draw lists. What stays the same from one to the next is prepared once.
class SnapshotView {
 public:
  /// Fills an empty list: plants, robot, bodies, ground, and what `view` asks for.
  void fill(render::DrawList& list, const Snapshot& snapshot, const ViewState& view,
            const Selection& selection, const Selection& hover);
  /// Links and bodies of the snapshot that was filled in last.
  const RigidShapes& shapes() const { return shapes_; }

 private:
  struct Plant {
    std::shared_ptr<const cosserat::RodModel> model;
    std::shared_ptr<const simulation::SceneAssets> assets;
    std::unique_ptr<PlantDrawing> drawing;
  };
  void follow(const Snapshot& snapshot);
  void add_ghost(render::DrawList& list, const Snapshot& snapshot, const ViewState& view) const;
  std::vector<render::Colour> colours(const Snapshot& snapshot, int plant,
                                      const ViewState& view) const;

  std::vector<Plant> plants_;
  RigidShapes shapes_;
};

/// What encloses a thing, for the camera; empty where it is not there any more.
Eigen::AlignedBox3d bounds_of(const Selection& selection, const Snapshot& snapshot,
                              const RigidShapes& shapes);

}  // namespace pedicel::app
