// What the generator of measured scenes claims, against statics and the equations of what it hides.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/discrepancy/scene_cases/scene_case.h"

namespace pedicel::scene_case {
namespace {

constexpr double standing = 1.15;                   // s: the finger holds the stem aside
constexpr double moving = 0.65;                     // s: it goes there, at its fastest
constexpr double weight_of_a_kilogram = 9.81;       // N
constexpr double hand_offset = fore_length - 0.03;  // m, from the fore arm's joint

Setting setting_of(const std::vector<std::string>& hidden) {
  Setting setting;
  draw(setting);
  for (const std::string& text : hidden) setting.hidden.push_back(hidden_of(text));
  return setting;
}

/// N, N m in the world about the hand's frame: of the plant on the finger, while all stand still.
std::pair<Vec3, Vec3> touch(const scene_case::Run& run, double t) {
  const Vec3 q = run.joints[run.step(t)];
  const Eigen::Matrix3d axes = Eigen::AngleAxisd(q[0] + q[1], Vec3::UnitZ()).toRotationMatrix();
  const Eigen::Matrix<double, 6, 1> wrench = run.wrench[run.step(t)];
  const Vec3 weight(0, 0, -(hand_mass + finger_mass) * weight_of_a_kilogram);
  return {axes * wrench.head<3>() - weight, axes * wrench.tail<3>()};
}

Vec3 hand_of(const Vec3& q) {
  const double both = q[0] + q[1];
  return Vec3(upper_length * std::cos(q[0]) + hand_offset * std::cos(both),
              upper_length * std::sin(q[0]) + hand_offset * std::sin(both), shoulder_height + q[2]);
}

// In balance a pad of k N/m gives way by F / k along the normal of what touches it.
TEST(MujocoWorld, ASoftContactGivesWayByForceOverStiffness) {
  for (const double stiffness : {150.0, 1000.0}) {
    const Setting setting =
        setting_of({"contact_compliance stiffness=" + std::to_string(stiffness)});
    const Drive drive = drives_of(setting).front();
    const auto run = simulate(setting, drive);
    const std::size_t k = run.step(standing);
    // The finger's axis as it would be were it hard, and the stem's, which is straight above it.
    const Vec3 q = run.joints[k];
    const Vec3 along(std::cos(q[0] + q[1]), std::sin(q[0] + q[1]), 0.0);
    const std::vector<Vec3>& stem = run.markers[k];
    Vec3 normal = along.cross(stem[2] - stem[1]).normalized();
    const Vec3 force = touch(run, standing).first;
    if (normal.dot(force) > 0.0) normal = -normal;
    const double apart = std::abs(normal.dot(stem[1] - hand_of(q)));
    const double overlap = setting.radius + finger_radius - apart;
    const double pressed = -normal.dot(force);
    EXPECT_GT(pressed, 0.2);
    EXPECT_NEAR(pressed / overlap, stiffness, 0.03 * stiffness) << overlap << " m";
  }
}

/// The stem while the finger holds it aside, hardly of any weight of its own: what bends it.
struct Bent {
  double moment = 0.0;     // N m, of the finger about the root
  double force = 0.0;      // N, across
  std::vector<Vec3> stem;  // m, markers from the root
};
Bent bent(const Setting& setting) {
  const auto run = simulate(setting, drives_of(setting).front());
  const auto [force, moment] = touch(run, standing);
  const std::size_t k = run.step(standing);
  const Vec3 q = run.joints[k];
  // Of hand and finger, about the hand's frame.
  const double lever = hand_mass * 0.015 + finger_mass * (0.03 + 0.5 * finger_length);  // kg m
  const Vec3 along(std::cos(q[0] + q[1]), std::sin(q[0] + q[1]), 0.0);
  const Vec3 own = lever * along.cross(Vec3(0, 0, -weight_of_a_kilogram));
  Bent out;
  out.moment = (moment - own + (hand_of(q) - setting.root).cross(force)).x();
  out.force = -force.y();
  for (std::size_t m = 0; m < markers_of(setting).size(); ++m)
    out.stem.push_back(run.markers[k][m] - setting.root);
  return out;
}

double bending_of(const Setting& setting) {
  return setting.modulus * hidden_number(setting, "youngs_modulus", "factor", 1.0) * 0.25 *
         3.14159265358979323846 * std::pow(setting.radius, 4);
}

// m, to the side at a height below the push, of a clamped stem: EI v'' = M - F z.
double clamped(const Bent& by, double bending, double z) {
  return (by.moment * z * z / 2.0 - by.force * z * z * z / 6.0) / bending;
}

// It turns by M / k, beside what the stem bends.
TEST(MujocoWorld, ASoftRootTurnsByMomentOverStiffness) {
  for (const double stiffness : {0.5, 2.0}) {
    const Setting setting = setting_of({"density factor=0.01", "youngs_modulus factor=10",
                                        "base_compliance stiffness=" + std::to_string(stiffness)});
    const Bent by = bent(setting);
    const Vec3 low = by.stem.front();
    const double turned = (low.y() - clamped(by, bending_of(setting), low.z())) / low.z();
    EXPECT_GT(turned, 0.02);
    EXPECT_NEAR(std::abs(by.moment) / stiffness, turned, 0.03 * turned) << stiffness;
  }
}

// Its further angle is that of the same moment in less EI, from where it is on.
TEST(MujocoWorld, AWeakStretchBendsBySoManyTimesTheStems) {
  const Setting setting =
      setting_of({"density factor=0.01", "weak_segment at=0.13 factor=0.3 length=0.045"});
  const Bent by = bent(setting);
  const Vec3 low = by.stem.front();
  const double ei = bending_of(setting), from = 0.13 * setting.height - 0.0225, to = from + 0.045;
  const double plain = clamped(by, ei, low.z());
  double more = 0.0;
  constexpr int parts = 100;
  for (int i = 0; i < parts; ++i) {
    const double s = from + (i + 0.5) / parts * (to - from);
    more +=
        (1.0 / 0.3 - 1.0) / ei * (by.moment - by.force * s) * (low.z() - s) * (to - from) / parts;
  }
  EXPECT_GT(more, 0.3 * plain);
  EXPECT_NEAR(low.y(), plain + more, 0.03 * (plain + more));
}

// A stem that hardly bends leans on a soft root: that bears the finger's moment and the weight's.
TEST(MujocoWorld, AMassPullsDownWhatLeans) {
  const double mass = 0.05, stiffness = 1.0;
  const Setting setting =
      setting_of({"density factor=0.01", "youngs_modulus factor=50", "base_compliance stiffness=1",
                  "extra_mass at=0.8 mass=0.05"});
  const Bent by = bent(setting);
  const Vec3 low = by.stem.front(), at = by.stem[2];
  const double turned = std::atan2(low.y() - clamped(by, bending_of(setting), low.z()), low.z());
  const double weight = mass * weight_of_a_kilogram * at.y();
  EXPECT_GT(weight, 0.1 * stiffness * turned);
  EXPECT_NEAR(stiffness * turned, by.moment + weight, 0.02 * stiffness * turned);
}

// A shoulder bears the moment about its axis, and a lift the weight above it.
TEST(MujocoWorld, MotorsBearWeightAndWhatIsTouched) {
  Setting setting = setting_of({});
  setting.torques = true;
  const auto run = simulate(setting, drives_of(setting).front());
  const std::size_t k = run.step(standing);
  const auto [force, moment] = touch(run, standing);
  const Vec3 q = run.joints[k], hand = hand_of(q);
  const Vec3 elbow(upper_length * std::cos(q[0]), upper_length * std::sin(q[0]), hand.z());
  const double carriage = 0.2;  // kg
  EXPECT_GT(force.norm(), 0.2);
  EXPECT_NEAR(run.efforts[k][0], -(moment + hand.cross(force)).z(), 1.0e-3);
  EXPECT_NEAR(run.efforts[k][1], -(moment + (hand - elbow).cross(force)).z(), 1.0e-3);
  EXPECT_NEAR(run.efforts[k][2],
              (carriage + hand_mass + finger_mass) * weight_of_a_kilogram - force.z(), 1.0e-3);
}

// Friction is what torques have in addition: dry and viscous while a joint turns, none at rest.
TEST(MujocoWorld, JointFrictionAddsToTheTorqueOfItsJoint) {
  Setting setting = setting_of({});
  setting.torques = true;
  const Drive drive = drives_of(setting).front();
  const auto plain = simulate(setting, drive);
  setting.hidden = {hidden_of("joint_friction coulomb=0.2,0,0 viscous=0.3,0,0")};
  const auto rough = simulate(setting, drive);
  const double h = 1.0e-4;  // s
  const double speed = (drive.at(moving + h) - drive.at(moving - h))[0] / (2.0 * h);
  const Vec3 more = rough.efforts[rough.step(moving)] - plain.efforts[plain.step(moving)];
  EXPECT_GT(std::abs(speed), 0.02);
  EXPECT_NEAR(more[1], 0.0, 1.0e-9);
  EXPECT_NEAR(more[0], std::copysign(0.2, speed) + 0.3 * speed, 1.0e-6);
  EXPECT_NEAR(more[2], 0.0, 1.0e-9);
  const Vec3 still = rough.efforts[rough.step(standing)] - plain.efforts[plain.step(standing)];
  EXPECT_NEAR(still.norm(), 0.0, 1.0e-9);
}

// T x' + x = u.
TEST(MujocoWorld, AControllerThatLagsFollowsAtFirstOrder) {
  const double lag = 0.03;
  const Setting setting = setting_of({"tracking_lag time=0.03"});
  const Drive drive = drives_of(setting).front();
  const auto run = simulate(setting, drive);
  EXPECT_EQ(run.joints.front(), drive.at(0.0));
  double farthest = 0.0;
  for (double t = 0.1; t < drive.duration - 0.1; t += 0.05) {
    const std::size_t k = run.step(t);
    const Vec3 speed = (run.joints[k + 1] - run.joints[k - 1]) / (2.0 * run.dt);
    EXPECT_NEAR((lag * speed + run.joints[k] - drive.at(t)).norm(), 0.0, 1.0e-6) << t << " s";
    farthest = std::max(farthest, (run.joints[k] - drive.at(t)).norm());
  }
  EXPECT_GT(farthest, 0.002);
}

}  // namespace
}  // namespace pedicel::scene_case
