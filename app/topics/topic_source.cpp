#include "app/topics/topic_source.h"

namespace pedicel::app {

std::string topic_part(const std::string& name) {
  std::string part;
  for (const char c : name) {
    const bool good = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    part += good ? c : '_';
  }
  return part.empty() || (part[0] >= '0' && part[0] <= '9') ? "_" + part : part;
}

ros::Point point_of(const Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

ros::Vector3 vector_of(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

ros::Quaternion quaternion_of(const Quat& q) {
  return {q.x(), q.y(), q.z(), q.w()};
}

ros::PoseMessage pose_of(const Pose& pose) {
  return {point_of(pose.position), quaternion_of(pose.rotation)};
}

ros::TransformStamped transform_of(double time, const std::string& parent, const std::string& child,
                                   const Pose& X_PC) {
  return {{ros::stamp_of(time), parent},
          child,
          {vector_of(X_PC.position), quaternion_of(X_PC.rotation)}};
}

}  // namespace pedicel::app
