#include "tests/stress/stress_case.h"

#include <algorithm>

#include "engine/geometry/shapes.h"
#include "plugins/cosserat/model/rod_state.h"
#include "tests/stress/draw.h"
#include "tests/stress/sentence.h"
#include "tests/stress/stress_plants.h"

namespace pedicel::stress {

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double standard_gravity = 9.81;  // m/s2
constexpr double one_radian = 1.0;         // rad

// A sphere, capsule or box of finger size.
void draw_shape(Random& random, Ram& ram) {
  const double radius = random.uniform(0.003, 0.03);
  switch (random.integer(0, 2)) {
    case 0:
      ram.shape_name = "sphere";
      ram.shape = std::make_shared<geometry::SphereDistance>(radius);
      return;
    case 1:
      ram.shape_name = "capsule";
      ram.shape = std::make_shared<geometry::CapsuleDistance>(radius, random.uniform(0.02, 0.2));
      return;
    default:
      ram.shape_name = "box";
      ram.shape = std::make_shared<geometry::BoxDistance>(
          Vec3(2.0 * radius, random.uniform(0.004, 0.1), random.uniform(0.004, 0.2)));
  }
}

// Its way leads through a node of the plant, which it meets within the first half of the run.
Ram draw_ram(Random& random, const StressCase& one) {
  Ram ram;
  draw_shape(random, ram);
  ram.velocity = random.uniform(0.1, 5.0) * draw_direction(random);
  ram.spin = random.uniform(0.0, 5.0) * draw_direction(random);
  const int target = random.integer(0, one.plant.size() - 1);
  const double meets = random.uniform(0.1, 0.5) * one.steps * one.dt;
  ram.start.position = one.plant.elements[target].drawn_position - meets * ram.velocity;
  ram.start.rotation = draw_rotation(random);
  return ram;
}

// Up to some 30 g.
Shake draw_shake(Random& random) {
  Shake shake;
  shake.frequency = draw_log(random, 0.5, 20.0);
  shake.amplitude = random.uniform(0.0, 0.02) * draw_direction(random);
  shake.turn = random.uniform(0.0, 0.2) * draw_direction(random);
  return shake;
}

// Up to a hundred times the plant's weight, somewhere, and a moment like that of this force on the
// segment, for a part of the run. The moment alone turns the joint by 1 rad at most: a joint has no
// moment of its own beyond half a turn, where its rotation vector is at its longest.
TimedLoad draw_load(Random& random, const StressCase& one) {
  double mass = 0.0;
  for (const cosserat::Element& element : one.plant.elements) mass += element.mass;
  TimedLoad timed;
  timed.load.element = random.integer(0, one.plant.size() - 1);
  const cosserat::Element& element = one.plant.elements[timed.load.element];
  timed.load.back = random.uniform(0.0, element.length);
  const double force = mass * standard_gravity * draw_log(random, 0.01, 100.0);
  timed.load.force_W = force * draw_direction(random);
  const double moment =
      std::min(force * element.length, element.bend_stiffness.minCoeff() * one_radian);
  timed.load.moment_W = random.uniform(0.0, moment) * draw_direction(random);
  timed.from = random.uniform(0.0, 0.5) * one.steps * one.dt;
  timed.to = random.uniform(0.5, 1.0) * one.steps * one.dt;
  return timed;
}

void draw_settings(Random& random, StressCase& one) {
  one.rods.integrator =
      draw_chance(random, 0.5) ? cosserat::Integrator::bdf2 : cosserat::Integrator::backward_euler;
  one.rods.newton_iterations = random.integer(1, 4);
  one.dt = draw_log(random, 1.0e-4, 1.0 / 30.0);
  one.steps = random.integer(60, 160);
  one.gravity =
      draw_chance(random, 0.1)
          ? Vec3(Vec3::Zero())
          : Vec3(draw_log(random, 0.1, 100.0) * standard_gravity * draw_direction(random));
  one.coupling.contact_stiffness = draw_log(random, 1.0e3, 1.0e6);
  one.coupling.fruit_stiffness = draw_log(random, 1.0e3, 1.0e5);
  one.coupling.friction = random.uniform(0.0, 1.5);
  one.coupling.self_contact = draw_chance(random, 0.5);
}

}  // namespace

Pose Ram::at(double time) const {
  const Quat turned = turn_by(time * spin) * start.rotation;
  return {start.position + time * velocity, turned.normalized()};
}

Pose Shake::at(const Pose& drawn, double time) const {
  const double swing = std::sin(2.0 * pi * frequency * time);
  return {drawn.position + swing * amplitude,
          (turn_by(swing * turn) * drawn.rotation).normalized()};
}

StressCase draw_case(std::uint64_t seed) {
  // Neighbouring seeds of the generator are neighbouring states: its first number tells them apart.
  Random random(Random(seed).next());
  StressCase one;
  one.seed = seed;
  one.youngs_modulus = draw_log(random, 1.0e5, 1.0e11);
  one.damping_time = draw_chance(random, 0.2) ? 0.0 : draw_log(random, 1.0e-4, 0.1);
  draw_settings(random, one);
  draw_plant(random, one);
  if (draw_chance(random, 0.6)) one.ram = draw_ram(random, one);
  if (draw_chance(random, 0.4)) one.shake = draw_shake(random);
  for (int i = random.integer(0, 2); i > 0; --i) one.loads.push_back(draw_load(random, one));
  return one;
}

std::string describe(const StressCase& one) {
  const cosserat::RodSettings& rods = one.rods;
  std::string text = sentence(
      "seed %llu: %s, %d elements, E %.2g Pa, damping %.2g s, %s, %d Newton, dt %.2g s, %d steps, "
      "%.3g g, contact %.2g N/m, friction %.2f",
      static_cast<unsigned long long>(one.seed), one.plant_name.c_str(), one.plant.size(),
      one.youngs_modulus, one.damping_time,
      rods.integrator == cosserat::Integrator::bdf2 ? "bdf2" : "backward_euler",
      rods.newton_iterations, one.dt, one.steps, one.gravity.norm() / standard_gravity,
      one.coupling.contact_stiffness, one.coupling.friction);
  if (one.coupling.self_contact) text += ", self-contact";
  if (one.ram)
    text += sentence(", %s at %.2g m/s", one.ram->shape_name.c_str(), one.ram->velocity.norm());
  if (one.shake) text += sentence(", shaken at %.2g Hz", one.shake->frequency);
  return text + sentence(", %zu loads, %zu fruits, %zu welds, %zu supports", one.loads.size(),
                         one.plant.fruits.size(), one.plant.welds.size(),
                         one.plant.supports.size());
}

}  // namespace pedicel::stress
