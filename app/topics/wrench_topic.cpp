#include "app/topics/wrench_topic.h"

#include <algorithm>
#include <cmath>

namespace pedicel::app {

namespace {

constexpr double time_of_mean = 1.0e-3;  // s

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
    : simulation_(simulation), wrench_(sink, "/wrist/wrench", Delivery::sensor) {
  const world::InstrumentKind& kind = world::instrument_kind("wrench");
  world::SceneInstrument scene(kind);
  const simulation::RobotControl& robot = *simulation.robot();
  scene.link = robot.description().links[static_cast<std::size_t>(wrist_link(robot))].name;
  sensor_ = simulation::maker_of(kind)(simulation, scene);
  wanted_ = std::max(1, static_cast<int>(std::lround(time_of_mean / simulation.world().dt())));
}

void WrenchTopic::after_step(double time) {
  sensor_->step(simulation_.world());
  sum_ += sensor_->exact();
  if (++steps_ < wanted_) return;
  const Eigen::VectorXd mean = sum_ / steps_;
  const double middle = time - 0.5 * steps_ * simulation_.world().dt();
  wrench_.tell(time, {{ros::stamp_of(middle), sensor_->scene().link},
                      {vector_of(mean.head<3>()), vector_of(mean.tail<3>())}});
  sum_.setZero();
  steps_ = 0;
}

}  // namespace pedicel::app
