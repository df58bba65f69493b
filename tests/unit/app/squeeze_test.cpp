// The gripper of assets/robots/gantry_gripper, told to shut, at 1/240 s: it stands where its
// motor's force balances what it holds, in both coupling directions. Both fingers hang on one
// motor, so each presses with half of its force, less or more the joints' friction of 0.2 N each.
#include <cmath>
#include <sstream>

#include "plugins/cosserat/contact/self_contact.h"
#include "plugins/simulation/colliders.h"
#include "tests/support/places.h"
#include "tests/unit/app/contact_cases.h"

namespace pedicel::app {
namespace {

constexpr double height = 0.6, joint_friction = 0.4;  // m, N

struct Way {
  double time = 0.0;                 // s
  Vec3 place = Vec3(0, 0, height);   // m
  double gripper = 0.0, turn = 0.0;  // m, rad about Z
};

std::string robot_text(const std::vector<Way>& ways, double force = 0.0) {
  std::ostringstream text;
  text << "robot:\n  name: gantry\n  file: " << pedicel::test::source_folder().string()
       << "/assets/robots/gantry_gripper/gantry_gripper.urdf\n"
          "  tool: tool\n  gripper: finger_joint\n  joints: {x_joint: -0.16, z_joint: 0.6, "
          "tilt_joint: "
          "1.5707963, finger_joint: "
       << ways.front().gripper << "}\n";
  if (force > 0.0) text << "  gripper_force: " << force << "\n";
  text << "  waypoints:\n";
  for (const Way& way : ways)
    text << "    - {time: " << way.time << ", position: [" << way.place.x() << ", " << way.place.y()
         << ", " << way.place.z() << "], gripper: " << way.gripper << ", facing: {approach: ["
         << std::cos(way.turn) << ", " << std::sin(way.turn) << ", 0], across: ["
         << -std::sin(way.turn) << ", " << std::cos(way.turn) << ", 0]}}\n";
  return text.str();
}

std::string scene_text(const char* direction, double friction, const std::string& more = "") {
  std::ostringstream text;
  text << "dt: 0.004166666666666667\ncoupling: {direction: " << direction
       << ", friction: " << friction << more
       << "}\nplants:\n  - {name: p, file: stem.plant.yaml}\n";
  return text.str();
}

/// What the fingers carry: normal and tangential force of each, N.
struct Fingers {
  double normal[2] = {0.0, 0.0};
  double opening = 0.0;              // N, on the joint: what lies along its way
  Vec3 tangential_W = Vec3::Zero();  // on the plant, both
  double sunk = 0.0;                 // m
};

Fingers fingers_of(const simulation::Simulation& sim) {
  Fingers fingers;
  const auto& robot = *sim.robot();
  const int links[] = {robot.description().link("left_finger"),
                       robot.description().link("right_finger")};
  for (const auto& contact : sim.rods().contact_forces(0)) {
    if (cosserat::is_self_contact(contact.point.collider)) continue;
    const coupling::Collider& collider = sim.colliders().collider(contact.point.collider);
    for (int f = 0; f < 2; ++f)
      if (collider.body == simulation::robot_body && collider.link == links[f]) {
        fingers.normal[f] += contact.normal;
        const Vec3 outward_W = robot.link_pose(links[f]).rotation * Vec3::UnitY();
        fingers.opening -= contact.normal * contact.point.normal_W.dot(outward_W);
      }
    fingers.tangential_W += contact.tangential_W;
    fingers.sunk = std::max(fingers.sunk, -contact.point.gap);
  }
  return fingers;
}

const std::vector<Way> shuts = {
    {0.0, {0, 0, height}, 0.02}, {0.1, {0, 0, height}, 0.02}, {0.5, {0, 0, height}, 0.0}};

class Squeeze : public testing::TestWithParam<const char*> {};

// A stalk of 1 mm radius: the fingers stop where 20 N have sunk into it.
TEST_P(Squeeze, AStalkIsHeldWithTheMotorsForce) {
  for (const double force : {0.0, 5.0}) {
    SceneCase files;
    files.write("stem.plant.yaml", stem_file("[0, 0, 0.7]", "[0, 0, 0.55]", 0.001, 2.0e7));
    const auto sim = files.simulation(scene_text(GetParam(), 0.8) + robot_text(shuts, force));
    const double effort = force > 0.0 ? force : 40.0;
    for (int i = 0; i < 480; ++i) {
      const auto& report = sim->step();
      ASSERT_EQ(report.errors & world::fatal_errors, 0u) << report.culprit;
      const Fingers fingers = fingers_of(*sim);
      ASSERT_LE(fingers.normal[0] + fingers.normal[1], effort + joint_friction + 1e-6);
      if (i < 200) continue;
      EXPECT_NEAR(fingers.normal[0], 0.5 * effort, 0.5 * joint_friction + 0.01) << i;
      EXPECT_NEAR(fingers.normal[1], 0.5 * effort, 0.5 * joint_friction + 0.01) << i;
    }
    const double opening = sim->robot()->robot().positions()[sim->robot()->gripper()];
    EXPECT_NEAR(opening, 0.001, 2.5e-4);
    EXPECT_NEAR(sim->robot()->robot().motor_torques()[sim->robot()->gripper()], -effort,
                joint_friction + 0.01);
  }
}

// Pulled along a stem that stretches by E A = 3140 N, the pads stick until both carry mu N, and
// slide with that: N of the step before (ContactTerms). It is the sum of the normal forces, which
// is a little more than the joint has, since a place of the stem that slides over a pad's edge is
// pushed askew, and the joint bears only what lies along its way.
TEST_P(Squeeze, FrictionHoldsUpToMuTimesTheForce) {
  SceneCase files;
  files.write("stem.plant.yaml", stem_file("[0, 0, 0.4]", "[0, 0, 0.65]", 0.001, 1.0e9));
  std::vector<Way> ways = shuts;
  ways.push_back({0.7, {0, 0, height}, 0.0});
  ways.push_back({1.7, {0, 0, height + 0.02}, 0.0});
  const auto sim = files.simulation(scene_text(GetParam(), 0.6) + robot_text(ways));
  double most = 0.0, last = 0.0, before = 0.0;
  for (int i = 0; i < 360; ++i) {
    const auto& report = sim->step();
    ASSERT_EQ(report.errors & world::fatal_errors, 0u) << report.culprit;
    const Fingers fingers = fingers_of(*sim);
    last = fingers.tangential_W.z();
    most = std::max(most, last);
    EXPECT_LE(last, 0.6 * before + 1e-9) << i;
    EXPECT_LE(fingers.opening, 40.0 + joint_friction + 1e-6) << i;
    before = fingers.normal[0] + fingers.normal[1];
  }
  EXPECT_GT(most, 0.6 * (40.0 - joint_friction) - 0.05);
}

// The stem is held against turning about its own axis: its torsion follows the pads.
TEST_P(Squeeze, FrictionHoldsAgainstTwist) {
  SceneCase files;
  files.write("stem.plant.yaml", stem_file("[0, 0, 0.4]", "[0, 0, 0.65]", 0.002, 1.0e7));
  std::vector<Way> ways = shuts;
  ways.push_back({0.7, {0, 0, height}, 0.0});
  ways.push_back({1.7, {0, 0, height}, 0.0, 0.6});
  const auto sim = files.simulation(scene_text(GetParam(), 0.8) + robot_text(ways));
  for (int i = 0; i < 480; ++i) {
    const auto& report = sim->step();
    ASSERT_EQ(report.errors & world::fatal_errors, 0u) << report.culprit;
  }
  const cosserat::RodModel& model = sim->rods().model(0);
  const cosserat::RodState &state = sim->rods().state(0), drawn = cosserat::drawn_state(model);
  for (int e = 0; e < model.size(); ++e) {
    if (std::abs(drawn.position[e].z() - height) > 0.011) continue;
    const Quat turned = state.orientation[e] * drawn.orientation[e].conjugate();
    // About the stem's own axis. A stem that slips does not turn at all. The pads stand off by 0.18
    // mm, where their force begins: taken from their own surface, it would turn by 9 % too far.
    // What the friction springs stretch by is below 1e-4 rad (its torsion is 3e-4 N m, theirs 7 N
    // m/rad).
    EXPECT_NEAR(2.0 * std::atan2(std::abs(turned.z()), std::abs(turned.w())), 0.6, 1.0e-3)
        << "element " << e;
  }
}

// A fruit much too soft for the force is not crushed through: half of its radius is the most.
TEST_P(Squeeze, ASoftFruitIsNotCrushedThrough) {
  SceneCase files;
  files.write(
      "stem.plant.yaml",
      stem_file("[0, 0, 0.7]", "[0, 0, 0.6]", 0.001, 2.0e7,
                "fruits:\n  - {name: fruit, curve: stem, at: 1.0, radius: 0.012, density: 950}\n"));
  const auto sim =
      files.simulation(scene_text(GetParam(), 0.8, ", fruit_stiffness: 300") + robot_text(shuts));
  double sunk = 0.0;
  for (int i = 0; i < 480; ++i) {
    const auto& report = sim->step();
    ASSERT_EQ(report.errors & world::fatal_errors, 0u) << report.culprit;
    sunk = std::max(sunk, fingers_of(*sim).sunk);
  }
  EXPECT_GT(sunk, 1.0e-3);
  EXPECT_LT(sunk, 0.55 * 0.012);
  EXPECT_GT(sim->robot()->robot().positions()[sim->robot()->gripper()], 0.4 * 0.012);
}

// The cherry tomato's last stalk, between the arm's pads, a fruit's shoulder beside it: shut on to
// 0, then pulled by 50 mm sideways and up. It used to end as unstable, organ unknown.
TEST_P(Squeeze, TheCherryTomatosStalkIsHeld) {
  const std::string assets = pedicel::test::source_folder();
  const SceneCase files;
  const auto sim = files.simulation(
      "dt: 0.004166666666666667\ncoupling: {friction: 0.8, direction: " + std::string(GetParam()) +
      "}\nplants:\n  - {name: truss, file: " + assets +
      "/plants/cherry_tomato.plant.yaml}\nrobot:\n  name: arm\n  file: " + assets +
      "/assets/robots/stalk6/stalk6.urdf\n"
      "  position: [0.52, 0, 0.2]\n  orientation: [0, 0, 1, 0]\n  tool: tool\n"
      "  gripper: finger_joint\n  gripper_force: 1000\n  waypoints:\n"
      "    - {time: 0, at: {fruit: truss/fruit_5}, offset: [0.1, 0, 0.02], facing: {approach: "
      "[-1, 0, 0], across: [0, 1, 0]}, gripper: 0.02}\n"
      "    - {time: 1.0, at: {fruit: truss/fruit_5}, offset: [0, 0, 0.02]}\n"
      "    - {time: 1.2, at: {fruit: truss/fruit_5}, offset: [0, 0, 0.02], gripper: 0.0}\n"
      "    - {time: 2.5, at: {fruit: truss/fruit_5}, offset: [0.05, 0, 0.05], gripper: 0.0}\n");
  int unsolved = 0;
  for (int i = 0; i < 600; ++i) {
    const auto& report = sim->step();
    ASSERT_EQ(report.errors & world::fatal_errors, 0u) << report.culprit << ": " << report.cause;
    unsolved += (report.errors & world::plant_not_converged) != 0;
    const Fingers fingers = fingers_of(*sim);
    EXPECT_LE(fingers.normal[0] + fingers.normal[1], 1.05 * (40.0 + joint_friction));
    if (i < 320) continue;
    EXPECT_GT(fingers.normal[0], 15.0) << i;
    EXPECT_GT(fingers.normal[1], 15.0) << i;
  }
  EXPECT_LT(unsolved, 20);
}

INSTANTIATE_TEST_SUITE_P(Directions, Squeeze, testing::Values("one_way", "two_way"));

// A grip that holds from the start is a grip, and is said; one whose pad has the axis inside cannot
// be told from which side it came, and is left out.
TEST(StartOverlap, IsSaid) {
  SceneCase files;
  files.write("stem.plant.yaml", stem_file("[0, 0, 0.7]", "[0, 0, 0.55]", 0.003, 2.0e7));
  const std::vector<Way> held = {{0.0, {0, 0, height}, 0.002}, {0.5, {0, 0, height}, 0.002}};
  const auto sim = files.simulation(scene_text("one_way", 0.8) + robot_text(held));
  std::string notes;
  for (const std::string& note : sim->notes()) notes += note + "\n";
  EXPECT_NE(notes.find("warning: gantry/left_finger overlaps p/stem by 1 mm at the start\n"),
            std::string::npos)
      << notes;
  for (int i = 0; i < 60; ++i) {
    const auto& report = sim->step();
    ASSERT_EQ(report.errors & world::fatal_errors, 0u) << report.culprit;
  }
  EXPECT_NEAR(fingers_of(*sim).normal[0], 20.0, 0.25);
}

TEST(StartOverlap, OfAPadAroundTheAxisDoesNotTouch) {
  SceneCase files;
  files.write("stem.plant.yaml", stem_file("[0, 0.004, 0.7]", "[0, 0.004, 0.55]", 0.001, 2.0e7));
  const std::vector<Way> held = {{0.0, {0, 0, height}, 0.002}, {0.5, {0, 0, height}, 0.002}};
  const auto sim = files.simulation(scene_text("one_way", 0.8) + robot_text(held));
  std::string notes;
  for (const std::string& note : sim->notes()) notes += note + "\n";
  EXPECT_NE(notes.find("at the start, and does not touch it there"), std::string::npos) << notes;
  for (int i = 0; i < 60; ++i) sim->step();
  EXPECT_EQ(fingers_of(*sim).normal[0], 0.0);
}

// A stem that stands in the ground, or hangs from a body, does so on purpose.
TEST(StartOverlap, WhatAPlantGrowsOutOfIsNotSaid) {
  SceneCase files;
  files.write("stem.plant.yaml", stem_file("[0, 0, 0]", "[0, 0, 0.3]", 0.003, 2.0e7));
  const auto sim = files.simulation(
      "plants:\n  - {name: p, file: stem.plant.yaml}\nground: {height: 0}\nbodies:\n"
      "  - {name: pot, box: [0.1, 0.1, 0.06], position: [0, 0, 0.02]}\n"
      "  - {name: shelf, box: [0.1, 0.1, 0.02], position: [0, 0, 0.2]}\n");
  ASSERT_EQ(sim->notes().size(), 1u);
  EXPECT_NE(sim->notes()[0].find("shelf overlaps p/stem by 13 mm at the start"), std::string::npos)
      << sim->notes()[0];
}

}  // namespace
}  // namespace pedicel::app
