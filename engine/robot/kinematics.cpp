#include "engine/robot/kinematics.h"

#include <algorithm>

#include "engine/core/check.h"

namespace pedicel::robot {

namespace {

using Element = KinematicModel::Element;

int index_in(const std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

Pose joint_motion(const Element& element, double position) {
  switch (element.type) {
    case JointType::prismatic:
      return {position * element.axis, Quat::Identity()};
    case JointType::fixed:
      return {};
    default:
      return {Vec3::Zero(), Quat(Eigen::AngleAxisd(position, element.axis))};
  }
}

/// The root, then links whose parent is already there, in the order of the file.
std::vector<Element> parents_first(const RobotDescription& robot) {
  std::vector<Element> elements(1);
  elements[0].link = robot.root;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    for (std::size_t j = 0; j < robot.joints.size(); ++j) {
      const Joint& joint = robot.joints[j];
      if (joint.parent != elements[i].link) continue;
      Element element;
      element.link = joint.child;
      element.parent = joint.parent;
      element.joint = static_cast<int>(j);
      element.type = joint.type;
      element.X_PJ = joint.X_PJ;
      element.axis = joint.axis;
      elements.push_back(element);
    }
  }
  PEDICEL_ASSERT(elements.size() == robot.links.size());
  return elements;
}

}  // namespace

KinematicModel::KinematicModel(const RobotDescription& robot, const Pose& X_WB)
    : elements_(parents_first(robot)), element_of_(robot.links.size()), X_WB_(X_WB) {
  for (const Link& link : robot.links) link_names_.push_back(link.name);
  for (std::size_t i = 0; i < elements_.size(); ++i)
    element_of_[elements_[i].link] = static_cast<int>(i);

  std::vector<int> dof_of(robot.joints.size(), -1);
  std::vector<const Joint*> free;
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    const Joint& joint = robot.joints[j];
    if (!joint.moves() || joint.mimic) continue;
    dof_of[j] = static_cast<int>(free.size());
    free.push_back(&joint);
    names_.push_back(joint.name);
    types_.push_back(joint.type);
  }
  for (Element& element : elements_) {
    if (element.joint < 0 || element.type == JointType::fixed) continue;
    const Joint& joint = robot.joints[element.joint];
    element.dof = dof_of[joint.mimic ? joint.mimic->source : element.joint];
    if (!joint.mimic) continue;
    element.multiplier = joint.mimic->multiplier;
    element.offset = joint.mimic->offset;
  }
  lower_.resize(dofs());
  upper_.resize(dofs());
  velocity_.resize(dofs());
  effort_.resize(dofs());
  for (int i = 0; i < dofs(); ++i) {
    lower_[i] = free[i]->lower;
    upper_[i] = free[i]->upper;
    velocity_[i] = free[i]->velocity;
    effort_[i] = free[i]->effort;
  }
}

int KinematicModel::joint_index(const std::string& name) const {
  return index_in(names_, name);
}

int KinematicModel::link_index(const std::string& name) const {
  return index_in(link_names_, name);
}

Eigen::VectorXd KinematicModel::clamped(const Eigen::VectorXd& q) const {
  return q.cwiseMax(lower_).cwiseMin(upper_);
}

void KinematicModel::link_poses(const Eigen::VectorXd& q, std::vector<Pose>& X_WL) const {
  X_WL.resize(elements_.size());
  for (const Element& e : elements_) {
    if (e.parent < 0) {
      X_WL[e.link] = X_WB_;
      continue;
    }
    const double position = e.dof < 0 ? 0.0 : e.multiplier * q[e.dof] + e.offset;
    X_WL[e.link] = X_WL[e.parent] * e.X_PJ * joint_motion(e, position);
  }
}

Pose KinematicModel::link_pose(const Eigen::VectorXd& q, int link) const {
  std::vector<Pose> poses;
  link_poses(q, poses);
  return poses[link];
}

void KinematicModel::link_velocities(const std::vector<Pose>& X_WL, const Eigen::VectorXd& qd,
                                     std::vector<Twist>& twists, const Twist& base) const {
  twists.resize(elements_.size());
  for (const Element& e : elements_) {
    if (e.parent < 0) {
      twists[e.link] = base;
      continue;
    }
    const Twist& parent = twists[e.parent];
    const Vec3 arm = X_WL[e.link].position - X_WL[e.parent].position;
    Twist twist{parent.linear + parent.angular.cross(arm), parent.angular};
    if (e.dof >= 0) {
      const Vec3 motion = X_WL[e.link].rotation * e.axis * (e.multiplier * qd[e.dof]);
      (e.type == JointType::prismatic ? twist.linear : twist.angular) += motion;
    }
    twists[e.link] = twist;
  }
}

void KinematicModel::jacobian(const std::vector<Pose>& X_WL, int link, const Vec3& point_L,
                              Jacobian& j) const {
  j.setZero(6, dofs());
  const Vec3 point_W = X_WL[link] * point_L;
  for (int at = link; at >= 0; at = elements_[element_of_[at]].parent) {
    const Element& e = elements_[element_of_[at]];
    if (e.dof < 0) continue;
    const Vec3 axis_W = X_WL[at].rotation * e.axis * e.multiplier;
    if (e.type == JointType::prismatic) {
      j.col(e.dof).head<3>() += axis_W;
    } else {
      j.col(e.dof).head<3>() += axis_W.cross(point_W - X_WL[at].position);
      j.col(e.dof).tail<3>() += axis_W;
    }
  }
}

Jacobian KinematicModel::jacobian(const Eigen::VectorXd& q, int link, const Vec3& point_L) const {
  std::vector<Pose> poses;
  link_poses(q, poses);
  Jacobian j;
  jacobian(poses, link, point_L, j);
  return j;
}

bool KinematicModel::periodic(int dof) const {
  int joints = 0;
  for (const Element& e : elements_)
    if (e.dof == dof) joints += e.type == JointType::prismatic ? 2 : 1;
  return joints == 1;
}

bool KinematicModel::moves(int dof, int link) const {
  for (int at = link; at >= 0; at = elements_[element_of_[at]].parent)
    if (elements_[element_of_[at]].dof == dof) return true;
  return false;
}

}  // namespace pedicel::robot
