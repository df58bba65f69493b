#include "pedicel/discrepancy/scene_fit/scene_fit.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>

#include "pedicel/discrepancy/fit/bounded_solve.h"

namespace pedicel::discrepancy {

namespace {

long rows_of(const SceneDataSet& data, std::span<const int> trials) {
  long rows = 0;
  for (const int t : trials) rows += data.size(t);
  return rows;
}

/// Residuals and their derivatives as Ceres asks for them.
class SceneCost : public ceres::CostFunction {
 public:
  SceneCost(SceneEvaluator& evaluator, const Hypothesis& start, std::span<const int> trials)
      : evaluator_(evaluator),
        model_(start),
        trials_(trials),
        rows_(rows_of(evaluator.data(), trials)),
        step_(Eigen::VectorXd::Constant(start.size(), evaluator.settings().fit.first_step)) {
    // A row a number for what is known beforehand; it stays zero where nothing is.
    set_num_residuals(static_cast<int>(rows_) + start.size());
    mutable_parameter_block_sizes()->push_back(start.size());
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const int n = model_.size();
    const Eigen::VectorXd u = Eigen::Map<const Eigen::VectorXd>(parameters[0], n);
    // A model without free numbers has one point only.
    // Ceres asks for residuals and then for derivatives at the same place. A simulation is dear.
    if (residual_.size() != rows_ || u != last_) {
      last_ = u;
      residual_ = column(u);
      has_jacobian_ = false;
    }
    Eigen::Map<Eigen::VectorXd> out(residuals, rows_ + n);
    out.head(rows_) = residual_;
    for (int p = 0; p < n; ++p) out[rows_ + p] = prior(p, u[p]);
    if (!jacobians || !jacobians[0]) return true;
    if (!has_jacobian_) differentiate(u);
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> j(
        jacobians[0], rows_ + n, n);
    j.topRows(rows_) = -jacobian_;
    j.bottomRows(n).setZero();
    for (int p = 0; p < n; ++p)
      if (model_.free[p].prior > 0.0) j(rows_ + p, p) = 1.0 / model_.free[p].prior;
    return true;
  }

  const Eigen::VectorXd& residual() const { return residual_; }
  const Eigen::MatrixXd& jacobian() const { return jacobian_; }
  int evaluations() const { return evaluations_; }

 private:
  double prior(int p, double u) const {
    const effects::FreeParameter& free = model_.free[p];
    return free.prior > 0.0 ? (u - free.to_unknown(free.prior_centre)) / free.prior : 0.0;
  }

  Hypothesis at(const Eigen::VectorXd& u) const {
    Hypothesis model = model_;
    model.set_unknowns(u);
    return model;
  }

  Eigen::VectorXd column(const Eigen::VectorXd& u) const {
    ++evaluations_;
    const Hypothesis model = at(u);
    return evaluator_.residuals({&model, 1}, trials_).col(0);
  }

  // One-sided differences, inwards of the bounds, as large as they have to be: far above what the
  // solver's tolerance and contacts that begin a step earlier or later make, and small beside how
  // models bend.
  void differentiate(const Eigen::VectorXd& u) const {
    const int n = model_.size();
    const Eigen::VectorXd high = model_.high();
    std::vector<Hypothesis> models;
    Eigen::VectorXd used(n);
    for (int p = 0; p < n; ++p) {
      // Inwards, as a model beyond a bound may not be simulated.
      used[p] = u[p] + step_[p] <= high[p] ? step_[p] : -step_[p];
      Eigen::VectorXd moved = u;
      moved[p] += used[p];
      models.push_back(at(moved));
    }
    evaluations_ += n;
    const SceneFitSettings& how = evaluator_.settings().fit;
    const Eigen::MatrixXd there = evaluator_.residuals(models, trials_);
    jacobian_.resize(rows_, n);
    for (int p = 0; p < n; ++p) {
      const Eigen::VectorXd change = residual_ - there.col(p);
      jacobian_.col(p) = change / used[p];
      // A number that shows nothing would get a step without end.
      const double size = std::max(change.norm(), 1.0e-3);
      step_[p] = std::clamp(step_[p] * std::clamp(how.wanted_change / size, 0.1, 10.0),
                            how.least_step, how.most_step);
    }
    has_jacobian_ = true;
  }

