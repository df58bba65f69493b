#include "engine/robot/carried_links.h"

#include <algorithm>

namespace pedicel::robot {

namespace {

Wrench in_frame(const Pose& at, const Vec3& force_W, const Vec3& moment_W) {
  Wrench wrench;
  wrench << at.rotation.conjugate() * force_W, at.rotation.conjugate() * moment_W;
  return wrench;
}

}  // namespace

CarriedLinks::CarriedLinks(const RobotDescription& robot, int link) : links_{link} {
  for (std::size_t i = 0; i < links_.size(); ++i) {
    for (const Joint& joint : robot.joints)
      if (joint.parent == links_[i]) links_.push_back(joint.child);
    inertials_.push_back(robot.links[static_cast<std::size_t>(links_[i])].inertial);
  }
}

bool CarriedLinks::contain(int link) const {
  return std::ranges::find(links_, link) != links_.end();
}

std::vector<CarriedLinks::Momentum> CarriedLinks::momentum(const std::vector<Pose>& X_WL,
                                                           const std::vector<Twist>& twists) const {
  std::vector<Momentum> all(links_.size());
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const auto link = static_cast<std::size_t>(links_[i]);
    const Inertial& own = inertials_[i];
    const Twist& twist = twists[link];
    const Mat3 r = X_WL[link].rotation.toRotationMatrix();
    all[i] = {own.mass * (twist.linear + twist.angular.cross(r * own.com_L)),
              r * own.inertia * r.transpose() * twist.angular};
  }
  return all;
}

Wrench CarriedLinks::weight(const std::vector<Pose>& X_WL, const std::vector<Momentum>& before,
                            const std::vector<Momentum>& now, double dt,
                            const Vec3& gravity_W) const {
  const Pose& at = X_WL[static_cast<std::size_t>(link())];
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const Vec3 centre = X_WL[static_cast<std::size_t>(links_[i])] * inertials_[i].com_L;
    const Vec3 one = inertials_[i].mass * gravity_W - (now[i].linear - before[i].linear) / dt;
    force += one;
    moment += (centre - at.position).cross(one) - (now[i].angular - before[i].angular) / dt;
  }
  return in_frame(at, force, moment);
}

Wrench CarriedLinks::felt(const std::vector<Pose>& X_WL,
                          std::span<const LinkReaction> forces) const {
  const Pose& at = X_WL[static_cast<std::size_t>(link())];
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  for (const LinkReaction& one : forces) {
    if (!contain(one.link)) continue;
    force += one.force_W;
    moment += one.moment_W + (one.point_W - at.position).cross(one.force_W);
  }
  return in_frame(at, force, moment);
}

}  // namespace pedicel::robot
