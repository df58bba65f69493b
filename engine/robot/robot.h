#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/core/parameter.h"
#include "engine/core/state_hash.h"
#include "engine/robot/carried_links.h"
#include "engine/robot/joint_motors.h"

class btMultiBody;
class btMultiBodyDynamicsWorld;

namespace pedicel::robot {

/// How a robot stands in the world and how its joints are held.
struct RobotSettings {
  Pose base_pose;           ///< of the URDF's root link, in the world
  bool fixed_base = true;   ///< false: the root floats
  bool rk4 = false;         ///< Runge-Kutta 4 for the free motion: for passive robots (README)
  bool collide = true;      ///< false: links touch nothing in Bullet
  bool moves = true;        ///< false: no part of Bullet's world, it stands where place() puts it
  int collision_group = 1;  ///< Bullet's filter bits of the moving links (1: default filter)
  int collision_mask = -1;  ///< what they may touch
  double contact_friction = 0.8;  ///< 1, Coulomb coefficient of the links' surfaces in Bullet
  double position_gain = 0.5;     ///< 1, share of a position error that is removed in one step

  std::vector<Parameter> parameters();
};

/// What a restart needs; valid for the same robot only.
struct RobotState {
  std::vector<double> joint_positions, joint_velocities;  ///< every moving joint, mimics too
  std::vector<double> base;  ///< floating base: position 3, rotation 4, angular and linear velocity
};

/// A robot as a btMultiBody in a world. Owns its Bullet objects and takes them out of the world
/// when it goes; the world must outlive it. Links that fixed joints hold together are one Bullet
/// link, yet every URDF link can be asked for.
///
/// One step: set targets, begin_step(dt), world.stepSimulation(dt, 0), end_step(). Joints start in
/// position mode, at q = model().neutral(). Indices of joints are those of model(); of links, those
/// of description().
class Robot {
 public:
  /// A robot without a joint that moves stands still. Throws UsageError where the settings are out
  /// of range, or a floating base has no mass.
  Robot(const RobotDescription& description, const RobotSettings& settings,
        btMultiBodyDynamicsWorld& world);
  ~Robot();
  Robot(const Robot&) = delete;
  Robot& operator=(const Robot&) = delete;

  const RobotDescription& description() const;
  const KinematicModel& model() const;
  const RobotSettings& settings() const;

  /// Index of a link by its URDF name. Throws UsageError where there is none.
  int link(const std::string& name) const;

  // Measured, as of the last end_step() or reset().
  const Eigen::VectorXd& positions() const;   ///< rad or m, dofs
  const Eigen::VectorXd& velocities() const;  ///< rad/s or m/s, dofs
  /// Torque or force (N m, N) that each motor applied in the last step, friction and damping of the
  /// joint excluded; within the URDF's effort.
  const Eigen::VectorXd& motor_torques() const;
  /// Position of any joint by its URDF name, mimic joints as they are (not as they should be).
  /// Throws UsageError for an unknown or fixed joint.
  double joint_position(const std::string& joint) const;
  const Pose& link_pose_W(int link) const { return link_poses()[link]; }
  const Twist& link_twist_W(int link) const { return link_twists()[link]; }
  const std::vector<Pose>& link_poses() const;  ///< all links
  const std::vector<Twist>& link_twists() const;

  /// What the joints are told to do.
  JointMotors& motors();
  const JointMotors& motors() const;

  /// Force (N) on a link at a point, world frame, for the next step only (two-way coupling).
  void add_external_force(int link, const Vec3& force_W, const Vec3& point_W);

  /// After end_step(): forces on links that belong to the step which has just ended (the reaction
  /// of what was moved after Bullet: plants). Velocities change by M^-1 J^T f dt and positions by
  /// dt times that, as if backward Euler had known of them; motors reckon with the same again in
  /// the next step. To be called once every step, with none where there are none. Fixed bases only.
  void add_reactions(std::span<const LinkReaction> reactions, double dt);
  /// N m or N, of all joints: J^T of forces on links, at the present positions.
  Eigen::VectorXd effort_of(std::span<const LinkReaction> forces) const;
  /// 1/kg: the largest change of velocity of a point of link `a` for a unit impulse at a point of
  /// link `b`, world frame: |J_a M^-1 J_b^T|. Fixed bases only.
  double inverse_inertia(int a, const Vec3& point_a_W, int b, const Vec3& point_b_W) const;

  /// After end_step(): puts one joint elsewhere, with another velocity; its mimics follow, the
  /// others stay. For what was found after Bullet's part of the step (a grip).
  void place_joint(int joint, double position, double velocity);
  /// The same of all joints: of recorded motion, or of links that give way.
  void place(const Eigen::VectorXd& q, const Eigen::VectorXd& qd);
  /// After end_step(): a load (N m or N) that the joint's motor bears besides, for
  /// motor_torques() of this step.
  void add_motor_load(int joint, double load);

  /// Before world.stepSimulation(dt, 0): hands commands and external forces to Bullet.
  void begin_step(double dt);
  /// After it: reads positions, velocities, torques and link poses.
  void end_step();

  /// Puts the robot at q, qd and makes q its position target. Values are taken as they are.
  void reset(const Eigen::VectorXd& q, const Eigen::VectorXd& qd);
  RobotState state() const;
  void set_state(const RobotState& state);
  void add_to(StateHash& hash) const;

  /// Kinetic plus potential energy, J (fixed base; floating base: of the links relative to it).
  double energy() const;
  btMultiBody& multibody();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace pedicel::robot
