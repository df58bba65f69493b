#pragma once

#include <Eigen/Dense>
#include <functional>
#include <vector>

#include "tests/discrepancy/reference_trial.h"

namespace pedicel::hidden {

/// Noise of one experiment: each channel on its own AR(1), x_i = rho x_i-1 + e_i.
struct Noise {
  double position_std = 3e-4;  ///< m
  double force_std = 0.01;     ///< N
  double rho = 0.0;            ///< of the markers, from sample to sample; force noise is white
  double moment_std = 1e-3;    ///< N m, of a moment at the foot
};

/// All channels of all trials in units of the noise's own innovations: changes of such vectors have
/// covariance 1, and their length is what can be told apart.
Eigen::VectorXd whitened(const std::vector<reference::Record>& records, const Noise& noise);

/// What a change of the plant does to the data beyond what a refit could do as well.
class Sight {
 public:
  /// `predict` runs all trials and gives the whitened data.
  using Predict = std::function<Eigen::VectorXd(const reference::Subject&)>;

  /// A refit may put a factor on each of the parameters `absorbing`.
  Sight(const reference::Subject& subject, Predict predict, std::vector<std::string> absorbing);

  /// The whitened change with `with` in place of the subject that is left when the factors of the
  /// subject are refitted to it: orthogonal to the changes by `absorbing`. (Not the other way
  /// round, the factors of `with` refitted to the subject: where nothing measures a force, modulus
  /// and density together would run off until a hidden mass is none.) Large changes need the refit
  /// itself: a frequency that is a little off fills a long record with the second order of its
  /// phase, which is no part of a linear projection, and modulus and density together go far where
  /// either alone hardly moves.
  struct Change {
    Eigen::VectorXd rest;   ///< noise units
    Eigen::VectorXd refit;  ///< logarithms of the factors that took the most away
  };
  /// `start` (logarithms of factors, or empty) is where the refit starts from: near its end, or a
  /// long oscillation is met out of phase.
  Change change(const reference::Subject& with, const Eigen::VectorXd& start = {}) const;

  /// The data of the subject, and their changes by the logarithms of the factors `absorbing`.
  const Eigen::VectorXd& plain() const { return plain_; }
  const Eigen::MatrixXd& columns() const { return columns_; }

 private:
  int factors() const { return static_cast<int>(absorbing_.size()); }
  /// The data of the subject with these factors.
  Eigen::VectorXd refitted(const Eigen::VectorXd& refit) const;
  /// Differences by the factors' logarithms about `refit`.
  Eigen::MatrixXd changes_by_factors(const Eigen::VectorXd& refit) const;

  reference::Subject subject_;
  Predict predict_;
  std::vector<std::string> absorbing_;
  Eigen::VectorXd plain_;
  Eigen::MatrixXd columns_;  // changes_by_factors() of the subject itself
};

/// A factor on a legitimate parameter as an effect.
plant::Effect factor(const std::string& parameter, double value);

/// Sine of the angle between two changes.
double sine(const Eigen::VectorXd& a, const Eigen::VectorXd& b);

/// The size at which norm(size) is `level`, from a first guess, within 5 % of the level; at most
/// `cap`. Norms grow with size, near proportionally where nothing has a threshold.
double size_for(const std::function<double(double)>& norm, double level, double guess, double cap);

}  // namespace pedicel::hidden
