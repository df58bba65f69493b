#pragma once

#include "engine/core/random.h"
#include "plugins/cosserat/model/rod_state.h"
#include "plugins/cosserat/model/rotation.h"
#include "plugins/cosserat/solver/rod_rows.h"

/// Random plants and random states of them, for property tests. Seeded.
namespace pedicel::cosserat::cases {

inline Vec3 random_vector(Random& random, double size = 1.0) {
  const double x = random.uniform(-size, size), y = random.uniform(-size, size);
  return {x, y, random.uniform(-size, size)};
}

inline Section random_section(Random& random) {
  const Material material{random.uniform(0.5e7, 2.0e7), 0.3, 600.0, 0.0};
  const double a = random.uniform(0.002, 0.004), b = random.uniform(0.002, 0.004);
  switch (random.integer(0, 2)) {
    case 0:
      return circle_section(a, material);
    case 1:
      return ellipse_section(a, b, material);
    default:
      return rectangle_section(a, b, material);
  }
}

/// A tree with every kind of thing on it: masses, a fruit, Kelvin-Voigt and mass damping; with
/// `loops`, a support and a weld as well, at rest in the drawn shape.
inline RodModel random_plant(Random& random, int elements, bool loops) {
  RodModel model;
  model.root = {random_vector(random), exp_map(random_vector(random, 2.0))};
  for (int e = 0; e < elements; ++e) {
    const int parent = e == 0 ? -1 : random.integer(std::max(0, e - 3), e - 1);
    const Vec3 start = parent < 0 ? model.root.position : model.elements[parent].drawn_position;
    const Vec3 along = (random_vector(random) + Vec3(0, 0, 1)).normalized();
    add_element(model, parent, start + random.uniform(0.02, 0.05) * along, random_section(random));
  }
  if (loops) {
    Support support;
    support.element = elements - 2;
    support.back = 0.005;
    support.position_stiffness = 300.0;
    support.rotation_stiffness = Vec3(0.1, 0.2, 0.3);
    model.supports.push_back(support);
    Weld weld;  // the last segment closes a loop
    weld.a = 0;
    weld.b =
        add_element(model, elements - 1, model.elements[0].drawn_position, random_section(random));
    weld.position_stiffness = 200.0;
    weld.bend_stiffness = Vec3(0.3, 0.1, 0.2);
    model.welds.push_back(weld);
  }
  for (Element& element : model.elements) {
    element.damping_time = random.uniform(0.0, 0.02);
    element.mass_damping = random.uniform(0.0, 2.0);
    element.radius_near = element.radius_far = 0.003;
  }
  model.masses.push_back({elements / 2, 0.01, 0.003, 0.002});
  model.fruits.push_back({"fruit", elements - 1, 0.0, 0.008, 900.0, {}});
  finish(model);
  for (Support& support : model.supports)
    support.position = point_on(model, drawn_state(model), support.element, support.back);
  return model;
}

/// The drawn state with every node moved by up to `move` (m), every frame turned by up to `turn`
/// (rad), and random velocities.
inline RodState random_state(const RodModel& model, Random& random, double move, double turn) {
  RodState state = drawn_state(model);
  for (int e = 0; e < model.size(); ++e) {
    state.position[e] += random_vector(random, move);
    state.orientation[e] = state.orientation[e] * exp_map(random_vector(random, turn));
    state.velocity[e] = random_vector(random, 0.5);
    state.angular_velocity[e] = random_vector(random, 3.0);
  }
  return state;
}

/// A step of `dt` before a state.
inline RodHistory random_history(const RodModel& model, const RodState& state, Random& random,
                                 double dt) {
  RodHistory before;
  for (int e = 0; e < model.size(); ++e) {
    before.position.push_back(state.position[e] - dt * state.velocity[e]);
    before.orientation.push_back(state.orientation[e] * exp_map(-dt * state.angular_velocity[e]));
    before.velocity.push_back(state.velocity[e] + random_vector(random, 0.1));
    before.angular_velocity.push_back(state.angular_velocity[e] + random_vector(random, 0.3));
    const Strain strain = strain_of(model, state, e);
    before.stretch.push_back(strain.stretch + random_vector(random, 1e-3));
    before.bend.push_back(strain.bend + random_vector(random, 1e-2));
  }
  return before;
}

/// The state with one of the 6 unknowns of an element changed: position (0-2), rotation vector
/// (3-5), both in W.
inline RodState nudged(const RodState& state, int element, int unknown, double step) {
  RodState moved = state;
  if (unknown < 3)
    moved.position[element][unknown] += step;
  else
    moved.orientation[element] =
        exp_map(step * Vec3::Unit(unknown - 3)) * moved.orientation[element];
  return moved;
}

}  // namespace pedicel::cosserat::cases
