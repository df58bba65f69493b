#include "engine/robot/rigid_groups.h"

#include <Eigen/Eigenvalues>

#include "engine/robot/inertial_sum.h"

namespace pedicel::robot {

std::vector<RigidGroup> rigid_groups(const RobotDescription& robot, const KinematicModel& model) {
  std::vector<RigidGroup> groups;
  std::vector<int> group_of(robot.links.size(), -1);
  std::vector<Pose> X_GL(robot.links.size());
  const auto& elements = model.elements();
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const KinematicModel::Element& e = elements[i];
    if (e.parent < 0 || e.type != JointType::fixed) {
      RigidGroup group;
      group.link = e.link;
      group.element = static_cast<int>(i);
      if (e.parent >= 0) {
        group.parent = group_of[e.parent];
        group.X_PJ = X_GL[e.parent] * e.X_PJ;
      }
      group_of[e.link] = static_cast<int>(groups.size());
      groups.push_back(group);
    } else {
      group_of[e.link] = group_of[e.parent];
      X_GL[e.link] = X_GL[e.parent] * e.X_PJ;
    }
    RigidGroup& group = groups[group_of[e.link]];
    group.members.push_back({e.link, X_GL[e.link]});
    add_inertial(group.inertial, robot.links[e.link].inertial, X_GL[e.link]);
  }
  return groups;
}

PrincipalFrame principal_frame(const Inertial& inertial) {
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(inertial.inertia);
  Mat3 axes = solver.eigenvectors();
  if (axes.determinant() < 0.0) axes.col(2) = -axes.col(2);
  return {{inertial.com_L, Quat(axes).normalized()}, solver.eigenvalues()};
}

}  // namespace pedicel::robot
