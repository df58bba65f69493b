#pragma once

#include <array>
#include <atomic>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "plugins/discrepancy/settings/diagnosis_settings.h"
#include "plugins/discrepancy/simulate/data_set.h"
#include "plugins/discrepancy/simulate/differences.h"
#include "plugins/discrepancy/simulate/hypothesis.h"
#include "plugins/discrepancy/simulate/misfit.h"

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
  int samples = 0;           ///< entries of it that were measured
  Eigen::MatrixXd jacobian;  ///< of the whitened prediction by the unknowns: residual = data - it
  Eigen::VectorXd standard_error;  ///< of the unknowns, infinite where the data leave one open
  double condition = 0.0;          ///< of the scaled Jacobian
  std::vector<int> at_bound;       ///< parameters that stand at one of their bounds
  double spread = 1.0;             ///< by which data weighed less against what is known beforehand
  bool converged = false;
  std::string why = "not run";  ///< why it stopped

  Misfit misfit() const { return {residual.squaredNorm(), samples}; }
};

/// Of the unknowns of a fit, were the noise white and all there is: (J^T J + priors)^-1, with the
/// unknowns brought to one scale first. Those that move nothing have no rows in it.
struct Covariance {
  Eigen::MatrixXd matrix;  ///< zero in the rows and columns of what is open
  std::vector<int> open;   ///< unknowns that neither data nor priors show
  double condition = 1.0;  ///< of the scaled Jacobian; infinite where one is open
};
Covariance covariance_of(const FitSummary& fit);

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

/// How least squares go where the models of a kind of experiment need it.
struct FitStyle {
  DifferenceRule differences{};
  /// Derivatives are simulated with each point. False: where they are asked for, as each of them is
  /// a simulation of its own.
  bool derivatives_at_once = true;
  /// Where a model misses the data by many times the noise, the data weigh less against what is
  /// known beforehand.
  bool weighs_priors = true;
  bool goes_up = true;      ///< steps may be tried that go up at first (non-monotonic)
  bool by_columns = false;  ///< by orthogonal columns, and not by normal equations
};

/// Residuals of models over the same trials, side by side: all that a fit asks for.
class ResidualSource {
 public:
  virtual ~ResidualSource() = default;
  /// Whitened, one column a hypothesis.
  virtual Eigen::MatrixXd residuals(std::span<const Hypothesis> hypotheses,
                                    const FitOptions& options) = 0;
  /// Entries of a residual over these trials, measured or not.
  virtual int size(std::span<const int> trials) const = 0;
  /// Entries that hold a sample up to the share `horizon` of each trial's duration.
  virtual int samples(std::span<const int> trials, double horizon) const = 0;
  virtual FitStyle style(const Hypothesis&) const { return {}; }
};

/// Simulates a list of hypotheses over the same trials at once.
class Evaluator : public ResidualSource {
 public:
  Evaluator(Simulator& simulator, const DataSet& data, const Corrections* corrections = nullptr)
      : simulator_(&simulator), data_(&data), corrections_(corrections) {}

  Eigen::MatrixXd residuals(std::span<const Hypothesis> hypotheses,
                            const FitOptions& options) override;
  int size(std::span<const int> trials) const override { return data_->size(trials); }
  int samples(std::span<const int> trials, double horizon) const override {
    return data_->samples(trials, horizon);
  }
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
FitSummary fit(ResidualSource& evaluator, const Hypothesis& start, const FitOptions& options,
               const Eigen::MatrixXd& known = {});

/// What a model predicts and how that changes with its unknowns, without a fit.
FitSummary look_at(ResidualSource& evaluator, const Hypothesis& model, const FitOptions& options);

/// Continues where another fit of the same hypothesis ended.
FitSummary refit(ResidualSource& evaluator, const FitSummary& found, const FitOptions& options);

/// Fits over growing shares of the records, so that oscillations do not slip by a period.
FitSummary fit_growing(ResidualSource& evaluator, const Hypothesis& start, FitOptions options,
                       std::span<const double> horizons);

/// The hypothesis with the least cost, and its cost.
struct Scan {
  int best = 0;
  std::vector<double> cost;
};
Scan scan(ResidualSource& evaluator, std::span<const Hypothesis> starts, const FitOptions& options);

/// The step of a model's unknowns that takes most of a change of the prediction, as far as that
/// goes with what is known of them beforehand.
Eigen::VectorXd believable_step(const FitSummary& model, const Eigen::VectorXd& change);

/// Least-squares step of the unknowns that a change of the residual would make (pseudo-inverse of
/// the Jacobian), and what is left of a residual after the parameters have taken their share.
Eigen::VectorXd least_squares_step(const Eigen::MatrixXd& jacobian,
                                   const Eigen::VectorXd& residual);
Eigen::VectorXd projected_out(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residual);

}  // namespace pedicel::discrepancy
