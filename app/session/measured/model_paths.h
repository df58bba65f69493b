#pragma once

#include <Eigen/Dense>
#include <atomic>
#include <functional>
#include <vector>

#include "plugins/discrepancy/simulate/simulator.h"

/// What models say of an experiment's trials, as the window shows it.
namespace pedicel::app {

/// A curve of the plant as a row of points, for pictures.
struct ShapeCurve {
  int curve = 0;               ///< index in the plant file
  int first = 0;               ///< its first point among all
  std::vector<double> at;      ///< 1, in [0, 1], of each point
  std::vector<double> radius;  ///< m, there
};

/// Every curve of the plant with a point about every 15 mm.
std::vector<ShapeCurve> shape_of(const plant::PlantFile& plant);

/// What a model says of one trial, at the times of its marker samples.
struct TrialPath {
  Eigen::MatrixXd markers;  ///< samples x 3 markers, m, W; as the sensor would see them
  Eigen::MatrixXd shape;    ///< samples x 3 points of shape_of(), m, W; empty: not known (yet)
  Eigen::MatrixXd force;    ///< samples of the force x 3, N, W; empty: none was measured
  bool healthy = true;      ///< false: the simulation failed

  std::vector<double> marker_rms;  ///< m, distance from the measured place, one a marker; NaN:
                                   ///< never seen
  double rms = 0.0;                ///< m, of all markers and samples
};

/// Measured less simulated, into `marker_rms` and `rms`.
void measure_error(const discrepancy::Trial& trial, TrialPath& path);

/// Simulates all trials with some variants of the nominal model side by side, plant and markers,
/// and calls `done` for each as soon as it is there: trial, variant, path. Returns early, with
/// nothing more said, once `stop` is set. Throws as discrepancy::Simulator does.
void simulate_paths(const discrepancy::Experiment& experiment,
                    const std::vector<discrepancy::Variant>& variants,
                    const discrepancy::Numerics& numerics, const std::atomic<bool>& stop,
                    const std::function<void(int trial, int variant, TrialPath path)>& done);

/// RMS distance of the markers on a curve, carried along it (m): linear between them, as the last
/// one beyond the ends, NaN on a curve without markers. `marker_rms` as in TrialPath.
double residual_along(const discrepancy::Experiment& experiment,
                      const std::vector<double>& marker_rms, const std::string& curve, double at);

}  // namespace pedicel::app
