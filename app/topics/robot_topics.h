#pragma once

#include "app/topics/topic_source.h"
#include "engine/ros_messages/sensor_messages.h"
#include "plugins/simulation/quantities.h"

/// What the robot tells. Scenes without one have none of these.
namespace pedicel::app {

/// /joint_states: positions, velocities and motor torques of the joints that move by themselves;
/// /joint_commands: what the controller tells their motors.
class JointTopics : public TopicSource {
 public:
  /// Of a scene with a robot.
  JointTopics(const simulation::Simulation& simulation, TopicSink& sink);
  void tell(double time) override;

 private:
  const simulation::Simulation& simulation_;
  const simulation::RowLayout layout_;
  Teller<ros::JointState> states_, commands_;
};

/// /robot_description: the URDF's text.
class DescriptionTopic : public TopicSource {
 public:
  DescriptionTopic(const simulation::RobotControl& robot, TopicSink& sink);
  void begin(double time) override;

 private:
  const simulation::RobotControl& robot_;
  Teller<ros::String> text_;
};

}  // namespace pedicel::app
