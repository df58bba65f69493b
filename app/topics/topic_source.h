#pragma once

#include "app/topics/topic_sink.h"
#include "engine/ros_messages/common_messages.h"
#include "plugins/simulation/simulation.h"

namespace pedicel::app {

inline constexpr const char* world_frame = "world";

/// Something of a simulation that is told on one topic or some.
class TopicSource {
 public:
  virtual ~TopicSource() = default;
  /// Once, before anything moves: what stays as it is.
  virtual void begin(double /*time*/) {}
  /// After every step.
  virtual void after_step(double /*time*/) {}
  /// At its own rate, the first time before the first step.
  virtual void tell(double /*time*/) {}
};

/// A name of the scene as a part of a topic's: letters, digits and _, no digit first.
std::string topic_part(const std::string& name);

/// Messages' geometry.
ros::Point point_of(const Vec3& p);
ros::Vector3 vector_of(const Vec3& v);
ros::Quaternion quaternion_of(const Quat& q);
ros::PoseMessage pose_of(const Pose& pose);
ros::TransformStamped transform_of(double time, const std::string& parent, const std::string& child,
                                   const Pose& X_PC);

}  // namespace pedicel::app
