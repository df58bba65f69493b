#include "app/topics/wrench_topic.h"

#include <algorithm>
#include <cmath>

#include "engine/robot/multibody.h"
#include "engine/robot/rigid_groups.h"
#include "plugins/simulation/colliders.h"

namespace pedicel::app {

namespace {

constexpr double time_of_mean = 1.0e-3;  // s

Vec3 vector_of_bullet(const btVector3& v) {
  return {v.x(), v.y(), v.z()};
}

}  // namespace

int wrist_link(const simulation::RobotControl& robot) {
  const robot::RobotDescription& description = robot.description();
  const auto& joints = robot.robot().model().joint_names();
  const std::string gripper =
      robot.gripper() >= 0 ? joints[static_cast<std::size_t>(robot.gripper())] : "";
  for (int link = robot.tool_link(); link >= 0;) {
    const auto carrying = std::ranges::find(description.joints, link, &robot::Joint::child);
    if (carrying == description.joints.end()) return -1;
    if (carrying->moves() && carrying->name != gripper && !carrying->mimic) return link;
    link = carrying->parent;
  }
  return -1;
}

WrenchTopic::WrenchTopic(simulation::Simulation& simulation, TopicSink& sink)
    : simulation_(simulation),
      wrench_(sink, "/wrist/wrench", Delivery::sensor),
      link_(wrist_link(*simulation.robot())) {
  const robot::Robot& robot = simulation.robot()->robot();
  beyond_.assign(robot.description().links.size(), 0);
  beyond_[static_cast<std::size_t>(link_)] = 1;
  // Parents come before their children.
  for (const robot::KinematicModel::Element& e : robot.model().elements())
    if (e.parent >= 0 && beyond_[static_cast<std::size_t>(e.parent)])
      beyond_[static_cast<std::size_t>(e.link)] = 1;
  for (const robot::RigidGroup& group : robot::rigid_groups(robot.description(), robot.model()))
    bullet_beyond_.push_back(beyond_[static_cast<std::size_t>(group.link)]);
  wanted_ = std::max(1, static_cast<int>(std::lround(time_of_mean / simulation.world().dt())));
}

WrenchTopic::Momentum WrenchTopic::momentum_of(int link) const {
  const simulation::RobotControl& robot = *simulation_.robot();
  const robot::Inertial& own = robot.description().links[static_cast<std::size_t>(link)].inertial;
  const robot::Twist& twist = robot.robot().link_twists()[static_cast<std::size_t>(link)];
  const Mat3 r = robot.link_pose(link).rotation.toRotationMatrix();
  return {own.mass * (twist.linear + twist.angular.cross(r * own.com_L)),
          r * own.inertia * r.transpose() * twist.angular};
}

void WrenchTopic::begin(double) {
  before_.resize(beyond_.size());
  for (std::size_t l = 0; l < beyond_.size(); ++l) before_[l] = momentum_of(static_cast<int>(l));
}

void WrenchTopic::add_weight_and_inertia(Force& sum) {
  const simulation::RobotControl& robot = *simulation_.robot();
  for (std::size_t l = 0; l < beyond_.size(); ++l) {
    if (!beyond_[l]) continue;
    const robot::Inertial& own = robot.description().links[l].inertial;
    const Momentum now = momentum_of(static_cast<int>(l));
    const double dt = simulation_.world().dt();
    const Vec3 force =
        own.mass * simulation_.scene().gravity - (now.linear - before_[l].linear) / dt;
    const Vec3 centre = robot.link_pose(static_cast<int>(l)) * own.com_L;
    sum.first += force;
    sum.second += (centre - origin()).cross(force) - (now.angular - before_[l].angular) / dt;
    before_[l] = now;
  }
}

void WrenchTopic::add_plants(Force& sum) const {
  const coupling::ColliderSet& colliders = simulation_.colliders();
  for (int c = 0; c < colliders.size(); ++c) {
    const coupling::Collider& collider = colliders.collider(c);
    if (collider.body != simulation::robot_body ||
        !beyond_[static_cast<std::size_t>(collider.link)])
      continue;
    const coupling::ContactSum& touch =
        simulation_.plant_step().contacts().colliders()[static_cast<std::size_t>(c)];
    if (touch.contacts == 0) continue;
    sum.first += touch.force_W;
    sum.second += touch.moment_W + (touch.place_W - origin()).cross(touch.force_W);
  }
}

// Rigid bodies, among them fruits that came off: Bullet's contacts.
void WrenchTopic::add_bodies(Force& sum) const {
  const btMultiBody& own = simulation_.robot()->robot().multibody();
  const auto is_beyond = [&](const btCollisionObject* object) {
    const btMultiBodyLinkCollider* collider = btMultiBodyLinkCollider::upcast(object);
    return collider && collider->m_multiBody == &own &&
           bullet_beyond_[static_cast<std::size_t>(collider->m_link + 1)];
  };
  btDispatcher& dispatcher = *simulation_.world().bullet().getDispatcher();
  for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
    const btPersistentManifold& touch = *dispatcher.getManifoldByIndexInternal(m);
    const bool a = is_beyond(touch.getBody0()), b = is_beyond(touch.getBody1());
    if (a == b) continue;
    for (int k = 0; k < touch.getNumContacts(); ++k) {
      const btManifoldPoint& point = touch.getContactPoint(k);
      const btVector3 impulse = point.m_appliedImpulse * point.m_normalWorldOnB +
                                point.m_appliedImpulseLateral1 * point.m_lateralFrictionDir1 +
                                point.m_appliedImpulseLateral2 * point.m_lateralFrictionDir2;
      const Vec3 force = vector_of_bullet(impulse) * ((a ? 1.0 : -1.0) / simulation_.world().dt());
      const Vec3 place =
          vector_of_bullet(a ? point.getPositionWorldOnA() : point.getPositionWorldOnB());
      sum.first += force;
      sum.second += (place - origin()).cross(force);
    }
  }
}

void WrenchTopic::after_step(double time) {
  Force force{Vec3::Zero(), Vec3::Zero()};
  add_weight_and_inertia(force);
  add_plants(force);
  add_bodies(force);
  const Quat back = simulation_.robot()->link_pose(link_).rotation.conjugate();
  sum_.first += back * force.first;
  sum_.second += back * force.second;
  if (++steps_ < wanted_) return;
  const double middle = time - 0.5 * steps_ * simulation_.world().dt();
  ros::WrenchStamped message;
  message.header.stamp = ros::stamp_of(middle);
  message.header.frame_id =
      simulation_.robot()->description().links[static_cast<std::size_t>(link_)].name;
  message.wrench = {vector_of(sum_.first / steps_), vector_of(sum_.second / steps_)};
  wrench_.tell(time, message);
  sum_ = {Vec3::Zero(), Vec3::Zero()};
  steps_ = 0;
}

}  // namespace pedicel::app
