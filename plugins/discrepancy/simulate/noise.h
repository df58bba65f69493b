#pragma once

#include <Eigen/Dense>
#include <span>
#include <vector>

namespace pedicel::discrepancy {

/// Stationary noise of one kind of channel: an autoregressive process, by Levinson-Durbin at every
/// order up to its own, so that it can start afresh after a gap.
struct Noise {
  double std = 1.0;                          ///< m or N, of a sample
  std::vector<std::vector<double>> weights;  ///< [order - 1][lag - 1]
  std::vector<double> innovation;            ///< m or N, standard deviation by order, 0 first

  int order() const { return static_cast<int>(weights.size()); }
  /// Lag-one correlation.
  double correlation() const { return weights.empty() ? 0.0 : weights.front().front(); }
};

/// From the autocovariances (m2 or N2) at lags 0, 1, ...: the order up to `covariance.size() - 1`
/// whose Bayesian information criterion over `samples` is least.
Noise autoregressive(std::span<const double> covariance, double samples);

/// White noise.
Noise white_noise(double std);

/// A stretch of one channel at even sampling; NaN where nothing was measured.
using Series = Eigen::VectorXd;

/// Noise of channels that share one kind of sensor, from stretches at rest: windows whose
/// scatter is near the least one found. Covariances come from the variogram, half the mean square
/// difference of samples `k` apart, which neither a constant nor a slow drift biases (Cressie,
/// Statistics for Spatial Data, 2.4). `stated_std`: used for the scale where there is no better
/// estimate (0: none). Without any samples: white noise of `stated_std`, or 1.
Noise estimate_noise(std::span<const Series> channels, double stated_std);

/// What becomes of an estimate below a deviation that is stated: it comes from channels that stand
/// still, which scatter less than those that move.
struct NoiseRule {
  double least_share = 1.0;  ///< of what is stated, below which an estimate is too small
  /// True: it is raised to what is stated, with its colour; false: white noise of what is stated.
  bool keep_colour = true;
};

/// The estimate, bounded by what is stated (m or N; 0: nothing is). Motion that no window is free
/// of can only raise an estimate: one above 1.2 times what is stated is brought down to it.
Noise choose_noise(std::span<const Series> channels, double stated_std, const NoiseRule& rule);

/// The innovations of a residual series in units of their standard deviation: white, and of unit
/// variance where the noise is as modelled. NaN stays NaN; after a gap the process starts afresh.
Eigen::VectorXd whiten(const Series& residual, const Noise& noise);

}  // namespace pedicel::discrepancy
