#include "app/topics/robot_topics.h"

#include "engine/io/text_file.h"

namespace pedicel::app {

JointTopics::JointTopics(const simulation::RobotControl& robot, TopicSink& sink)
    : robot_(robot),
      states_(sink, "/joint_states", Delivery::sensor),
      commands_(sink, "/joint_commands", Delivery::sensor) {}

void JointTopics::tell(double time) {
  const robot::Robot& robot = robot_.robot();
  ros::JointState state;
  state.header.stamp = ros::stamp_of(time);
  state.names = robot.model().joint_names();
  ros::JointState command = state;
  for (int i = 0; i < robot.model().dofs(); ++i) {
    state.position.push_back(robot.positions()[i]);
    state.velocity.push_back(robot.velocities()[i]);
    state.effort.push_back(robot.motor_torques()[i]);
    const robot::JointCommand& told = robot.motors().commands()[static_cast<std::size_t>(i)];
    command.position.push_back(told.position);
    command.velocity.push_back(told.velocity);
    command.effort.push_back(told.torque);
  }
  states_.tell(time, state);
  // A sequence that is empty says that nothing of that kind is told.
  const auto any = [&](robot::ControlMode mode) {
    return std::ranges::any_of(robot.motors().commands(),
                               [&](const robot::JointCommand& one) { return one.mode == mode; });
  };
  if (!any(robot::ControlMode::position)) command.position.clear();
  if (!any(robot::ControlMode::position) && !any(robot::ControlMode::velocity))
    command.velocity.clear();
  if (!any(robot::ControlMode::torque)) command.effort.clear();
  commands_.tell(time, command);
}

DescriptionTopic::DescriptionTopic(const simulation::RobotControl& robot, TopicSink& sink)
    : robot_(robot),
      text_(sink, "/robot_description", Delivery::latched,
            {{"file", std::filesystem::absolute(robot.description().file).string()}}) {}

void DescriptionTopic::begin(double time) {
  text_.tell(time, {io::read_text_file(robot_.description().file)});
}

}  // namespace pedicel::app
