#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/world/recorder.h"
#include "engine/world/step.h"
#include "plugins/cosserat/model/rod_state.h"
#include "plugins/simulation/plants/scene_ties.h"
#include "plugins/simulation/scene_assets.h"

namespace pedicel::app {

enum class RunMode { empty, building, paused, playing, replaying, unstable };
std::string to_string(RunMode mode);

struct PlantSnapshot {
  /// A new one after a rebuild, a change of parameters or a break; else the same.
  std::shared_ptr<const cosserat::RodModel> model;
  cosserat::RodState state;
  std::vector<double> margin_used;  ///< 1, one a fruit: 1 breaks; 0 once it is off
};

/// A rigid body, and the fruit that it was.
struct BodyInfo {
  world::BodyDescription description;
  int plant = -1, fruit = -1;                   ///< -1: never was a fruit
  double stub_length = 0.0, stub_radius = 0.0;  ///< m
};
struct BodySnapshot {
  std::shared_ptr<const BodyInfo> info;
  Pose pose;  ///< X_W
};

struct ContactSnapshot {
  Vec3 place_W = Vec3::Zero();  ///< m
  Vec3 force_W = Vec3::Zero();  ///< N, on the plant
  int plant = 0, element = 0;
  int collider = -1;  ///< index into Snapshot::colliders; -1: the plant itself
};

struct RobotSnapshot {
  bool present = false;
  int tool_link = 0;        ///< index into the description's links
  std::vector<Pose> links;  ///< X_W, in the order of the description
  Eigen::VectorXd q;        ///< rad or m, measured
  Eigen::VectorXd goal;     ///< rad or m, where it is told to go in the end
  Eigen::VectorXd torques;  ///< N m or N
  Pose tool;                ///< X_W
  bool follows_program = false;
  bool loops = false;             ///< the program goes on and on
  double program_time = 0.0;      ///< s, since the program (or its lap) began
  double program_duration = 0.0;  ///< s
};

/// A string that holds a plant, as it runs now.
struct TieSnapshot {
  int number = 0;  ///< in the scene's list, from 0
  simulation::SceneTies::Course course;
};

/// The spring of a pull, as it acts.
struct PullSnapshot {
  bool active = false;
  std::string organ;
  Vec3 point_W = Vec3::Zero(), target_W = Vec3::Zero();  ///< m
  Vec3 force_W = Vec3::Zero();                           ///< N, on the plant
};

/// One complete step of the simulation, to be drawn and read. Made on the simulation's thread,
/// never changed after.
struct Snapshot {
  std::uint64_t number = 0;  ///< grows with every snapshot
  std::uint64_t stage = 0;   ///< grows when another simulation was built
  RunMode mode = RunMode::empty;
  std::string error;                             ///< why it is unstable; empty: it is not
  std::string culprit;                           ///< the organ (or joint, or body) of it
  int culprit_plant = -1, culprit_element = -1;  ///< -1: not a plant
  double last_good_time = 0.0;                   ///< s
  std::uint64_t document_hash = 0;               ///< Document::state_hash() of what is simulated

  std::shared_ptr<const simulation::SceneAssets> assets;  ///< null: nothing was built yet
  long step = 0;
  double time = 0.0;  ///< s
  world::WorldReport report;
  std::vector<PlantSnapshot> plants;
  std::vector<BodySnapshot> bodies;
  RobotSnapshot robot;
  std::vector<TieSnapshot> ties;  ///< that still hold something
  std::vector<ContactSnapshot> contacts;
  std::shared_ptr<const std::vector<std::string>> colliders;  ///< names
  PullSnapshot pull;
  std::shared_ptr<const std::vector<world::Event>> events;  ///< since time 0

  double largest_strain = 0.0;  ///< 1, at a surface, from the unloaded shape
  std::string largest_strain_organ;
  double speed = 1.0;             ///< 1, asked for; 0: as fast as it goes
  double real_time_factor = 0.0;  ///< 1, over the last half second
  double ms_per_step = 0.0, ms_per_step_p95 = 0.0;
  double steps_per_second = 0.0, snapshots_per_second = 0.0;
  double replay_share = 0.0;  ///< 1, done of a replay
};

}  // namespace pedicel::app
