// Two-way coupling: what a plant feels, the robot or the rigid body feels, in the same step.
#include <cmath>

#include "engine/core/random.h"
#include "plugins/cosserat/contact/self_contact.h"
#include "plugins/simulation/colliders.h"
#include "tests/unit/app/contact_cases.h"

namespace pedicel::app {
namespace {

constexpr double dt = 1.0 / 240.0, g = 9.81;

Vec3 force_on_plants(const simulation::Simulation& sim) {
  Vec3 sum = Vec3::Zero();
  for (int p = 0; p < sim.rods().size(); ++p)
    for (const auto& force : sim.rods().contact_forces(p))
      if (!cosserat::is_self_contact(force.point.collider))
        sum += force.normal * force.point.normal_W + force.tangential_W;
  return sum;
}

const char* level_stem = "plants:\n  - {name: stem, file: stem.plant.yaml}\n";

// A slide without motor falls on a level branch. Backward Euler gives it, in every step,
//   v' - v = dt (-g - F / m)
// with F the force that the plant felt in that very step: momentum balances to rounding. Bullet's
// own part of the step brings 1e-9 or so.
TEST(TwoWay, ASlideAndAPlantExchangeMomentumToRounding) {
  const double mass = 0.2;
  SceneCase files;
  files.write("stem.plant.yaml", stem_file("[0, 0, 0.5]", "[0.2, 0, 0.5]", 0.004, 1.0e9));
  files.write("slider.urdf", slider_urdf(mass, "0 0 1"));
  const auto sim = files.simulation(
      std::string("coupling: {direction: two_way}\n") + level_stem +
      "robot: {name: slider, file: slider.urdf, position: [0.15, 0, 0.54], control: torque}\n");
  double before = 0.0, impulse = 0.0;
  int touching = 0;
  for (int i = 0; i < 480; ++i) {
    sim->step();
    const double velocity = sim->robot()->robot().velocities()[0];
    const double force = force_on_plants(*sim).z();
    touching += force != 0.0;
    impulse += dt * force;
    ASSERT_NEAR(velocity - before, dt * (-g - force / mass), 1e-8) << "step " << i;
    before = velocity;
  }
  EXPECT_GT(touching, 50);
  EXPECT_LT(impulse, -0.1);
}

// The same for a free rigid body, in three directions: a ball that glances off.
TEST(TwoWay, ABodyAndAPlantExchangeMomentumToRounding) {
  SceneCase files;
  files.write("stem.plant.yaml", stem_file("[0, 0, 0.5]", "[0.2, 0, 0.5]", 0.004, 1.0e9));
  const auto sim = files.simulation(std::string("coupling: {direction: two_way}\n") + level_stem +
                                    "bodies:\n  - {name: ball, sphere: {radius: 0.02}, mass: 0.1, "
                                    "position: [0.15, 0.005, 0.53]}\n");
  Vec3 before = Vec3::Zero();
  int touching = 0;
  for (int i = 0; i < 240; ++i) {
    sim->step();
    const Vec3 force = force_on_plants(*sim);
    const Vec3 velocity = sim->world().body_velocity(0);
    touching += force != Vec3::Zero();
    const Vec3 expected = dt * (Vec3(0, 0, -g) - force / 0.1);
    ASSERT_LT((velocity - before - expected).norm(), 1e-8) << "step " << i;
    before = velocity;
  }
  EXPECT_GT(touching, 2);
  EXPECT_GT(std::abs(before.y()), 0.01);
}

// One-way, the slide does not feel the branch at all.
TEST(TwoWay, IsOffByDefault) {
  SceneCase files;
  files.write("stem.plant.yaml", stem_file("[0, 0, 0.5]", "[0.2, 0, 0.5]", 0.004, 1.0e9));
  files.write("slider.urdf", slider_urdf(0.2, "0 0 1"));
  const auto sim = files.simulation(
      std::string(level_stem) +
      "robot: {name: slider, file: slider.urdf, position: [0.15, 0, 0.54], control: torque}\n");
  for (int i = 0; i < 60; ++i) sim->step();
  EXPECT_NEAR(sim->robot()->robot().velocities()[0], -g * 0.25, 1e-6);
}

// A slide whose motor is told to go 0.3 m farther is stopped by a branch of wood: the motor gives
// all it has, 20 N, and in static balance the branch carries that, to what still moves (0.5 %).
// Beam theory: it gives way by F a^3 / (3 E I), 20 N x (0.14 m)^3 / (3 x 1e10 Pa x pi/4 x (6 mm)^4)
// = 1.8 mm; the margin of contact and the point where the flat box touches (a within 0.12 to 0.16
// m) allow 60 %.
TEST(TwoWay, AStiffBranchStopsAWeakArm) {
  SceneCase files;
  files.write("stem.plant.yaml", stem_file("[0, 0, 0]", "[0, 0, 0.3]", 0.006, 1.0e10));
  files.write("slider.urdf", slider_urdf(1.0, "1 0 0", 20.0));
  files.write("path.csv", "time_s,slide\n0,0\n1,0.3\n");
  const auto sim = files.simulation(
      "coupling: {direction: two_way}\nplants:\n  - {name: stem, file: stem.plant.yaml}\n"
      "robot: {name: slider, file: slider.urdf, position: [-0.1, 0, 0.14], trajectory: "
      "path.csv}\n");
  double torque = 0.0, force = 0.0;
  for (int i = 0; i < 960; ++i) {
    sim->step();
    if (i < 720) continue;
    torque += sim->robot()->robot().motor_torques()[0] / 240.0;
    force += force_on_plants(*sim).x() / 240.0;
  }
  EXPECT_NEAR(torque, 20.0, 1e-6);
  EXPECT_NEAR(force, torque, 0.005 * torque);
  const double moved = sim->robot()->robot().positions()[0] - (0.1 - 0.02 - 0.006);
  EXPECT_GT(moved, 0.4 * 1.8e-3);
  EXPECT_LT(moved, 1.6 * 1.8e-3);
}

// A hinge: its motor's torque is the contact force times its lever. The paddle lies level under no
// gravity about z and reaches the branch with its end; the lever is that of the force's own place.
TEST(TwoWay, TheJointFeelsForceTimesLever) {
  SceneCase files;
  files.write("stem.plant.yaml", stem_file("[0.25, 0.1, 0]", "[0.25, 0.1, 0.3]", 0.006, 1.0e10));
  files.write(
      "paddle.urdf",
      "<robot name='paddle'><link name='base'/><link name='tool'><inertial><origin xyz='0.15 0 "
      "0'/><mass value='0.5'/><inertia ixx='0.001' iyy='0.004' izz='0.004' ixy='0' ixz='0' "
      "iyz='0'/></inertial><collision><origin xyz='0.15 0 0'/><geometry><box size='0.3 0.02 "
      "0.02'/></geometry></collision></link><joint name='hinge' type='revolute'><parent "
      "link='base'/><child link='tool'/><axis xyz='0 0 1'/><limit lower='-3' upper='3' "
      "effort='2' velocity='10'/></joint></robot>");
  files.write("path.csv", "time_s,hinge\n0,0\n1,1\n");
  const auto sim = files.simulation(
      "coupling: {direction: two_way, friction: 0.3}\n"
      "plants:\n  - {name: stem, file: stem.plant.yaml}\n"
      "robot: {name: paddle, file: paddle.urdf, position: [0, 0, 0.15], trajectory: path.csv}\n");
  double torque = 0.0, moment = 0.0;
  for (int i = 0; i < 960; ++i) {
    sim->step();
    if (i < 720) continue;
    torque += sim->robot()->robot().motor_torques()[0] / 240.0;
    const auto sum = sim->plant_step().contacts().sum_of_link(simulation::robot_body, 1);
    moment += (sum.place_W.cross(sum.force_W) + sum.moment_W).z() / 240.0;
  }
  EXPECT_NEAR(torque, 2.0, 1e-6);
  EXPECT_NEAR(moment, -torque, 0.005 * torque);
  EXPECT_LT(sim->robot()->robot().positions()[0], 0.5);
}

// Explicit exchange would be unstable where dt^2 k / m > 4: at 1/240 s and 1e5 N/m for all that is
// lighter than 0.43 kg. Here slides from 5 g to 20 kg fall by 20 mm on branches from 1e7 to 2e10
// Pa. None may leave the branch faster than it came, sqrt(2 g h) and what a step adds, and after 3
// s every one that the branch carries rests.
TEST(TwoWay, IsStableForLightLinksAndStiffStems) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    const double mass = std::pow(10.0, random.uniform(-2.3, 1.3));
    const double modulus = std::pow(10.0, random.uniform(7.0, 10.3));
    SceneCase files;
    files.write("stem.plant.yaml",
                stem_file("[0, 0, 0.5]", "[0.2, 0, 0.5]", random.uniform(0.003, 0.01), modulus));
    files.write("slider.urdf", slider_urdf(mass, "0 0 1"));
    const auto sim = files.simulation(
        std::string("coupling: {direction: two_way}\n") + level_stem +
        "robot: {name: slider, file: slider.urdf, position: [0.1, 0, 0.56], control: torque}\n");
    double fastest_up = 0.0;
    bool rests = true;
    for (int i = 0; i < 720; ++i) {
      const auto& report = sim->step();
      ASSERT_EQ(report.errors & world::fatal_errors, 0u) << "seed " << seed;
      rests = true;
      if (sim->robot()->robot().positions()[0] < -0.3) break;  // past a branch that gave way
      fastest_up = std::max(fastest_up, sim->robot()->robot().velocities()[0]);
      rests = std::abs(sim->robot()->robot().velocities()[0]) < 0.01;
    }
    // The stem itself swings up at no more than what it got.
    EXPECT_LT(fastest_up, std::sqrt(2.0 * g * 0.04) + g * dt) << "seed " << seed << " m " << mass;
    EXPECT_TRUE(rests) << "seed " << seed << " m " << mass << " E " << modulus;
  }
}

}  // namespace
}  // namespace pedicel::app
