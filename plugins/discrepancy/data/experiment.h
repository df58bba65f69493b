#pragma once

#include <Eigen/Dense>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/frames.h"
#include "engine/robot/description.h"
#include "engine/world/scene.h"
#include "plugins/discrepancy/data/instruments.h"
#include "plugins/plant/plant_file.h"

namespace pedicel::discrepancy {

/// A known motion: linear between its rows, the first and last row kept before and after.
struct DrivenPath {
  std::vector<double> time;    ///< s, increasing
  std::vector<Vec3> position;  ///< m, W
  /// By how much what moves has turned since it was drawn (W; identity: as drawn); empty where the
  /// file gives no orientation.
  std::vector<Quat> rotation;
  std::filesystem::path file{};  ///< from the trial's folder; empty where it was made by a program

  Vec3 position_at(double t) const;
  Quat rotation_at(double t) const;  ///< shortest way between rows; identity where there is none
};

/// A point that is held to a path until `release` (free from then on). The reader gives a hold
/// without `release` the end of its path where the trial goes on longer.
struct Hold {
  plant::CurvePlace place;
  DrivenPath path;
  double release = std::numeric_limits<double>::infinity();  ///< s
  std::optional<double> stiffness{};                         ///< N/m; absent: rigid
  /// Unit vectors (W), across each other, along which alone it leads: the point slides along the
  /// others without friction. Empty: it leads along all.
  std::vector<Vec3> axes{};
  bool one_sided = false;  ///< of a single axis: it only pushes, along the axis
  bool direction = false;  ///< of the path's orientation it leads the segment's direction alone

  bool slides() const { return !axes.empty(); }
};

/// A force that acts for from <= t < to.
struct TimedLoad {
  plant::CurvePlace place;
  Vec3 force = Vec3::Zero();  ///< N, W
  double from = -std::numeric_limits<double>::infinity();
  double to = std::numeric_limits<double>::infinity();
};

/// Samples over time: one row a sample, NaN where nothing was measured; a whole column of NaN is an
/// axis that was not measured.
struct Samples {
  std::vector<double> time;  ///< s, increasing
  Eigen::MatrixXd value;     ///< samples x columns
  int size() const { return static_cast<int>(time.size()); }
};

/// Something that happened: `what` is an organ or fruit, `by` the link that did it, in a scene.
struct MeasuredEvent {
  double time = 0.0;  ///< s
  std::string event;  ///< grasped | released | detached | slipped
  std::string what = {}, by = {};

  bool is_detachment() const { return event == "detached"; }
};

/// One run of the experiment: what was done, and what was measured. Either a plant is held, loaded
/// and moved, or a robot is at the plants. Every table has its own times, on one clock; NaN where
/// nothing was measured.
struct Trial {
  enum class Use { unset, fit, check };
  struct Mass : plant::PlantMass {
    int plant = 0;  ///< index into Experiment::plants
    bool operator==(const Mass&) const = default;
  };

  std::string name;
  std::filesystem::path folder;  ///< from the experiment's, as in the file
  Use use = Use::unset;
  double clock = 0.0;                  ///< s since the first trial
  std::vector<Mass> masses;            ///< known ones that hang on plants
  std::vector<plant::Effect> effects;  ///< known in this trial
  Samples markers;                     ///< m, W; 3 columns a marker, in the experiment's order
  std::vector<MeasuredEvent> events;

  // Of a plant without a robot.
  Vec3 gravity = Vec3(0, 0, -9.81);  ///< m/s2
  std::vector<Hold> holds;
  std::vector<TimedLoad> loads;
  std::optional<DrivenPath> base;
  /// s: it begins in motion, and its first samples, up to this time, say how the plant stands and
  /// moves at time 0. Absent: at rest.
  std::optional<double> window;
  /// Without time: row i of every table belongs together, with the plant in equilibrium. A sample's
  /// time is then the number of its row.
  bool is_static = false;
  Samples force;  ///< N, W; 3 columns: the first hold's pull on the plant; empty: not measured
  /// N and N m, W; 6 columns: force and moment of what carries the plant on it, at the root as it
  /// is then; empty: not measured.
  Samples wrench;
  std::filesystem::path wrench_file;  ///< from the trial's folder

  // Of a robot at plants.
  /// The controller gets the commands; else the encoders are believed.
  bool follows_commands = false;
  std::map<int, Pose> poses;       ///< X_WP of plants that stood elsewhere in this trial
  std::vector<int> joint_columns;  ///< degree of freedom of each column of the three tables below
  Samples joints;                  ///< rad or m, as the encoders read them
  std::vector<int> command_columns;
  Samples commands;  ///< rad or m
  std::vector<int> torque_columns;
  Samples torques;                ///< N m or N, of the motors
  std::vector<Samples> pixels;    ///< px, one a camera; 2 columns a marker
  std::vector<Samples> wrenches;  ///< N and N m, one a sensor; 6 columns

  double duration() const;  ///< s, of the last sample of anything
};

/// A plant of the experiment, as its file and the scene say.
struct ExperimentPlant {
  std::string name;  ///< as in the scene
  plant::PlantFile file;
  std::filesystem::path path;  ///< of its file, for the leaf templates beside it
  Pose pose;                   ///< X_WP
};

/// An experiment folder, whole: the page Experiment folder of the manual. Its model is a scene with
/// a robot, or a single plant.
struct Experiment {
  std::filesystem::path folder;
  std::string title;
  /// The nominal ones; one in place of a scene.
  std::vector<ExperimentPlant> plants = std::vector<ExperimentPlant>(1);
  std::vector<Marker> markers;
  StatedNoise noise;
  std::vector<plant::Effect> effects;  ///< known in every trial
  std::vector<Trial> trials;

  // Of a robot at plants.
  std::filesystem::path scene_path;  ///< as the file says it, from the folder
  world::Scene scene;
  robot::RobotDescription robot;
  std::vector<Camera> cameras;
  std::vector<WrenchSensor> wrenches;
  std::vector<plant::Effect> scene_effects;  ///< known in every trial: of the scene's file
  /// A log of a run of the scene by this program, so that step, mesh and contact are the run's.
  bool is_run = false;

  bool has_robot() const { return scene.robot.has_value(); }
  plant::PlantFile& plant() { return plants.front().file; }  ///< of an experiment of one plant
  const plant::PlantFile& plant() const { return plants.front().file; }
  int plant_index(const std::string& name) const;  ///< -1 where there is none
};

/// Whether it was recorded when fruits came off, in any trial: then those that no trial names
/// stayed on.
bool records_detachments(const Experiment& experiment);

/// Columns of joints by their degrees of freedom: names in the order of the robot's model.
std::vector<std::string> joint_names(const robot::RobotDescription& robot);

}  // namespace pedicel::discrepancy
