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
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit("sec", self.sec);
    visit("nanosec", self.nanosec);
  }
};

struct Duration {
  static constexpr const char* name = "builtin_interfaces/msg/Duration";
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit("sec", self.sec);
    visit("nanosec", self.nanosec);
  }
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
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit("stamp", self.stamp);
    visit("frame_id", self.frame_id);
  }
};

struct String {
  static constexpr const char* name = "std_msgs/msg/String";
  std::string data;
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit("data", self.data);
  }
};

struct ColorRGBA {
  static constexpr const char* name = "std_msgs/msg/ColorRGBA";
  float r = 0, g = 0, b = 0, a = 0;
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit("r", self.r);
    visit("g", self.g);
    visit("b", self.b);
    visit("a", self.a);
  }
};

struct Clock {
  static constexpr const char* name = "rosgraph_msgs/msg/Clock";
  Time clock;
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit("clock", self.clock);
  }
};

struct Point {
  static constexpr const char* name = "geometry_msgs/msg/Point";
  double x = 0, y = 0, z = 0;
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit("x", self.x);
    visit("y", self.y);
    visit("z", self.z);
  }
};

struct Vector3 {
  static constexpr const char* name = "geometry_msgs/msg/Vector3";
  double x = 0, y = 0, z = 0;
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit("x", self.x);
    visit("y", self.y);
    visit("z", self.z);
  }
};

struct Quaternion {
  static constexpr const char* name = "geometry_msgs/msg/Quaternion";
  double x = 0, y = 0, z = 0, w = 1;
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit("x", self.x);
    visit("y", self.y);
    visit("z", self.z);
    visit("w", self.w);
  }
};

struct PoseMessage {
  static constexpr const char* name = "geometry_msgs/msg/Pose";
  Point position;
  Quaternion orientation;
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit("position", self.position);
    visit("orientation", self.orientation);
  }
};

struct PoseStamped {
  static constexpr const char* name = "geometry_msgs/msg/PoseStamped";
  Header header;
  PoseMessage pose;
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit("header", self.header);
    visit("pose", self.pose);
  }
};

struct PoseArray {
  static constexpr const char* name = "geometry_msgs/msg/PoseArray";
  Header header;
  std::vector<PoseMessage> poses;
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit("header", self.header);
    visit("poses", self.poses);
  }
};

struct PointStamped {
  static constexpr const char* name = "geometry_msgs/msg/PointStamped";
  Header header;
  Point point;
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit("header", self.header);
    visit("point", self.point);
  }
};

struct Transform {
  static constexpr const char* name = "geometry_msgs/msg/Transform";
  Vector3 translation;
  Quaternion rotation;
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit("translation", self.translation);
    visit("rotation", self.rotation);
  }
};

struct TransformStamped {
  static constexpr const char* name = "geometry_msgs/msg/TransformStamped";
  Header header;
  std::string child_frame_id;
  Transform transform;
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit("header", self.header);
    visit("child_frame_id", self.child_frame_id);
    visit("transform", self.transform);
  }
};

struct TFMessage {
  static constexpr const char* name = "tf2_msgs/msg/TFMessage";
  std::vector<TransformStamped> transforms;
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit("transforms", self.transforms);
  }
};

struct Wrench {
  static constexpr const char* name = "geometry_msgs/msg/Wrench";
  Vector3 force, torque;
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit("force", self.force);
    visit("torque", self.torque);
  }
};

struct WrenchStamped {
  static constexpr const char* name = "geometry_msgs/msg/WrenchStamped";
  Header header;
  Wrench wrench;
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit("header", self.header);
    visit("wrench", self.wrench);
  }
};

struct TwistMessage {
  static constexpr const char* name = "geometry_msgs/msg/Twist";
  Vector3 linear, angular;
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit("linear", self.linear);
    visit("angular", self.angular);
  }
};

struct Accel {
  static constexpr const char* name = "geometry_msgs/msg/Accel";
  Vector3 linear, angular;
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit("linear", self.linear);
    visit("angular", self.angular);
  }
};

}  // namespace pedicel::ros
