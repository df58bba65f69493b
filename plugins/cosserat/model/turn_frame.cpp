#include "plugins/cosserat/model/turn_frame.h"

#include <cmath>

namespace pedicel::cosserat {

namespace {

// The diagonal of a tensor k11, k22 in axes turned by an angle.
void turn(double& k1, double& k2, double angle) {
  const double c2 = std::cos(angle) * std::cos(angle), a = k1, b = k2;
  k1 = c2 * a + (1.0 - c2) * b;
  k2 = (1.0 - c2) * a + c2 * b;
}

void turn(Vec3& k, double angle) {
  turn(k.x(), k.y(), angle);
}

}  // namespace

void turn_frame(RodModel& model, int e, double angle) {
  const Quat r(Eigen::AngleAxisd(angle, Vec3::UnitZ()));
  Element& element = model.elements[e];
  element.drawn_rotation = (element.drawn_rotation * r).normalized();
  element.rest_rotation = (element.rest_rotation * r).normalized();
  element.rest_strain = r.conjugate() * element.rest_strain;
  turn(element.stretch_stiffness, angle);
  turn(element.bend_stiffness, angle);
  turn(element.inertia, angle);
  turn(element.section.shear1, element.section.shear2, angle);
  turn(element.section.bend1, element.section.bend2, angle);
  turn(element.section.inertia1, element.section.inertia2, angle);
  for (Element& child : model.elements)
    if (child.parent == e) child.rest_rotation = (r.conjugate() * child.rest_rotation).normalized();
  for (Support& support : model.supports) {
    if (support.element != e) continue;
    support.rotation = (support.rotation * r).normalized();
    turn(support.rotation_stiffness, angle);
  }
  for (Weld& weld : model.welds) {
    if (weld.a == e) weld.rest_rotation = (r.conjugate() * weld.rest_rotation).normalized();
    if (weld.b != e) continue;
    weld.rest_rotation = (weld.rest_rotation * r).normalized();
    turn(weld.bend_stiffness, angle);
  }
}

void make_anisotropic(RodModel& model, int e, double ratio, const Vec3& direction) {
  const Element& element = model.elements[e];
  const Vec3 in_frame = element.drawn_rotation.conjugate() * direction;
  const Eigen::Vector2d across = in_frame.head<2>();
  if (across.norm() <= 1.0e-9 * direction.norm()) return;
  const Eigen::Vector2d axis = Eigen::Vector2d(-across.y(), across.x()).normalized();
  const Eigen::Matrix2d s =
      Eigen::Matrix2d::Identity() + (std::sqrt(ratio) - 1.0) * axis * axis.transpose();
  const Vec3 before = element.bend_stiffness;
  const Eigen::Matrix2d k = s * before.head<2>().asDiagonal() * s;
  const double angle = 0.5 * std::atan2(2.0 * k(0, 1), k(0, 0) - k(1, 1));
  const Eigen::Vector2d first(std::cos(angle), std::sin(angle));
  const Eigen::Vector2d second(-first.y(), first.x());
  turn_frame(model, e, angle);
  model.elements[e].bend_stiffness = {first.dot(k * first), second.dot(k * second), before.z()};
}

}  // namespace pedicel::cosserat
