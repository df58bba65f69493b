#pragma once

#include <span>
#include <vector>

#include "plugins/discrepancy/simulate/noise.h"
#include "plugins/discrepancy/simulate/path_noise.h"
#include "plugins/discrepancy/simulate/simulator.h"

namespace pedicel::discrepancy {

enum class ChannelKind { position, force, moment };

/// Channels by the kind of sensor.
struct AllSeries {
  std::vector<Series> position, force, moment;  ///< m, N, N m
};

/// The measured channels of an experiment with their noise: turns predictions into residuals that
/// are white and of unit variance where nothing but noise is left. Residual vectors have one entry
/// for every sample of the chosen trials, zero where nothing was measured (or `until` has passed).
class DataSet {
 public:
  explicit DataSet(const Experiment& experiment);

  const Experiment& experiment() const { return *experiment_; }
  void set_noise(const Noise& position, const Noise& force);
  void set_moment_noise(const Noise& moment);
  /// Estimates it from series of positions (m), forces (N) and moments (N m), within what the
  /// experiment states.
  void choose_noise(const AllSeries& series, const NoiseRule& rule);
  /// How a trial that begins in motion answers to how it begins: changes of its prediction. What
  /// they explain is left out of its residuals, as if its beginning were fitted with each model.
  void set_start_directions(int trial, std::vector<Prediction> directions);
  const Noise& position_noise() const { return position_; }
  const Noise& force_noise() const { return force_; }
  const Noise& moment_noise() const { return moment_; }

  /// Entries of a residual vector over these trials, and how many of them hold a sample up to the
  /// share `horizon` of each trial's duration.
  int size(std::span<const int> trials) const;
  int samples(std::span<const int> trials, double horizon = 1.0) const;

  /// Whitened data minus prediction of one trial into `out` (its size({trial}) entries).
  void residual(int trial, const Prediction& prediction, double horizon,
                Eigen::Ref<Eigen::VectorXd> out) const;
  /// The same without whitening, in units of the noise of a sample; NaN where nothing was measured.
  /// Markers' columns first, then the force's and the wrench's.
  Eigen::MatrixXd scaled_residual(int trial, const Prediction& prediction) const;
  /// Data minus prediction (m, N and N m), one series a channel and trial, for choose_noise(). Rows
  /// of a static series, each at rest by itself, tell nothing of it.
  void raw_residuals(int trial, const Prediction& prediction, AllSeries& series) const;

  /// RMS over these trials of data minus prediction in units of the noise of a sample, 0 without a
  /// sample; one prediction a trial of the experiment.
  double rms(std::span<const int> trials, std::span<const Prediction> predictions) const;

  double end_of(int trial, double horizon) const;

 private:
  struct Channel;
  /// How a trial may begin otherwise: changes, whitened or in noise units of a sample.
  struct Freedom {
    std::vector<Prediction> directions;
    Eigen::MatrixXd white, white_basis, scaled_basis;
  };
  template <class Call>
  void for_each_channel(int trial, const Call& call) const;
  const Noise& noise_of(const Channel& channel) const;
  Eigen::VectorXd weights(int trial, const Channel& channel) const;
  Eigen::MatrixXd scaled(int trial, const Prediction& prediction) const;
  void leave_out_start(int trial, double end, Eigen::Ref<Eigen::VectorXd> residual) const;
  void renew_freedom(int trial);

  const Experiment* experiment_;
  Noise position_ = white_noise(1.0), force_ = white_noise(1.0), moment_ = white_noise(1.0);
  std::vector<PathNoise> path_noise_;  // by trial
  std::vector<Freedom> freedom_;       // likewise
};

/// The data's own series, for a first estimate of the noise before anything was simulated.
AllSeries measured_series(const Experiment& experiment);

}  // namespace pedicel::discrepancy
