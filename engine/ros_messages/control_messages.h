#pragma once

#include "engine/ros_messages/sensor_messages.h"

/// trajectory_msgs and control_msgs: what arms are told, and named values of named things.
namespace pedicel::ros {

struct JointTrajectoryPoint {
  static constexpr const char* name = "trajectory_msgs/msg/JointTrajectoryPoint";
  std::vector<double> positions, velocities, accelerations, effort;
  Duration time_from_start;
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit("positions", self.positions);
    visit("velocities", self.velocities);
    visit("accelerations", self.accelerations);
    visit("effort", self.effort);
    visit("time_from_start", self.time_from_start);
  }
};

struct JointTrajectory {
  static constexpr const char* name = "trajectory_msgs/msg/JointTrajectory";
  Header header;
  std::vector<std::string> joint_names;
  std::vector<JointTrajectoryPoint> points;
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit("header", self.header);
    visit("joint_names", self.joint_names);
    visit("points", self.points);
  }
};

struct InterfaceValue {
  static constexpr const char* name = "control_msgs/msg/InterfaceValue";
  std::vector<std::string> interface_names;
  std::vector<double> values;
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit("interface_names", self.interface_names);
    visit("values", self.values);
  }
};

struct DynamicJointState {
  static constexpr const char* name = "control_msgs/msg/DynamicJointState";
  Header header;
  std::vector<std::string> joint_names;
  std::vector<InterfaceValue> interface_values;
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit("header", self.header);
    visit("joint_names", self.joint_names);
    visit("interface_values", self.interface_values);
  }
};

}  // namespace pedicel::ros
