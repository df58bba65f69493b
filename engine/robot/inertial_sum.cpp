#include "engine/robot/inertial_sum.h"

namespace pedicel::robot {

namespace {

Mat3 point_inertia(double mass, const Vec3& arm) {
  return mass * (arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose());
}

}  // namespace

void add_inertial(Inertial& sum, const Inertial& part, const Pose& pose) {
  if (part.mass == 0.0) return;
  const Mat3 rotation = pose.rotation.toRotationMatrix();
  const Vec3 com = pose * part.com_L;
  const Vec3 common = (sum.mass * sum.com_L + part.mass * com) / (sum.mass + part.mass);
  sum.inertia += point_inertia(sum.mass, sum.com_L - common) +
                 rotation * part.inertia * rotation.transpose() +
                 point_inertia(part.mass, com - common);
  sum.com_L = common;
  sum.mass += part.mass;
}

}  // namespace pedicel::robot
