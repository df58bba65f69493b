#pragma once

#include "app/topics/topic_source.h"
#include "plugins/simulation/instrument.h"

namespace pedicel::app {

/// The link whose carrier a wrench sensor would sit in: the child of the last joint before the tool
/// that moves and is not the gripper's; -1: there is none.
int wrist_link(const simulation::RobotControl& robot);

/// /wrist/wrench: a force sensor of every robot, without noise. A message is the mean of some steps
/// (of about 1 ms, one at least), and its stamp is the middle of that time.
class WrenchTopic : public TopicSource {
 public:
  /// wrist_link() must not be -1.
  WrenchTopic(simulation::Simulation& simulation, TopicSink& sink);
  void after_step(double time) override;

 private:
  simulation::Simulation& simulation_;
  Teller<ros::WrenchStamped> wrench_;
  std::unique_ptr<simulation::Instrument> sensor_;
  Eigen::VectorXd sum_ = Eigen::VectorXd::Zero(6);
  int steps_ = 0, wanted_ = 1;
};

}  // namespace pedicel::app
