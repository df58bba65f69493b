#pragma once

#include "app/topics/topic_source.h"
#include "plugins/simulation/link_wrench.h"

namespace pedicel::app {

/// The link whose carrier a wrench sensor would sit in: the child of the last joint before the tool
/// that moves and is not the gripper's; -1: there is none.
int wrist_link(const simulation::RobotControl& robot);

/// /wrist/wrench: simulation::LinkWrench at the wrist's link. It is the mean of one step or some
/// (of about 1 ms, one at least), and the stamp is the middle of that time.
class WrenchTopic : public TopicSource {
 public:
  /// wrist_link() must not be -1.
  WrenchTopic(simulation::Simulation& simulation, TopicSink& sink);
  void after_step(double time) override;

 private:
  Teller<ros::WrenchStamped> topic_;
  int link_ = 0;
  std::string frame_;
  double dt_;  // s
  int steps_ = 0, wanted_ = 1;
  simulation::LinkWrench wrench_;
  robot::Wrench sum_ = robot::Wrench::Zero();
};

}  // namespace pedicel::app
