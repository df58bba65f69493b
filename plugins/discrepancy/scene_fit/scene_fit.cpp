#include "plugins/discrepancy/scene_fit/scene_fit.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>

#include "plugins/discrepancy/fit/bounded_solve.h"

namespace pedicel::discrepancy {

namespace {

// Entries, measured or not, so that a residual has one layout for all models. What was not measured
// is zero in all of them.
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
        // A first guess. It is put right by what the first difference shows.
        step_(Eigen::VectorXd::Constant(start.size(), evaluator.settings().fit.first_step)),
        least_(Eigen::VectorXd::Constant(start.size(), evaluator.settings().fit.least_step)) {
    // Moved by a micrometre, an unseen plant sticks to the tool elsewhere, which changes as much as
    // a millimetre does: derivatives over less would be of that, and errors a tenth of what they
    // are.
    for (int p = 0; p < start.size(); ++p) {
      const effects::FreeParameter& free = start.free[static_cast<std::size_t>(p)];
      if (told_of_baseline(start.effects[static_cast<std::size_t>(free.effect)], free))
        least_[p] = evaluator.settings().fit.least_place_step;
    }
    step_ = step_.cwiseMax(least_);
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
    // What is known beforehand stands below, as a measurement of the number itself. By its own
    // deviation, whatever the model leaves.
    out.head(rows_) = residual_;
    for (int p = 0; p < n; ++p) out[rows_ + p] = prior(p, u[p]);
    if (!jacobians || !jacobians[0]) return true;
    // Only where they are asked for: derivatives are n simulations of a scene, and a step that is
    // refused needs none.
    if (!has_jacobian_) differentiate(u);
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> j(
        jacobians[0], rows_ + n, n);
    // The residual is measured less predicted, and the differences are of the prediction.
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
    // A deviation of 0 stands for nothing known, and not for all.
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
    // Side by side, so that they share the solver's lanes and all threads.
    evaluations_ += n;
    const SceneFitSettings& how = evaluator_.settings().fit;
    const Eigen::MatrixXd there = evaluator_.residuals(models, trials_);
    jacobian_.resize(rows_, n);
    for (int p = 0; p < n; ++p) {
      const Eigen::VectorXd change = residual_ - there.col(p);
      jacobian_.col(p) = change / used[p];
      // A number that shows nothing would get a step without end. The change by this step tells the
      // next one, which is therefore never simulated for its own sake. Ten times at most: beyond a
      // contact that begins nothing can be told from before it.
      const double size = std::max(change.norm(), 1.0e-3);
      step_[p] = std::clamp(step_[p] * std::clamp(how.wanted_change / size, 0.1, 10.0), least_[p],
                            std::max(least_[p], how.most_step));
    }
    has_jacobian_ = true;
  }

