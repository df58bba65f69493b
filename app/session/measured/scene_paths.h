#pragma once

#include <Eigen/Dense>
#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "app/session/measured/model_paths.h"
#include "plugins/discrepancy/scene_predict/scene_simulator.h"

/// What models say of a measured scene's trials, as the window shows it.
namespace pedicel::app {

/// What one instrument reported in a trial: a table, or the columns of one that have a unit.
struct SceneInstrument {
  enum class Kind { markers, image, force, moment, torques, encoders };
  Kind kind = Kind::markers;
  int index = 0;  ///< of the camera or of the wrench sensor
  std::string name, unit;
  std::vector<std::string> columns;  ///< "m1.x"
  int first = 0;                     ///< of the table's columns
  double scale = 1.0;                ///< table's values to `unit`
};

/// Those that measured something in that trial. Encoders count where the arm followed commands:
/// elsewhere they are believed.
std::vector<SceneInstrument> instruments_of(const discrepancy::Experiment& experiment, int trial);
/// The table of an instrument, with its other columns.
const discrepancy::Samples& measured_by(const SceneInstrument& instrument,
                                        const discrepancy::Trial& trial);

/// The curves and fruits of one of the scene's plants, for pictures.
struct ScenePlantShape {
  std::vector<ShapeCurve> curves;  ///< `first` counts over all plants of the scene
  std::vector<int> fruits;         ///< each one's place among the points
  std::vector<double> radii;       ///< m, of the fruits
};
std::vector<ScenePlantShape> shapes_of(const discrepancy::Experiment& experiment);

/// What a model says of one trial.
struct ScenePath {
  discrepancy::SceneReadings readings;  ///< as the trial's tables
  std::vector<double> time;             ///< s, of the rows of the next two
  Eigen::MatrixXd places;               ///< rows x 3 markers, m, W; as the sensor would see them
  Eigen::MatrixXd shape;                ///< rows x 3 points of shapes_of(), m, W
  std::vector<double> rms;  ///< of each of instruments_of(), in its unit; NaN: nothing to compare
  bool healthy = true;      ///< false: the simulation failed
};

/// Of an instrument: the matrix that belongs to measured_by().
const Eigen::MatrixXd& said_by(const SceneInstrument& instrument,
                               const discrepancy::SceneReadings& readings);

/// Simulates all trials with some models, the shapes of plants included, and calls `done` for each
/// as soon as it is there. Returns early, with nothing more said, once `stop` is set. Throws as
/// discrepancy::SceneSimulator does.
void simulate_scene_paths(const discrepancy::Experiment& experiment,
                          const std::vector<discrepancy::SceneVariant>& variants,
                          const std::atomic<bool>& stop,
                          const std::function<void(int trial, int variant, ScenePath path)>& done);

/// The arm's joints in a trial, as they were measured; of an arm that follows commands and whose
/// encoders were not read, as it was told.
discrepancy::JointPath measured_arm(const discrepancy::Experiment& experiment, int trial);

}  // namespace pedicel::app
