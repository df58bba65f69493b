#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "plugins/discrepancy/fit/fit_parts.h"
#include "plugins/discrepancy/fit/profile.h"

namespace pedicel::discrepancy {

struct ParameterFitOptions {
  int threads = 1;
  std::uint64_t seed = 1;  ///< of the starts that are drawn
  /// What is being done, and the share of the whole that is done (an estimate).
  std::function<void(const std::string&, double)> progress;
  const std::atomic<bool>* stop = nullptr;
  FitParts* parts = nullptr;  ///< does starts and profiles; null: they are done here
};

/// A number that was asked for, with its 95 % interval by profile likelihood.
struct FittedParameter {
  std::string name;  ///< "youngs_modulus", "extra_mass.mass@stem:0.7", a vector's with [0] to [2]
  std::string unit;
  double value = 0.0, low = 0.0, high = 0.0;
  /// The data do not object to anything up to this side's bound.
  bool low_open = false, high_open = false;
  bool at_bound = false;  ///< the value itself
  /// False: open on both sides, or it moves no sample by a tenth of the noise.
  bool seen = true;
};

/// Of one trial: RMS of data minus prediction over the noise of a sample.
struct TrialError {
  std::string trial;
  bool check = false;  ///< not fitted
  double rms = 0.0;
};

struct ParameterFit {
  FitSummary summary;  ///< its hypothesis also holds what was not seen, as it was given
  std::vector<FittedParameter> parameters;
  std::vector<TrialError> trials;
  std::vector<std::pair<std::string, double>> noise;  ///< "position_std" and its like, in SI units
  double distance = 0.0, dt = 0.0;                    ///< m between nodes, s
  double numerical_error = 0.0;  ///< RMS over the noise, before it was corrected for
  /// RMS of the whitened residual where that is above 1: more than noise is left, and the intervals
  /// are wider by it.
  double spread = 1.0;
  int starts = 0;  ///< looked at
  int refits = 0;  ///< for the intervals
  bool stopped = false;
  std::vector<std::string> remarks;  ///< on the data, one sentence each
  long simulations = 0;
  double seconds = 0.0;
};

/// An experiment that is ready to be fitted.
class FitGround {
 public:
  virtual ~FitGround() = default;
  virtual const Experiment& experiment() const = 0;
  /// Valid until refine() or renew_noise().
  virtual ResidualSource& source() = 0;
  virtual FitOptions options() const = 0;  ///< of the trials to be fitted
  virtual std::vector<int> check_trials() const = 0;
  /// Where fits of what every model has begin: modulus, density, damping.
  virtual Hypothesis baseline() = 0;
  /// Of the first look from several starts, a share of each trial.
  virtual double first_horizon() const { return 1.0; }
  /// Checks mesh and step about a model, and refits it where they change. Our own error, RMS over
  /// the noise.
  virtual double refine(FitSummary&, const std::function<void(int round)>&) { return 0.0; }
  /// Unknowns that nobody asked for, and that an interval must leave free.
  virtual Hypothesis nuisance() const { return {}; }
  virtual void renew_noise(const Hypothesis& model) = 0;
  /// Of each trial, over the noise of a sample, one column a model.
  virtual std::vector<std::vector<Misfit>> misfits(std::span<const Hypothesis> models) = 0;
  /// Noise, mesh and step, and what is to be said of the data.
  virtual void describe(ParameterFit& fit) = 0;
  virtual long simulations() const = 0;
};

/// Of fits that are asked for. What is stated counts, with the colour that the data show: an
/// estimate far below what is stated comes from stretches in which nothing moves, and says little
/// of the rest.
inline constexpr NoiseRule fit_noise_rule{0.5, false};

/// A single plant. Throws InvalidFile where its data cannot be used.
std::unique_ptr<FitGround> plant_ground(const Experiment& experiment, int threads,
                                        const std::atomic<bool>* stop, const NoiseRule& rule = {});

/// Fits the free parameters of `starts` (the same model at several values) to the trials to be
/// fitted. Throws InvalidFile where the plant cannot be built.
ParameterFit fit_parameters(FitGround& ground, const std::vector<Hypothesis>& starts,
                            const ParameterFitOptions& options);

/// The same of a single plant, with the noise, the check of step and mesh and the freedom of the
/// mesh of a diagnosis. Throws InvalidFile where the data cannot be used, too.
ParameterFit fit_parameters(const Experiment& experiment, const std::vector<Hypothesis>& starts,
                            const ParameterFitOptions& options);

/// fit.json.
std::string to_json(const ParameterFit& fit);
/// A table for people.
std::string to_table(const ParameterFit& fit);

}  // namespace pedicel::discrepancy
