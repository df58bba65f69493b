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
    : topic_(sink, "/wrist/wrench", Delivery::sensor),
      link_(wrist_link(*simulation.robot())),
      frame_(simulation.robot()->description().links[static_cast<std::size_t>(link_)].name),
      dt_(simulation.world().dt()),
      wanted_(std::max(1, static_cast<int>(std::lround(time_of_mean / dt_)))),
      wrench_(simulation, link_) {}

void WrenchTopic::after_step(double time) {
  sum_ += wrench_.carried();
  if (++steps_ < wanted_) return;
  const robot::Wrench mean = sum_ / steps_;
  const double middle = time - 0.5 * steps_ * dt_;
  topic_.tell(time, {{ros::stamp_of(middle), frame_},
                     {vector_of(mean.head<3>()), vector_of(mean.tail<3>())}});
  sum_.setZero();
  steps_ = 0;
}

}  // namespace pedicel::app
