#pragma once

#include "tests/unit/cosserat/random_plants.h"

namespace pedicel::cosserat::cases {

/// A leaf on an element: a midrib of one to three segments, a margin beside it, and as many veins
/// from the margin that are welded to the midrib.
inline void add_leaf(RodModel& model, Random& random, int foot) {
  const int count = random.integer(1, 3);
  const Mat3 axes = exp_map(random_vector(random, 2.0)).toRotationMatrix();
  const Vec3 start = model.elements[foot].drawn_position;
  const double size = random.uniform(0.01, 0.03);
  const auto grow = [&](int parent, const Vec3& end) {
    const int e = add_element(model, parent, end, random_section(random), axes.col(2));
    model.elements[e].damping_time = 0.01;
    return e;
  };
  int midrib = foot, margin = foot;
  for (int i = 1; i <= count; ++i) {
    const Vec3 on_midrib = start + size * i * axes.col(0);
    midrib = grow(midrib, on_midrib);
    margin = grow(margin, on_midrib + size * axes.col(1));
    Weld weld;
    weld.a = midrib;
    weld.b = grow(margin, on_midrib);
    weld.position_stiffness = random.uniform(100.0, 1.0e4);
    weld.bend_stiffness = Vec3(0.3, 0.1, 0.2);
    model.welds.push_back(weld);
  }
}

/// Leaves on any elements of a plant, leaves among them; the plant is finished again.
inline void add_leaves(RodModel& model, Random& random, int leaves) {
  for (int i = 0; i < leaves; ++i) add_leaf(model, random, random.integer(0, model.size() - 1));
  finish(model);
}

}  // namespace pedicel::cosserat::cases