  SceneEvaluator& evaluator_;
  Hypothesis model_;
  std::span<const int> trials_;
  long rows_;
  mutable Eigen::VectorXd step_;
  Eigen::VectorXd least_;
  mutable Eigen::VectorXd last_, residual_;
  mutable Eigen::MatrixXd jacobian_;
  mutable bool has_jacobian_ = false;
  mutable int evaluations_ = 0;
};

// Of the unknowns, were the noise white and all there is.
Eigen::MatrixXd covariance_of(const SceneFitResult& result) {
  const long n = result.jacobian.cols();
  Eigen::MatrixXd normal = result.jacobian.transpose() * result.jacobian;
  for (long p = 0; p < n; ++p) {
    // A prior narrows an error as it held the fit.
    const double prior = result.model.free[static_cast<std::size_t>(p)].prior;
    if (prior > 0.0) normal(p, p) += 1.0 / (prior * prior);
  }
  // A number that nothing shows has a pivot of zero here, and comes out with a variance of zero.
  // Whoever reads it must not take that for certainty.
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
    // So such a number keeps the error without end that it began with.
    if (inverse(p, p) > 0.0) result.standard_error[p] = spread * std::sqrt(inverse(p, p));
}

SceneFitResult result_at(SceneEvaluator& evaluator, const Hypothesis& model, const SceneCost& cost,
                         const Eigen::VectorXd& u, std::span<const int> trials) {
  std::vector<double> residuals(static_cast<std::size_t>(cost.num_residuals()));
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> jacobian(
      cost.num_residuals(), u.size());
  const double* parameters = u.data();
  double* rows = jacobian.data();
  // By the cost itself, which has the last point already. Derivatives are made where the fit had
  // not asked for them there.
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
  // All models and trials in one call, so that they fill the solver's lanes and all threads.
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
  // Over what was measured: the zeros of the rest would make any model look better.
  SceneDataSet::Sum sum{residual.squaredNorm(), 0};
  // The count is the same for all models, so that sums of two compare.
  for (const int t : trials) sum.count += data_.samples(t, std::numeric_limits<double>::infinity());
  return sum;
}

SceneFitResult look_at(SceneEvaluator& evaluator, const Hypothesis& model,
                       std::span<const int> trials) {
  // With derivatives, though nothing is fitted: a screen lays causes on top of the base's own
  // numbers.
  const SceneCost cost(evaluator, model, trials);
  return result_at(evaluator, model, cost, model.unknowns(), trials);
}

void widen_errors(SceneFitResult& fit, const Eigen::MatrixXd& off) {
  // Without numbers, or with nothing that is off, errors are what they were.
  if (fit.jacobian.cols() == 0 || off.cols() == 0) return;
  // A prediction that is off by d moves the minimum by (J^T J + P)^-1 J^T d, to first order.
  // Samples that are off together do not average out, as noise does: white noise alone gave a
  // tool's offset an error a tenth of what it was off by.
  const Eigen::MatrixXd moved = covariance_of(fit) * (fit.jacobian.transpose() * off);
  for (long p = 0; p < moved.rows(); ++p)
    // Reasons have nothing to do with each other, so their squares add up.
    fit.standard_error[p] = std::hypot(fit.standard_error[p], moved.row(p).norm());
}

void raise_errors(SceneFitResult& fit, std::span<const int> stretch) {
  const long n = fit.jacobian.cols();
  if (n == 0 || stretch.empty()) return;
  // What each stretch alone would pull the numbers by. At the minimum they hold each other.
  Eigen::MatrixXd pull = Eigen::MatrixXd::Zero(n, *std::ranges::max_element(stretch) + 1);
  for (std::size_t i = 0; i < stretch.size(); ++i)
    pull.col(stretch[i]) +=
        fit.jacobian.row(static_cast<long>(i)).transpose() * fit.residual[static_cast<long>(i)];
  const auto count = static_cast<double>((pull.colwise().squaredNorm().array() > 0.0).count());
  if (count <= static_cast<double>(n)) return;
  // The fit took a part of it away, as of a variance about a mean.
  const double taken = std::sqrt(count / (count - static_cast<double>(n)));
  const Eigen::MatrixXd moved = taken * covariance_of(fit) * pull;
  for (long p = 0; p < n; ++p)
    fit.standard_error[p] = std::max(fit.standard_error[p], moved.row(p).norm());
}

Between between(const SceneFitResult& one, const SceneFitResult& other) {
  const Eigen::VectorXd way = other.residual - one.residual;
  const double length = way.norm();
  if (length == 0.0) return {0.5, std::numeric_limits<double>::infinity()};
  // Residuals are measured less predicted, so what is left of the first goes down on the way to
  // where the data are. What it leaves beyond the noise counts as noise here, too.
  return {-one.residual.dot(way) / (length * length), std::max(1.0, one.sum.rms()) / length};
}

SceneFitResult fit_scene(SceneEvaluator& evaluator, const Hypothesis& start,
                         const SceneFitOptions& options) {
  const SceneCost cost(evaluator, start, options.trials);
  Eigen::VectorXd u = start.unknowns();
  bool converged = true;
  if (start.size() > 0) {
    ceres::Solver::Options settings;
    // By orthogonal columns: modulus, density and a place do nearly the same to a push, and normal
    // equations would square that.
    settings.linear_solver_type = ceres::DENSE_QR;
    // A few. Whoever searches looks at what is left, and goes on with what came near.
    settings.max_num_iterations = options.iterations;
    // In unit steps of the numbers, of which a thousand are no limit.
    settings.initial_trust_region_radius = 1.0e3;
    settings.max_trust_region_radius = 1.0e6;
    settings.logging_type = ceres::SILENT;
    // What ends a fit is what a step gains. These two only catch what stands still.
    settings.parameter_tolerance = 1.0e-6;
    settings.gradient_tolerance = 1.0e-12;
    // Relative to the cost, half the sum of squares. By entries and not by samples: those that were
    // not measured only make it stricter.
    settings.function_tolerance =
        2.0 * evaluator.settings().fit.least_gain /
        std::max(1.0, static_cast<double>(rows_of(evaluator.data(), options.trials)));
    // As fits of plants do: beside a bound Ceres alone stays in a curved valley.
    const BoundedSolution solution = solve_bounded(cost, start.low(), start.high(), settings, u);
    converged = solution.converged;
  }
  // With the differences that the fit has learnt, since it is the same cost.
  SceneFitResult result = result_at(evaluator, start, cost, u, options.trials);
  result.converged = converged;
  return result;
}

namespace {

effects::Start factor_start(const effects::EffectDefinition& factor,
                            const SceneFitSettings& known) {
  effects::Start start(factor.name);
  // A wide prior, for trials in which nothing swings.
  if (factor.material->role == plant::MaterialRole::damping)
    return start.positive("factor", 1.0, 0.02, 50.0).prior(known.damping_prior, 1.0);
  // The modulus has none: a stem's is known to a factor, and pushes show it well.
  start.positive("factor", 1.0, 0.1, 10.0);
  // Density has one: what swings freely shows modulus over density alone.
  if (factor.material->role == plant::MaterialRole::mass) start.prior(known.density_prior, 1.0);
  return start;
}

}  // namespace

Hypothesis scene_baseline(const Experiment& experiment, const SceneSettings& settings) {
  const SceneFitSettings& known = settings.fit;
  Hypothesis baseline;
  for (const effects::EffectDefinition* one : effects::material_factors())
    baseline.add(factor_start(*one, known));
  // What it has besides, such as the place of a plant that nothing shows but the arm that touches
  // it.
  for (const SceneFit& own : baseline_effects({experiment, settings})) {
    Hypothesis added;
    added.effects = {own.effect};
    added.free = own.free;
    baseline.add(added);
  }
  return baseline;
}

}  // namespace pedicel::discrepancy
