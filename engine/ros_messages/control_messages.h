#pragma once

#include "engine/ros_messages/sensor_messages.h"

/// trajectory_msgs and control_msgs: what arms are told, and named values of named things.
namespace pedicel::ros {

struct JointTrajectoryPoint {
  static constexpr const char* name = "trajectory_msgs/msg/JointTrajectoryPoint";
  std::vector<double> positions, velocities, accelerations, effort;
  Duration time_from_start;
  PEDICEL_FIELDS(positions, velocities, accelerations, effort, time_from_start)
};

struct JointTrajectory {
  static constexpr const char* name = "trajectory_msgs/msg/JointTrajectory";
  Header header;
  std::vector<std::string> joint_names;
  std::vector<JointTrajectoryPoint> points;
  PEDICEL_FIELDS(header, joint_names, points)
};

struct InterfaceValue {
  static constexpr const char* name = "control_msgs/msg/InterfaceValue";
  std::vector<std::string> interface_names;
  std::vector<double> values;
  PEDICEL_FIELDS(interface_names, values)
};

struct DynamicJointState {
  static constexpr const char* name = "control_msgs/msg/DynamicJointState";
  Header header;
  std::vector<std::string> joint_names;
  std::vector<InterfaceValue> interface_values;
  PEDICEL_FIELDS(header, joint_names, interface_values)
};

}  // namespace pedicel::ros
