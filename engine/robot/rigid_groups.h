#pragma once

#include <vector>

#include "engine/robot/kinematics.h"

namespace pedicel::robot {

/// Links that fixed joints hold together move as one body: fewer Bullet links, and frames without
/// mass (which Featherstone's algorithm cannot take as moving links) need no special case.
struct RigidGroup {
  int link = 0;     ///< the link that leads the group; its frame G is the group's
  int parent = -1;  ///< group, -1 for the base
  int element = 0;  ///< element of the model whose joint carries the group
  Pose X_PJ;        ///< joint frame at position 0 in the parent group's frame
  struct Member {
    int link;
    Pose X_GL;
  };
  std::vector<Member> members;
  Inertial inertial;  ///< of all members, in the group's frame
};

/// Groups of a robot, parents first; group 0 holds the root.
std::vector<RigidGroup> rigid_groups(const RobotDescription& robot, const KinematicModel& model);

/// The frame at the centre of mass along the principal axes of inertia, in which Bullet works.
struct PrincipalFrame {
  Pose X_GC;
  Vec3 inertia = Vec3::Zero();  ///< kg m2, diagonal
};
PrincipalFrame principal_frame(const Inertial& inertial);

}  // namespace pedicel::robot
