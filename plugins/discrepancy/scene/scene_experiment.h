#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/robot/description.h"
#include "engine/world/scene.h"
#include "plugins/discrepancy/data/experiment.h"

namespace pedicel::discrepancy {

/// A measured point: on a curve of a plant, a fruit's centre, or a point of the robot.
struct SceneMarker {
  std::string name;
  int plant = -1;                ///< index into SceneExperiment::plants; -1: of the robot
  plant::CurvePlace place;       ///< of a curve; its name is empty where it is a fruit or a link
  int fruit = -1;                ///< index into the plant's fruits
  int link = -1;                 ///< of the robot's description
  Vec3 offset_L = Vec3::Zero();  ///< m, in the link's frame
};

/// A pinhole with Brown's distortion. C: x right, y down, z forward.
struct Camera {
  std::string name;
  Pose X_WC;
  Eigen::Vector2d focal = {1000, 1000};  ///< px
  Eigen::Vector2d centre = {640, 360};   ///< px
  std::array<int, 2> size{1280, 720};    ///< px
  std::array<double, 5> distortion{};    ///< 1: k1 k2 p1 p2 k3
};

/// What a link and all beyond it exert on what carries it: about the origin of the link's frame, in
/// that frame, weight and inertia included.
struct WrenchSensor {
  std::string name;
  int link = -1;       ///< of the robot's description
  bool tared = false;  ///< less its mean over the first tare_time
};
inline constexpr double tare_time = 0.2;  ///< s

/// Known noise of the instruments; what is absent is estimated from the data.
struct SceneNoise {
  std::optional<double> position_std;  ///< m
  std::optional<double> pixel_std;     ///< px
  std::optional<double> force_std;     ///< N
  std::optional<double> moment_std;    ///< N m
  std::optional<double> joint_std;     ///< rad (m of a sliding joint)
  std::optional<double> torque_std;    ///< N m (N)
};

/// One run of the robot at the plants, and what was measured. Every table has its own times, on one
/// clock; NaN where nothing was measured.
struct SceneTrial {
  std::string name;
  std::filesystem::path folder;  ///< from the experiment's, as in the file
  Trial::Use use = Trial::Use::unset;
  double clock = 0.0;  ///< s since the first trial
  struct Mass {
    int plant = 0;
    plant::PlantMass mass;
  };
  std::vector<Mass> masses;
  bool follows_commands =
      false;                  ///< the controller gets the commands; else the encoders are believed
  std::map<int, Pose> poses;  ///< X_WP of plants that stood elsewhere in this trial
  std::vector<plant::Effect> effects;

  std::vector<int> joint_columns;  ///< degree of freedom of each column of the three tables below
  Samples joints;                  ///< rad or m, as the encoders read them
  std::vector<int> command_columns;
  Samples commands;  ///< rad or m
  std::vector<int> torque_columns;
  Samples torques;                ///< N m or N, of the motors
  Samples markers;                ///< m, W; 3 columns a marker, in the experiment's order
  std::vector<Samples> pixels;    ///< px, one a camera; 2 columns a marker
  std::vector<Samples> wrenches;  ///< N and N m, one a sensor; 6 columns
  std::vector<MeasuredEvent> events;

  double duration() const;  ///< s, of the last sample of anything
};

/// A plant of the scene, as its file and the scene say.
struct ScenePlantFile {
  std::string name;  ///< as in the scene
  plant::PlantFile file;
  std::filesystem::path path;
  Pose pose;  ///< X_WP
};

/// A measured run of a robot at plants: formats, the page Scene experiment of the manual.
struct SceneExperiment {
  std::filesystem::path folder;
  std::string title;
  std::filesystem::path scene_path;  ///< as the file says it, from the folder
  world::Scene scene;
  std::vector<ScenePlantFile> plants;
  robot::RobotDescription robot;
  std::vector<SceneMarker> markers;
  std::vector<Camera> cameras;
  std::vector<WrenchSensor> wrenches;
  SceneNoise noise;
  std::vector<plant::Effect> scene_effects;  ///< known in every trial: of the scene's file
  std::vector<plant::Effect> effects;        ///< likewise, of the experiment's
  std::vector<SceneTrial> trials;
  /// A log of a run of the scene by this program, so that step, mesh and contact are the run's.
  bool is_run = false;

  int plant_index(const std::string& name) const;  ///< -1 where there is none
};

/// Columns of joints by their degrees of freedom: names in the order of the robot's model.
std::vector<std::string> joint_names(const robot::RobotDescription& robot);

}  // namespace pedicel::discrepancy
