#pragma once

#include "tests/unit/cosserat/random_plants.h"

namespace pedicel::cosserat::cases {

/// Gives a plant every kind of extension at once: hardening or softening, a bank of dashpots,
/// relaxation from both shapes, friction, yield on a few joints, drift, wind with gusts. Joints
/// differ. Sliders and yield slip at about `bend` (rad).
inline void extend(RodModel& model, Random& random, double bend = 0.1) {
  model.laws.clear();
  model.air.clear();
  for (int e = 0; e < model.size(); ++e) {
    const Vec3& k = model.elements[e].bend_stiffness;
    const double softer = std::min(k.x(), k.y());
    JointLaw law;
    if (e % 3 == 0) law.term("material_nonlinearity") = random.uniform(-2.0, 10.0);
    if (e % 7 == 3) {
      law.term("asymmetry", 0) = 0.1 * (e % 17) - 0.8;
      law.term("asymmetry", 1) = 0.6;
      law.term("asymmetry", 2) = -0.5;
      law.term("asymmetry", 3) = bend;
    }
    if (e % 4 == 1) add_structural_damping(law, random.uniform(0.02, 0.2));
    add_relaxation(law, random.uniform(0.0, 0.3), random.uniform(0.01, 1.0),
                   e % 2 == 0 ? RelaxationStart::unloaded : RelaxationStart::settled);
    add_friction(law, random.uniform(0.1, 0.3), 0.2 * softer * random.uniform(0.2, 1.0) * bend);
    if (e % 5 == 2) add_yield(law, softer * random.uniform(0.5, 2.0) * bend);
    model.laws.push_back(law);
    model.air.push_back(
        {random.uniform(0.0, 0.1), random_vector(random, 2.0), random_vector(random, 1.0)});
  }
  model.gust_frequency = 1.5;
  model.stiffness_drift = -0.01;
  model.clock = 3.0;
}

}  // namespace pedicel::cosserat::cases
