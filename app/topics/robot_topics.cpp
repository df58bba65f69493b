#include "app/topics/robot_topics.h"

#include "engine/io/text_file.h"

namespace pedicel::app {

JointTopics::JointTopics(const simulation::Simulation& simulation, TopicSink& sink)
    : simulation_(simulation),
      layout_(simulation),
      states_(sink, "/joint_states", Delivery::sensor),
      commands_(sink, "/joint_commands", Delivery::sensor) {}

void JointTopics::tell(double time) {
  const robot::Robot& robot = simulation_.robot()->robot();
  ros::JointState state;
  state.header.stamp = ros::stamp_of(time);
  state.names = robot.model().joint_names();
  ros::JointState command = state;
  for (const simulation::Quantity& one : simulation::quantities()) {
    if (one.rows != simulation::Rows::joint || one.topic.empty()) continue;
    std::vector<double>& column = one.topic == "position"   ? state.position
                                  : one.topic == "velocity" ? state.velocity
                                                            : state.effort;
    column.resize(state.names.size());
    simulation::each_row(simulation_, layout_, one.rows, [&](const simulation::Row& row, int j) {
      one.read(row, &column[static_cast<std::size_t>(j)]);
    });
  }
  for (const robot::JointCommand& told : robot.motors().commands()) {
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
