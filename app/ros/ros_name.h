#pragma once

#include <string>

/// Names of ROS 2 as they stand in DDS.
namespace pedicel::app {

/// "rt/arm/joint_states" of "/arm/joint_states".
std::string dds_topic(const std::string& ros_topic);
/// "rq/arm/pauseRequest" and "rr/arm/pauseReply" of the service "/arm/pause".
std::string dds_request_topic(const std::string& service);
std::string dds_reply_topic(const std::string& service);
/// "sensor_msgs::msg::dds_::JointState_" of "sensor_msgs/msg/JointState".
std::string dds_type(const std::string& ros_type);

/// A topic in a namespace ("/arm"; empty: none), but for /clock, /tf and /tf_static, which all
/// nodes share.
std::string in_namespace(const std::string& ros_namespace, const std::string& topic);
/// Whether ROS takes it: absolute, of letters, digits, _ and single /, each part beginning with no
/// digit; or empty.
bool is_namespace(const std::string& text);

}  // namespace pedicel::app
