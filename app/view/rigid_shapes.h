#pragma once

#include <memory>
#include <vector>

#include "app/session/live/snapshot.h"
#include "engine/render/draw_list.h"

namespace pedicel::app {

/// Links and bodies of a simulation as they look, each in its own frame: for drawing, for picking.
/// Made once and then followed.
class RigidShapes {
 public:
  struct Shape {
    render::DrawList list;
    Eigen::AlignedBox3d box;  ///< in its own frame, m
  };

  void follow(const Snapshot& snapshot);
  const std::vector<Shape>& links() const { return links_; }    ///< as Snapshot::robot.links
  const std::vector<Shape>& bodies() const { return bodies_; }  ///< as Snapshot::bodies

 private:
  std::shared_ptr<const simulation::SceneAssets> assets_;
  std::vector<Shape> links_, bodies_;
  std::vector<std::shared_ptr<const BodyInfo>> infos_;
};

}  // namespace pedicel::app