  SceneEvaluator& evaluator_;
  Hypothesis model_;
  std::span<const int> trials_;
  long rows_;
  mutable Eigen::VectorXd step_, last_, residual_;
  mutable Eigen::MatrixXd jacobian_;
  mutable bool has_jacobian_ = false;
  mutable int evaluations_ = 0;
};

// Of the unknowns, were the noise white and all there is.
Eigen::MatrixXd covariance_of(const SceneFitResult& result) {
  const long n = result.jacobian.cols();
  Eigen::MatrixXd normal = result.jacobian.transpose() * result.jacobian;
  for (long p = 0; p < n; ++p) {
    const double prior = result.model.free[static_cast<std::size_t>(p)].prior;
    if (prior > 0.0) normal(p, p) += 1.0 / (prior * prior);
  }
  return normal.ldlt().solve(Eigen::MatrixXd::Identity(n, n));
}

void set_errors(SceneFitResult& result) {
  const long n = result.jacobian.cols();
  result.standard_error.setConstant(n, std::numeric_limits<double>::infinity());
  if (n == 0) return;
  const Eigen::MatrixXd inverse = covariance_of(result);
  // What a model leaves counts as noise of its numbers. Less than noise is chance.
  const double spread = std::max(1.0, result.sum.rms());
  for (long p = 0; p < n; ++p)
    if (inverse(p, p) > 0.0) result.standard_error[p] = spread * std::sqrt(inverse(p, p));
}

SceneFitResult result_at(SceneEvaluator& evaluator, const Hypothesis& model, const SceneCost& cost,
                         const Eigen::VectorXd& u, std::span<const int> trials) {
  std::vector<double> residuals(static_cast<std::size_t>(cost.num_residuals()));
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> jacobian(
      cost.num_residuals(), u.size());
  const double* parameters = u.data();
  double* rows = jacobian.data();
  cost.Evaluate(&parameters, residuals.data(), u.size() > 0 ? &rows : nullptr);
  SceneFitResult result;
  result.model = model;
  result.model.set_unknowns(u);
  result.residual = cost.residual();
  result.jacobian = cost.jacobian();
  result.sum = evaluator.sum(result.residual, trials);
  result.evaluations = cost.evaluations();
  set_errors(result);
  return result;
}

}  // namespace

Eigen::MatrixXd SceneEvaluator::residuals(std::span<const Hypothesis> models,
                                          std::span<const int> trials) {
  std::vector<SceneVariant> variants;
  for (const Hypothesis& model : models) variants.push_back({model.effects});
  std::vector<SceneSimulator::Request> requests;
  for (const SceneVariant& variant : variants)
    for (const int t : trials) requests.push_back({&variant, t});
  const std::vector<SceneReadings> readings = simulator_.run(requests);
  Eigen::MatrixXd out(rows_of(data_, trials), static_cast<long>(models.size()));
  std::size_t next = 0;
  for (long m = 0; m < out.cols(); ++m) {
    long row = 0;
    for (const int t : trials) {
      const long size = data_.size(t);
      // In the order of the requests: models first, trials within.
      data_.residual(t, readings[next++], std::numeric_limits<double>::infinity(),
                     out.col(m).segment(row, size));
      row += size;
    }
  }
  return out;
}

SceneDataSet::Sum SceneEvaluator::sum(const Eigen::VectorXd& residual,
                                      std::span<const int> trials) const {
  SceneDataSet::Sum sum{residual.squaredNorm(), 0};
  for (const int t : trials) sum.count += data_.samples(t, std::numeric_limits<double>::infinity());
  return sum;
}

SceneFitResult look_at(SceneEvaluator& evaluator, const Hypothesis& model,
                       std::span<const int> trials) {
  const SceneCost cost(evaluator, model, trials);
  return result_at(evaluator, model, cost, model.unknowns(), trials);
}

void widen_errors(SceneFitResult& fit, const Eigen::MatrixXd& off) {
  if (fit.jacobian.cols() == 0 || off.cols() == 0) return;
  const Eigen::MatrixXd moved = covariance_of(fit) * (fit.jacobian.transpose() * off);
  for (long p = 0; p < moved.rows(); ++p)
    fit.standard_error[p] = std::hypot(fit.standard_error[p], moved.row(p).norm());
}

SceneFitResult fit_scene(SceneEvaluator& evaluator, const Hypothesis& start,
                         const SceneFitOptions& options) {
  const SceneCost cost(evaluator, start, options.trials);
  Eigen::VectorXd u = start.unknowns();
  bool converged = true;
  if (start.size() > 0) {
    ceres::Solver::Options settings;
    settings.linear_solver_type = ceres::DENSE_QR;
    settings.max_num_iterations = options.iterations;
    // In unit steps of the numbers, of which a thousand are no limit.
    settings.initial_trust_region_radius = 1.0e3;
    settings.max_trust_region_radius = 1.0e6;
    settings.logging_type = ceres::SILENT;
    // What ends a fit is what a step gains. These two only catch what stands still.
    settings.parameter_tolerance = 1.0e-6;
    settings.gradient_tolerance = 1.0e-12;
    // Relative to the cost, half the sum of squares.
    settings.function_tolerance =
        2.0 * evaluator.settings().fit.least_gain /
        std::max(1.0, static_cast<double>(rows_of(evaluator.data(), options.trials)));
    const BoundedSolution solution = solve_bounded(cost, start.low(), start.high(), settings, u);
    converged = solution.converged;
  }
  SceneFitResult result = result_at(evaluator, start, cost, u, options.trials);
  result.converged = converged;
  return result;
}

namespace {

effects::Start factor_start(const effects::EffectDefinition& factor,
                            const SceneFitSettings& known) {
  effects::Start start(factor.name);
  if (factor.material->role == plant::MaterialRole::damping)
    return start.positive("factor", 1.0, 0.02, 50.0).prior(known.damping_prior, 1.0);
  start.positive("factor", 1.0, 0.1, 10.0);
  // The wide prior of density: what swings freely shows modulus over density alone.
  if (factor.material->role == plant::MaterialRole::mass) start.prior(known.density_prior, 1.0);
  return start;
}

}  // namespace

Hypothesis scene_baseline(const SceneExperiment& experiment, const SceneSettings& settings) {
  const SceneFitSettings& known = settings.fit;
  Hypothesis baseline;
  for (const effects::EffectDefinition* one : effects::material_factors())
    baseline.add(factor_start(*one, known));
  for (const SceneFit& own : baseline_effects({experiment, settings})) {
    Hypothesis added;
    added.effects = {own.effect};
    added.free = own.free;
    baseline.add(added);
  }
  return baseline;
}

}  // namespace pedicel::discrepancy
