#pragma once

#include <Eigen/Dense>
#include <atomic>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "plugins/discrepancy/scene/arm.h"
#include "plugins/simulation/colliders.h"

namespace pedicel::discrepancy {

class PlantMaker;

/// Mesh and step of a prediction of a scene.
struct SceneNumerics {
  double distance = 0.01;  ///< m between nodes, at most the plant file's
  double dt = 1.0e-3;      ///< s
  double junction = 0.05;  ///< 1, of `distance`: the short segment below a junction
  /// m, the gap at which contact begins to push. What people measure touches when it touches; the
  /// margin of a scene keeps resting things apart.
  double margin = 1.0e-5;
  double tolerance = 1.0e-7;  ///< m and rad, of Newton's method in a step
  /// Step, mesh, margin, solver and start are those of a run of the scene, and not the above: what
  /// was measured is a log of such a run.
  bool as_run = false;
  double run_steps = 1.0;  ///< then: of the run that one step of the prediction takes
};

/// What plants and arm really did in a trial, step by step.
struct SceneMotion {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  std::vector<double> time;  ///< s, of each step, 0 first
  Rows position, velocity;   ///< steps x 3 markers, m and m/s, W; of the robot's markers 0
  Rows turn;                 ///< steps x 4 markers, x y z w: since it was drawn, W
  Rows contact;              ///< steps x 6 sensors, N and N m: of plants on links, link's frame
  Rows effort;               ///< steps x dofs, N m or N: J^T of what plants exert on links
  /// steps x 3 dofs, rad, rad/s, rad/s2: how far joints gave way, how fast, and its change. Empty
  /// where they do not.
  Rows given;
  std::vector<MeasuredEvent> events;  ///< fruits that came off
  bool healthy = true;                ///< false: the simulation failed where the rows end
};

/// A force from outside on a place of a plant.
struct SceneForce {
  int plant = 0;
  plant::CurvePlace place;
  Vec3 force = Vec3::Zero();                               ///< N, W
  double from = 0.0;                                       ///< s
  double until = std::numeric_limits<double>::infinity();  ///< s
  double rise = 0.1;                                       ///< s, evenly, from `from` on
};

/// One variant of a trial to be simulated.
struct SceneMember {
  const SceneState* state = nullptr;
  const Arm* arm = nullptr;
  const JointPath* path = nullptr;  ///< of the arm's readings, in the order of its model
  bool is_run = false;  ///< the path is that of the links themselves (commands), not of readings
  /// s, of a step of the run that was logged: velocities are those of its steps; 0: measured.
  double run_step = 0.0;
  std::vector<plant::Effect> effects;  ///< of the plants' models
  std::span<const SceneForce> forces;
};

/// Simulates variants of one trial side by side: each is a simulation::Simulation whose robot goes
/// as `path` says. Coupling is one-way, unless joints give way. `makers`: one a plant of the
/// experiment, built for the trial's poses. `fields`: of the robot.
std::vector<SceneMotion> run_scene_trial(const Experiment& experiment, const Trial& trial,
                                         std::span<const std::unique_ptr<PlantMaker>> makers,
                                         const simulation::ShapeFields& fields,
                                         const SceneNumerics& numerics, double until,
                                         std::span<const SceneMember> members,
                                         const std::atomic<bool>& stop);

/// The joints of the arm at a time as its state says: readings with delay and offsets.
JointPath::Point arm_at(const SceneMember& member, double t);

}  // namespace pedicel::discrepancy
