#pragma once

#include <optional>
#include <span>
#include <vector>

#include "plugins/discrepancy/test/projection.h"

namespace pedicel::discrepancy {

/// One decaying oscillation exp(-decay t) (cosine cos(w t) + sine sin(w t)).
struct Oscillation {
  double cosine = 0.0, sine = 0.0;  ///< m, at t = 0
  double w = 0.0;                   ///< rad/s, damped
  double decay = 0.0;               ///< 1/s

  double amplitude() const;
  double frequency() const;      ///< Hz
  double damping_ratio() const;  ///< 1
};

/// Oscillations about a constant that describe a series best, and the covariance of
/// (constant, then cosine, sine, w, decay of each).
struct OscillationFit {
  double constant = 0.0;
  std::vector<Oscillation> modes;
  Eigen::MatrixXd covariance;
  double scatter = 0.0;  ///< RMS of what is left over the noise

  double frequency_error(int mode) const;  ///< Hz
  double damping_error(int mode) const;
  double amplitude_error(int mode) const;  ///< m
};

/// Generalised least squares by Gauss-Newton from the given oscillations, for evenly spaced samples
/// `dt` (s) apart, NaN where nothing was measured. Nothing where it does not converge.
std::optional<OscillationFit> fit_oscillations(const Series& series, double dt, const Noise& noise,
                                               std::span<const Oscillation> start);

/// First guesses: the main oscillation by its zero crossings (nothing below two periods), and the
/// strongest one above 1.8 times its frequency in what it leaves.
std::optional<Oscillation> main_oscillation(const Series& series, double dt);
std::optional<Oscillation> higher_oscillation(const Series& left, double dt, double above_w);

/// Values of a fit at its samples.
Series values_of(const OscillationFit& fit, Eigen::Index samples, double dt);

}  // namespace pedicel::discrepancy
