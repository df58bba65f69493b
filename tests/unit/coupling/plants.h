#pragma once

#include "plugins/cosserat/model/rod_model.h"

namespace pedicel::coupling {

/// A straight rod of equal segments from `from` to `to`, circular, not yet finished.
inline cosserat::RodModel straight_rod(const Vec3& from, const Vec3& to, int segments,
                                       double radius, const cosserat::Material& material = {}) {
  cosserat::RodModel model;
  model.organs = {"plant/stem"};
  model.root.position = from;
  for (int e = 0; e < segments; ++e) {
    const Vec3 end = from + (e + 1.0) / segments * (to - from);
    const int index = add_element(model, e - 1, end, circle_section(radius, material));
    model.elements[index].radius_near = model.elements[index].radius_far = radius;
    model.elements[index].damping_time = material.damping_time;
  }
  return model;
}

}  // namespace pedicel::coupling
