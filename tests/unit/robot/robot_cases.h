#pragma once

#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>

#include <filesystem>
#include <numbers>
#include <string>

#include "engine/core/random.h"
#include "engine/robot/robot.h"
#include "engine/urdf/urdf_reader.h"
#include "tests/support/places.h"

namespace pedicel::robot::testing {

inline constexpr double pi = std::numbers::pi;

/// A Bullet world with gravity and nothing in it.
struct World {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btMultiBodyConstraintSolver solver;
  btMultiBodyDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};

  World() { world.setGravity(btVector3(0, 0, -9.81)); }

  void step(Robot& robot, double dt) {
    robot.begin_step(dt);
    world.stepSimulation(dt, 0);
    robot.end_step();
  }
};

/// Reads a URDF from text and insists on it being free of errors.
inline RobotDescription parse(const std::string& text) {
  Diagnostics diagnostics;
  std::optional<RobotDescription> robot = parse_urdf(text, "test.urdf", {}, diagnostics);
  if (!robot) throw InvalidFile(diagnostics);
  return *robot;
}

inline std::string inertial(double mass, const std::string& xyz, const std::string& ixx,
                            const std::string& iyy, const std::string& izz) {
  return "<inertial><origin xyz='" + xyz + "'/><mass value='" + std::to_string(mass) +
         "'/><inertia ixx='" + ixx + "' iyy='" + iyy + "' izz='" + izz +
         "' ixy='0' ixz='0' iyz='0'/></inertial>";
}

/// One link that hangs 0.5 m below a joint about the world's y axis: 2 kg, 0.01 kg m2 about its
/// centre of mass.
inline std::string pendulum_urdf(const std::string& joint_extras,
                                 const std::string& type = "continuous") {
  return "<robot name='pendulum'><link name='base'/><link name='bob'>" +
         inertial(2.0, "0 0 -0.5", "0.01", "0.01", "0.01") + "</link><joint name='hinge' type='" +
         type + "'><parent link='base'/><child link='bob'/><axis xyz='0 1 0'/>" + joint_extras +
         "</joint></robot>";
}

/// The maker's file of the UFactory Lite 6, not part of this repository.
inline std::filesystem::path lite6_path() {
  return pedicel::test::shared_folder() / "data/lite6/xarm_description/urdf/lite6.urdf";
}

/// A robot of this repository.
inline std::filesystem::path asset(const std::string& name) {
  return pedicel::test::source_folder() / "assets/robots" / name / (name + ".urdf");
}

/// Positions drawn evenly from the limits (continuous joints: a whole turn).
inline Eigen::VectorXd random_positions(const KinematicModel& model, Random& random,
                                        double share = 1.0) {
  Eigen::VectorXd q(model.dofs());
  for (int i = 0; i < model.dofs(); ++i)
    q[i] = share * random.uniform(std::max(model.lower()[i], -pi), std::min(model.upper()[i], pi));
  return model.clamped(q);
}

}  // namespace pedicel::robot::testing
