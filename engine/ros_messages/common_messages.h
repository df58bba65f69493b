#pragma once

#include <cmath>

#include "engine/ros_messages/definition.h"

/// builtin_interfaces, std_msgs, rosgraph_msgs, geometry_msgs, tf2_msgs. Names, types and order of
/// all fields are those of the published definitions. SI units, quaternions x, y, z, w.
namespace pedicel::ros {

struct Time {
  static constexpr const char* name = "builtin_interfaces/msg/Time";
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
  PEDICEL_FIELDS(sec, nanosec)
};

struct Duration {
  static constexpr const char* name = "builtin_interfaces/msg/Duration";
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
  PEDICEL_FIELDS(sec, nanosec)
};

/// Of a time or a duration, s.
template <class Stamp>
double seconds_of(const Stamp& stamp) {
  return static_cast<double>(stamp.sec) + 1.0e-9 * static_cast<double>(stamp.nanosec);
}
/// To the nearest nanosecond.
inline std::int64_t nanoseconds_of(double seconds) {
  return std::llround(seconds * 1.0e9);
}
template <class Stamp = Time>
Stamp stamp_of(double seconds) {
  const std::int64_t nanoseconds = nanoseconds_of(seconds);
  std::int64_t whole = nanoseconds / 1'000'000'000, rest = nanoseconds % 1'000'000'000;
  if (rest < 0) rest += 1'000'000'000, --whole;
  return {static_cast<std::int32_t>(whole), static_cast<std::uint32_t>(rest)};
}

struct Header {
  static constexpr const char* name = "std_msgs/msg/Header";
  Time stamp;
  std::string frame_id;
  PEDICEL_FIELDS(stamp, frame_id)
};

struct String {
  static constexpr const char* name = "std_msgs/msg/String";
  std::string data;
  PEDICEL_FIELDS(data)
};

struct ColorRGBA {
  static constexpr const char* name = "std_msgs/msg/ColorRGBA";
  float r = 0, g = 0, b = 0, a = 0;
  PEDICEL_FIELDS(r, g, b, a)
};

struct Clock {
  static constexpr const char* name = "rosgraph_msgs/msg/Clock";
  Time clock;
  PEDICEL_FIELDS(clock)
};

struct Point {
  static constexpr const char* name = "geometry_msgs/msg/Point";
  double x = 0, y = 0, z = 0;
  PEDICEL_FIELDS(x, y, z)
};

struct Vector3 {
  static constexpr const char* name = "geometry_msgs/msg/Vector3";
  double x = 0, y = 0, z = 0;
  PEDICEL_FIELDS(x, y, z)
};

struct Quaternion {
  static constexpr const char* name = "geometry_msgs/msg/Quaternion";
  double x = 0, y = 0, z = 0, w = 1;
  PEDICEL_FIELDS(x, y, z, w)
};

struct PoseMessage {
  static constexpr const char* name = "geometry_msgs/msg/Pose";
  Point position;
  Quaternion orientation;
  PEDICEL_FIELDS(position, orientation)
};

struct PoseStamped {
  static constexpr const char* name = "geometry_msgs/msg/PoseStamped";
  Header header;
  PoseMessage pose;
  PEDICEL_FIELDS(header, pose)
};

struct PoseArray {
  static constexpr const char* name = "geometry_msgs/msg/PoseArray";
  Header header;
  std::vector<PoseMessage> poses;
  PEDICEL_FIELDS(header, poses)
};

struct PointStamped {
  static constexpr const char* name = "geometry_msgs/msg/PointStamped";
  Header header;
  Point point;
  PEDICEL_FIELDS(header, point)
};

struct Transform {
  static constexpr const char* name = "geometry_msgs/msg/Transform";
  Vector3 translation;
  Quaternion rotation;
  PEDICEL_FIELDS(translation, rotation)
};

struct TransformStamped {
  static constexpr const char* name = "geometry_msgs/msg/TransformStamped";
  Header header;
  std::string child_frame_id;
  Transform transform;
  PEDICEL_FIELDS(header, child_frame_id, transform)
};

struct TFMessage {
  static constexpr const char* name = "tf2_msgs/msg/TFMessage";
  std::vector<TransformStamped> transforms;
  PEDICEL_FIELDS(transforms)
};

struct Wrench {
  static constexpr const char* name = "geometry_msgs/msg/Wrench";
  Vector3 force, torque;
  PEDICEL_FIELDS(force, torque)
};

struct WrenchStamped {
  static constexpr const char* name = "geometry_msgs/msg/WrenchStamped";
  Header header;
  Wrench wrench;
  PEDICEL_FIELDS(header, wrench)
};

struct TwistMessage {
  static constexpr const char* name = "geometry_msgs/msg/Twist";
  Vector3 linear, angular;
  PEDICEL_FIELDS(linear, angular)
};

struct Accel {
  static constexpr const char* name = "geometry_msgs/msg/Accel";
  Vector3 linear, angular;
  PEDICEL_FIELDS(linear, angular)
};

}  // namespace pedicel::ros
