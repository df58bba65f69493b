#pragma once

#include <algorithm>
#include <vector>

#include "plugins/cosserat/contact/contact.h"

namespace pedicel::cosserat::cases {

struct Sphere {
  Vec3 centre = Vec3::Zero();  // m, W, at the end of the step
  double radius = 0.01;        // m
  Vec3 motion = Vec3::Zero();  // m over the step
};

/// Exact spheres against a plant's shapes: the closest place of each tapered capsule's axis, whose
/// radius is taken there.
class SphereSource : public ContactSource {
 public:
  std::vector<Sphere> spheres;
  double friction = 0.5, stiffness = 1000.0, margin = 0.001;  // 1, N/m, m

  void cover(double from, double to) override {
    from_ = from;
    to_ = to;
  }
  void find(const RodModel& model, const RodState& state, double,
            std::vector<ContactPoint>& found) override {
    for (int s = 0; s < static_cast<int>(model.shapes.size()); ++s) {
      if (!state.alive[model.shapes[s].element]) continue;
      for (int i = 0; i < static_cast<int>(spheres.size()); ++i) add(model, state, s, i, found);
    }
  }

 private:
  void add(const RodModel& model, const RodState& state, int s, int i,
           std::vector<ContactPoint>& found) const {
    const CollisionShape& shape = model.shapes[s];
    const Sphere& sphere = spheres[i];
    const Vec3 near = point_on(model, state, shape.element, shape.back_near);
    const Vec3 axis = point_on(model, state, shape.element, shape.back_far) - near;
    const Vec3 centre = sphere.centre - (1.0 - to_) * sphere.motion;
    const double along =
        axis.squaredNorm() > 0.0 ? (centre - near).dot(axis) / axis.squaredNorm() : 0.0;
    const double t = std::clamp(along, 0.0, 1.0);
    const Vec3 away = near + t * axis - centre;
    ContactPoint point;
    point.shape = s;
    point.collider = i;
    point.back = (1.0 - t) * shape.back_near + t * shape.back_far;
    point.radius = (1.0 - t) * shape.radius_near + t * shape.radius_far;
    point.normal_W = away.normalized();
    point.gap = away.norm() - sphere.radius - point.radius;
    point.surface_motion_W = (to_ - from_) * sphere.motion;
    point.friction = friction;
    point.stiffness = stiffness;
    point.margin = margin;
    if (point.gap < 2.0 * margin) found.push_back(point);
  }

  double from_ = 0.0, to_ = 1.0;
};

}  // namespace pedicel::cosserat::cases
