#include <algorithm>

#include "engine/ros_messages/cdr.h"
#include "engine/ros_messages/common_messages.h"
#include "plugins/simulation/body_contacts.h"
#include "plugins/simulation/colliders.h"
#include "plugins/simulation/instrument.h"
#include "plugins/simulation/scene_assets.h"
#include "plugins/simulation/simulation.h"

namespace pedicel::simulation {

namespace {

std::vector<int> links_beyond(const robot::RobotDescription& robot, int link) {
  std::vector<int> all = {link};
  for (std::size_t i = 0; i < all.size(); ++i)
    for (const robot::Joint& joint : robot.joints)
      if (joint.parent == all[i]) all.push_back(joint.child);
  return all;
}

/// As the scene's effects have it; plain of a sensor that the scene does not have.
Gauge gauge_of(const Simulation& simulation, const world::SceneInstrument& scene) {
  Gauge gauge;
  if (!simulation.assets()->effects) return gauge;
  auto of_effects = simulation.assets()->effects->state.gauges.begin();
  for (const world::SceneInstrument& one : of_kind(simulation.scene(), scene.kind())) {
    if (one.name == scene.name) {
      gauge = {of_effects->gain, Eigen::VectorXd(6)};
      gauge.bias << of_effects->force, of_effects->moment;
    }
    ++of_effects;
  }
  return gauge;
}

/// A force sensor at a link. At a wrist it is what the link and all beyond it exert on what carries
/// it: their weight, less what their motion takes, and what plants and rigid bodies exert on them.
/// At a fingertip it is what plants and bodies exert on the link. In the link's frame, about its
/// origin.
class WrenchSensor : public Instrument {
 public:
  WrenchSensor(Simulation& simulation, const world::SceneInstrument& scene)
      : Instrument(scene, simulation.scene().seed, scene.name, gauge_of(simulation, scene)),
        robot_(*simulation.robot()),
        plants_(simulation.plant_step()),
        gravity_(simulation.scene().gravity),
        link_(link_of(simulation, scene)),
        beyond_(links_beyond(robot_.description(), link_)) {
    for (const int link : beyond_) before_.push_back(robot_.link_pose(link));
  }

  std::vector<ros::Definition> message_type() const override {
    return ros::definitions_of<ros::WrenchStamped>();
  }
  std::string message() const override {
    const Eigen::VectorXd& now = reading();
    return ros::to_cdr(ros::WrenchStamped{{ros::stamp_of(reading_time()), scene().link},
                                          {{now[0], now[1], now[2]}, {now[3], now[4], now[5]}}});
  }

 protected:
  void measure(world::SimWorld& world, Eigen::VectorXd& exact) override {
    const double dt = world.dt();
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();  // W, about the world's origin
    Vec3 momentum = Vec3::Zero(), spin = Vec3::Zero();
    const std::size_t links = scene().touch ? 1 : beyond_.size();
    for (std::size_t i = 0; i < links; ++i) {
      const coupling::ContactSum touch = plants_.contacts().sum_of_link(robot_body, beyond_[i]);
      force += touch.force_W;
      moment += touch.place_W.cross(touch.force_W) + touch.moment_W;
      if (scene().touch) break;
      const robot::Inertial& mass =
          robot_.description().links[static_cast<std::size_t>(beyond_[i])].inertial;
      const Pose now = robot_.link_pose(beyond_[i]);
      const Vec3 com = now * mass.com_L, velocity = (com - before_[i] * mass.com_L) / dt;
      const Eigen::AngleAxisd turn(now.rotation * before_[i].rotation.conjugate());
      const double angle = turn.angle() > M_PI ? turn.angle() - 2.0 * M_PI : turn.angle();
      const Mat3 axes = now.rotation.toRotationMatrix();
      force += mass.mass * gravity_;
      moment += com.cross(mass.mass * gravity_);
      momentum += mass.mass * velocity;
      spin += com.cross(mass.mass * velocity) +
              axes * mass.inertia * axes.transpose() * (angle / dt * turn.axis());
      before_[i] = now;
    }
    add_bodies(world, force, moment);
    if (moved_ && !scene().touch) {
      force -= (momentum - momentum_) / dt;
      moment -= (spin - spin_) / dt;
    }
    momentum_ = momentum, spin_ = spin, moved_ = true;
    const Pose at = robot_.link_pose(link_);
    exact << at.rotation.conjugate() * force,
        at.rotation.conjugate() * (moment - at.position.cross(force));
  }

 private:
  void add_bodies(world::SimWorld& world, Vec3& force, Vec3& moment) const {
    each_body_contact(
        world, robot_.robot(), [&](int link, const Vec3& force_W, const Vec3& place_W) {
          const bool felt = scene().touch ? link == link_ : std::ranges::count(beyond_, link) > 0;
          if (!felt) return;
          force += force_W;
          moment += place_W.cross(force_W);
        });
  }

  RobotControl& robot_;
  const PlantStep& plants_;
  Vec3 gravity_;
  int link_ = -1;
  const std::vector<int> beyond_;                       // links: it and all that hangs on it
  std::vector<Pose> before_;                            // of beyond_, W
  Vec3 momentum_ = Vec3::Zero(), spin_ = Vec3::Zero();  // N s; N m s, about the world's origin
  bool moved_ = false;                                  // momentum_ is known
};

}  // namespace

std::unique_ptr<Instrument> make_wrench(Simulation& simulation,
                                        const world::SceneInstrument& scene) {
  return std::make_unique<WrenchSensor>(simulation, scene);
}

}  // namespace pedicel::simulation
