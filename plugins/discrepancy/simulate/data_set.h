#pragma once

#include <span>
#include <vector>

#include "pedicel/discrepancy/simulate/noise.h"
#include "pedicel/discrepancy/simulate/simulator.h"

namespace pedicel::discrepancy {

/// The measured channels of an experiment with their noise: turns predictions into residuals that
/// are white and of unit variance where nothing but noise is left. Residual vectors have one entry
/// for every sample of the chosen trials, zero where nothing was measured (or `until` has passed).
class DataSet {
 public:
  explicit DataSet(const Experiment& experiment);

  const Experiment& experiment() const { return *experiment_; }
  void set_noise(const Noise& position, const Noise& force);
  /// Estimates it from series of positions (m) and forces (N), within what the experiment states.
  void choose_noise(std::span<const Series> position, std::span<const Series> force,
                    const NoiseRule& rule);
  const Noise& position_noise() const { return position_; }
  const Noise& force_noise() const { return force_; }

  /// Entries of a residual vector over these trials, and how many of them hold a sample up to the
  /// share `horizon` of each trial's duration.
  int size(std::span<const int> trials) const;
  int samples(std::span<const int> trials, double horizon = 1.0) const;

  /// Whitened data minus prediction of one trial into `out` (its size({trial}) entries).
  void residual(int trial, const Prediction& prediction, double horizon,
                Eigen::Ref<Eigen::VectorXd> out) const;
  /// The same without whitening, in units of the noise of a sample; NaN where nothing was measured.
  /// Markers' columns first, then the force's.
  Eigen::MatrixXd scaled_residual(int trial, const Prediction& prediction) const;
  /// Data minus prediction (m and N), one series a channel and trial, for estimate_noise().
  void raw_residuals(int trial, const Prediction& prediction, std::vector<Series>& position,
                     std::vector<Series>& force) const;

  /// RMS over these trials of data minus prediction in units of the noise of a sample, 0 without a
  /// sample; one prediction a trial of the experiment.
  double rms(std::span<const int> trials, std::span<const Prediction> predictions) const;

  double end_of(int trial, double horizon) const;

 private:
  const Experiment* experiment_;
  Noise position_ = white_noise(1.0), force_ = white_noise(1.0);
};

/// The data's own series, for a first estimate of the noise before anything was simulated.
void measured_series(const Experiment& experiment, std::vector<Series>& position,
                     std::vector<Series>& force);

}  // namespace pedicel::discrepancy
