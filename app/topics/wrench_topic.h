#pragma once

#include "app/topics/topic_source.h"

namespace pedicel::app {

/// The link whose carrier a wrench sensor would sit in: the child of the last joint before the tool
/// that moves and is not the gripper's; -1: there is none.
int wrist_link(const simulation::RobotControl& robot);

/// /wrist/wrench: what the wrist's link and all beyond it exert on what carries them, weight and
/// inertia included; N and N m about the origin of the link's frame, in that frame (frame_id). From
/// the momentum and the contacts of one step or some (of about 1 ms, one at least): it is their
/// mean, and the stamp is the middle of that time.
class WrenchTopic : public TopicSource {
 public:
  /// wrist_link() must not be -1.
  WrenchTopic(simulation::Simulation& simulation, TopicSink& sink);
  void begin(double time) override;
  void after_step(double time) override;

 private:
  struct Momentum {
    Vec3 linear = Vec3::Zero();   // kg m/s, W
    Vec3 angular = Vec3::Zero();  // kg m2/s, W, about the centre of mass
  };
  using Force = std::pair<Vec3, Vec3>;  // N, and N m about the link's origin, W
  Momentum momentum_of(int link) const;
  void add_weight_and_inertia(Force& sum);
  void add_plants(Force& sum) const;
  void add_bodies(Force& sum) const;
  Vec3 origin() const { return simulation_.robot()->link_pose(link_).position; }

  simulation::Simulation& simulation_;
  Teller<ros::WrenchStamped> wrench_;
  int link_ = 0;
  std::vector<char> beyond_;         // by link of the description
  std::vector<char> bullet_beyond_;  // by Bullet's link, the base first
  std::vector<Momentum> before_;     // by link
  Force sum_{Vec3::Zero(), Vec3::Zero()};
  int steps_ = 0, wanted_ = 1;
};

}  // namespace pedicel::app
