#pragma once

#include <array>
#include <atomic>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "plugins/discrepancy/settings/diagnosis_settings.h"
#include "plugins/discrepancy/simulate/data_set.h"
#include "plugins/discrepancy/simulate/hypothesis.h"

namespace pedicel::discrepancy {

struct FitOptions {
  std::vector<int> trials;
  double horizon = 1.0;                  ///< share of each trial's duration that counts
  int iterations = Budget{}.iterations;  ///< at most
  /// It stops when a step gains less (nats; where the model leaves more than noise, in units of
  /// what it leaves).
  double least_step = Budget{}.least_step;
  const DiagnosisSettings* settings = &default_settings();  ///< must outlive it
};

/// What a fit found. Starts as "not run".
struct FitSummary {
  Hypothesis hypothesis;     ///< with the values found
  double cost = 0.0;         ///< 1/2 sum of squared whitened residuals (priors not counted)
  Eigen::VectorXd residual;  ///< whitened, see DataSet
  Eigen::MatrixXd jacobian;  ///< of the whitened prediction by the unknowns: residual = data - it
  Eigen::VectorXd standard_error;  ///< of the unknowns, infinite where the data leave one open
  double condition = 0.0;          ///< of the scaled Jacobian
  std::vector<int> at_bound;       ///< parameters that stand at one of their bounds
  double spread = 1.0;             ///< by which data weighed less against what is known beforehand
  bool converged = false;
  std::string why = "not run";  ///< why it stopped
};

/// What is known beforehand of a model's unknowns, as more rows of its least squares: residuals
/// `left`, whose derivatives by the unknowns are -`weight` (0 where nothing is known).
struct PriorRows {
  Eigen::VectorXd weight, left;
};
PriorRows prior_rows(const FitSummary& model);

/// Logarithms of factors on the numbers of the material: modulus, density and damping time.
struct Shift {
  static constexpr int count = plant::count_roles();
  using Names = std::array<std::string, count>;
  static const Names& names();  ///< of the factors' effects
  std::array<double, count> logarithm{};
  void add(double share, const Shift& other);
  /// Multiplies the factors of a variant, which are 1 where it has none.
  void apply(Variant& variant) const;
};

/// A change of all predictions by our own numbers. What changed parameters can stand for is a shift
/// of these, because a swing that drifts out of phase is no sum of small changes; the rest, one
/// entry a trial, is added.
struct Correction {
  Shift shift;
  std::vector<Prediction> rest;
};

/// How predictions are mended (numerics.h): `own`, what a prediction without error would have more,
/// and what a mesh of the plant file's spacing would have more than that, by the power of the
/// spacing: `first` at the junctions, half a segment of the parent; `second` everywhere. A
/// hypothesis chooses its share s of the spacing: s first + s^2 second.
struct Corrections {
  Correction own, first, second;
  bool empty() const { return own.rest.empty(); }
  Shift shift(double share) const;
  void add_rest(double share, int trial, Prediction& prediction) const;
};

/// Simulates a list of hypotheses over the same trials at once.
class Evaluator {
 public:
  Evaluator(Simulator& simulator, const DataSet& data, const Corrections* corrections = nullptr)
      : simulator_(&simulator), data_(&data), corrections_(corrections) {}

  /// Whitened residuals, one column a hypothesis.
  Eigen::MatrixXd residuals(std::span<const Hypothesis> hypotheses, const FitOptions& options);
  /// Predictions with their corrections: [hypothesis][trial of options.trials].
  std::vector<std::vector<Prediction>> predictions(std::span<const Hypothesis> hypotheses,
                                                   const FitOptions& options);
  const DataSet& data() const { return *data_; }
  Simulator& simulator() { return *simulator_; }

 private:
  Simulator* simulator_;
  const DataSet* data_;
  const Corrections* corrections_;
};

/// Bounded least squares (Ceres, Levenberg-Marquardt) on whitened residuals, with the derivatives
/// by differences: a point and all its derivatives are simulated side by side.
/// `known` are derivatives by the first unknowns at a model near by, where there is one: they tell
/// how large the differences should be.
FitSummary fit(Evaluator& evaluator, const Hypothesis& start, const FitOptions& options,
               const Eigen::MatrixXd& known = {});

/// Continues where another fit of the same hypothesis ended.
FitSummary refit(Evaluator& evaluator, const FitSummary& found, const FitOptions& options);

/// Fits over growing shares of the records, so that oscillations do not slip by a period.
FitSummary fit_growing(Evaluator& evaluator, const Hypothesis& start, FitOptions options,
                       std::span<const double> horizons);

/// The hypothesis with the least cost, and its cost.
struct Scan {
  int best = 0;
  std::vector<double> cost;
};
Scan scan(Evaluator& evaluator, std::span<const Hypothesis> starts, const FitOptions& options);

/// The step of a model's unknowns that takes most of a change of the prediction, as far as that
/// goes with what is known of them beforehand.
Eigen::VectorXd believable_step(const FitSummary& model, const Eigen::VectorXd& change);

/// Least-squares step of the unknowns that a change of the residual would make (pseudo-inverse of
/// the Jacobian), and what is left of a residual after the parameters have taken their share.
Eigen::VectorXd least_squares_step(const Eigen::MatrixXd& jacobian,
                                   const Eigen::VectorXd& residual);
Eigen::VectorXd projected_out(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residual);

}  // namespace pedicel::discrepancy
