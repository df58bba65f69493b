#pragma once

#include <vector>

#include "engine/world/sim_world.h"
#include "plugins/coupling/collider.h"
#include "plugins/coupling/contact_report.h"
#include "plugins/simulation/robot_control.h"

namespace pedicel::simulation {

/// The other half of two-way coupling: what the plants felt of the robot's links and of rigid
/// bodies acts on those within the same step, and the plants are told how far those give way
/// (plugins/coupling/README.md, "Two-way coupling").
class Reaction {
 public:
  /// `robot` may be null. All must outlive this object. Bodies of the
  /// world before `first_body` do not feel plants.
  Reaction(world::SimWorld& world, RobotControl* robot, coupling::ColliderSet& colliders,
           int first_body = 0);

  /// After the plants moved. Does not allocate once warm.
  void act(const coupling::ContactReport& contacts);

 private:
  void push_robot(const coupling::ContactReport& contacts);
  void push_bodies(const coupling::ContactReport& contacts);
  double give_of(int collider, const std::vector<coupling::ContactSum>& sums) const;
  bool is_gripping(int collider) const;
  Vec3 place_of(int collider, const std::vector<coupling::ContactSum>& sums) const;

  world::SimWorld& world_;
  RobotControl* robot_;
  coupling::ColliderSet& colliders_;
  int first_body_;
  std::vector<robot::LinkReaction> reactions_;
};

}  // namespace pedicel::simulation
