#include "plugins/discrepancy/fit/fit.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/check.h"
#include "plugins/discrepancy/fit/bounded_solve.h"
#include "plugins/discrepancy/simulate/differences.h"

namespace pedicel::discrepancy {

namespace {

constexpr double open_direction = 1.0e-3;  // noise units an unknown: nothing to be seen

/// Residuals and their derivatives at a point. Two points are kept: the last one, because Ceres
/// asks for the derivatives at a point whose residuals it has seen, and the best one, where a fit
/// ends that has tried in vain to go on.
class Problem : public ceres::CostFunction {
 public:
  Problem(ResidualSource& evaluator, const Hypothesis& start, const FitOptions& options,
          const FitStyle& style, const Differences& differences)
      : evaluator_(evaluator),
        hypothesis_(start),
        options_(options),
        style_(style),
        start_(start.unknowns()),
        differences_(differences),
        spread_(style.weighs_priors ? 0.0 : 1.0),
        samples_(evaluator.size(options.trials)) {
    // A row more for every unknown, whether something is known of it or not. Rows of zeros change
    // nothing, and all models are laid out alike.
    set_num_residuals(samples_ + start.size());
    mutable_parameter_block_sizes()->push_back(start.size());
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const Eigen::Map<const Eigen::VectorXd> u(parameters[0], start_.size());
    compute(u, jacobians && jacobians[0]);
    Eigen::Map<Eigen::VectorXd> r(residuals, num_residuals());
    r.head(samples_) = now_.residual;
    // What is known beforehand stands among the residuals, as a measurement of the unknown itself.
    // A bound in its place would be knowledge without any doubt, and the data could not overrule
    // it.
    for (int p = 0; p < start_.size(); ++p) r[samples_ + p] = prior(p) * (u[p] - centre(p));
    // Ceres asks for the residuals of a step first, and for derivatives only where it takes the
    // step.
    if (!jacobians || !jacobians[0]) return true;
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> j(
        jacobians[0], num_residuals(), start_.size());
    j.setZero();
    // Differences are of the prediction, and a residual is data less prediction.
    j.topRows(samples_) = -now_.jacobian;
    for (int p = 0; p < start_.size(); ++p) j(samples_ + p, p) = prior(p);
    return true;
  }

  /// `with_derivatives`: they are wanted, too.
  void compute(const Eigen::VectorXd& u, bool with_derivatives = true) const {
    if (!now_.is_at(u)) move_to(u);
    if (with_derivatives && !now_.has_jacobian()) differentiate();
  }

  void move_to(const Eigen::VectorXd& u) const {
    // No copy but an exchange: the point that was the last one may still be the better of the two.
    if (best_.is_at(u)) {
      std::swap(now_, best_);
      return;
    }
    // Only the point that is left behind competes here, so the best one is never lost to the next.
    // What is known beforehand counts, too: nearer to the data and farther from that is not better.
    if (best_.u.size() == 0 || objective(now_) < objective(best_)) std::swap(now_, best_);
    if (style_.derivatives_at_once) {
      // Equal plants share the solver's lanes, so one alone would leave them empty, and a step that
      // is taken would be simulated twice.
      const Eigen::MatrixXd r = evaluator_.residuals(differences_.points(u), options_);
      now_ = {u, r.col(0), differences_.jacobian(r)};
    } else {
      Hypothesis model = hypothesis_;
      model.set_unknowns(u);
      now_ = {u, evaluator_.residuals({&model, 1}, options_).col(0), {}};
    }
    // Where the model misses the data by many times the noise, the data weigh less against what is
    // known beforehand. Set once, so that the cost stays one function. Without it a model that
    // misses by 50 noise units would drag a density that was weighed to wherever a misfit that is
    // no noise gets smaller.
    if (spread_ == 0.0) {
      const int seen = evaluator_.samples(options_.trials, options_.horizon);
      spread_ = std::sqrt(std::max(1.0, now_.residual.squaredNorm() / std::max(1, seen)));
    }
  }

  /// Finds out how large differences should be: a first guess of one in a hundred turns a long
  /// swing by a radian, or moves nothing, and a step from a wrong derivative is refused.
  void find_differences(const Eigen::VectorXd& u) const {
    // The first simulations are kept where the guess did. Else the point is forgotten, and the next
    // call simulates it with differences of the size that was just learnt.
    compute(u);
    if (!differences_.suited()) now_ = {};
  }

  int seen() const { return evaluator_.samples(options_.trials, options_.horizon); }
  const Eigen::VectorXd& residual() const { return now_.residual; }
  const Eigen::MatrixXd& jacobian() const { return now_.jacobian; }
  double spread() const { return spread_; }

 private:
  struct Point {
    Eigen::VectorXd u, residual;
    Eigen::MatrixXd jacobian;
    bool is_at(const Eigen::VectorXd& there) const {
      return residual.size() > 0 && u.size() == there.size() && u == there;
    }
    bool has_jacobian() const { return jacobian.rows() == residual.size(); }
  };

  // At the point itself, which was simulated without them.
  void differentiate() const {
    std::vector<Hypothesis> points = differences_.points(now_.u);
    Eigen::MatrixXd r(samples_, static_cast<Eigen::Index>(points.size()));
    r.col(0) = now_.residual;
    if (points.size() > 1)
      r.rightCols(r.cols() - 1) = evaluator_.residuals(std::span(points).subspan(1), options_);
    now_.jacobian = differences_.jacobian(r);
  }

  // What a fit minimises.
  double objective(const Point& point) const {
    // A place that holds no point yet loses against any.
    if (point.u.size() == 0) return std::numeric_limits<double>::infinity();
    double sum = point.residual.squaredNorm();
    for (int p = 0; p < start_.size(); ++p) sum += std::pow(prior(p) * (point.u[p] - centre(p)), 2);
    return sum;
  }

  double prior(int p) const {
    // A deviation of 0 says that nothing is known, not that all is.
    return hypothesis_.free[p].prior > 0.0 ? spread_ / hypothesis_.free[p].prior : 0.0;
  }

  double centre(int p) const {
    const FreeParameter& parameter = hypothesis_.free[p];
    return parameter.prior > 0.0 ? parameter.to_unknown(parameter.prior_centre) : 0.0;
  }

  ResidualSource& evaluator_;
  Hypothesis hypothesis_;
  FitOptions options_;
  FitStyle style_;
  Eigen::VectorXd start_;
  mutable Differences differences_;
  mutable double spread_;
  int samples_;
  mutable Point now_, best_;
};

Eigen::VectorXd bounded(const Hypothesis& start) {
  // Starts also come from linear steps and from symptoms, which know no bounds. Ceres takes none
  // that lies outside.
  return start.unknowns().cwiseMax(start.low()).cwiseMin(start.high());
}

void add(Prediction& to, double share, const Prediction& change) {
  to.markers += share * change.markers;
  if (to.force.size() > 0) to.force += share * change.force;
  if (to.wrench.size() > 0) to.wrench += share * change.wrench;
}

// Errors and bounds of what was found, by the linear model there. A prior counts in units of the
// noise here, not of the spread by which the fit weighed it.
void judge(FitSummary& fit) {
  const int n = fit.hypothesis.size();
  const Eigen::VectorXd u = fit.hypothesis.unknowns();
  const Eigen::VectorXd lows = fit.hypothesis.low(), highs = fit.hypothesis.high();
  for (int p = 0; p < n; ++p) {
    // Unknowns come back by way of their values, through a logarithm and its inverse, so that a
    // bound is met to rounding alone.
    const double near = 1.0e-6 * (1.0 + highs[p] - lows[p]);
    if (u[p] - lows[p] < near || highs[p] - u[p] < near) fit.at_bound.push_back(p);
  }
  const Covariance covariance = covariance_of(fit);
  fit.condition = covariance.condition;
  fit.standard_error = covariance.matrix.diagonal().cwiseSqrt();
  for (const int p : covariance.open)
    fit.standard_error[p] = std::numeric_limits<double>::infinity();
}

}  // namespace

Covariance covariance_of(const FitSummary& fit) {
  const auto n = static_cast<int>(fit.jacobian.cols());
  Covariance result{Eigen::MatrixXd::Zero(n, n), {}, 1.0};
  Eigen::MatrixXd information = fit.jacobian.transpose() * fit.jacobian;
  std::vector<int> seen;
  for (int p = 0; p < n; ++p) {
    const double prior = fit.hypothesis.free[p].prior;
    if (prior > 0.0) information(p, p) += 1.0 / (prior * prior);
    // One unknown that moves nothing would make the whole matrix singular. The others do not care
    // for where it stands.
    (information(p, p) < open_direction * open_direction ? result.open : seen).push_back(p);
  }
  if (!seen.empty()) {
    const Eigen::MatrixXd shown = information(seen, seen);
    // To a diagonal of ones first. Unknowns are logarithms, lengths in their own scales, and
    // shares; the condition of the bare matrix would tell these units and nothing of the data.
    const Eigen::VectorXd scale = shown.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scale.asDiagonal() * shown *
                                                               scale.asDiagonal());
    // By rounding the smallest one may come out below zero, where it has no root and no inverse:
    // two numbers that trade with each other.
    const Eigen::VectorXd values = eigen.eigenvalues().cwiseMax(1.0e-14);
    // The root, because the information is the square of the Jacobian that the condition is told
    // of.
    result.condition = std::sqrt(values[values.size() - 1] / values[0]);
    result.matrix(seen, seen) = scale.asDiagonal() * eigen.eigenvectors() *
                                values.cwiseInverse().asDiagonal() *
                                eigen.eigenvectors().transpose() * scale.asDiagonal();
  }
  if (!result.open.empty()) result.condition = std::numeric_limits<double>::infinity();
  return result;
}

PriorRows prior_rows(const FitSummary& model) {
  const int n = model.hypothesis.size();
  const Eigen::VectorXd u = model.hypothesis.unknowns();
  PriorRows rows{Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)};
  for (int p = 0; p < n; ++p) {
    const FreeParameter& free = model.hypothesis.free[p];
    // These rows are those of the fit, spread and all: whoever steps from this model by them must
    // not undo what the fit decided.
    if (free.prior <= 0.0) continue;
    rows.weight[p] = model.spread / free.prior;
    rows.left[p] = rows.weight[p] * (free.to_unknown(free.prior_centre) - u[p]);
  }
  return rows;
}

const Shift::Names& Shift::names() {
  static const Names all = [] {
    Names names;
    const auto& factors = effects::material_factors();
    PEDICEL_ASSERT(factors.size() == names.size());
    for (std::size_t i = 0; i < names.size(); ++i) names[i] = factors[i]->name;
    return names;
  }();
  return all;
}

void Shift::add(double share, const Shift& other) {
  for (std::size_t i = 0; i < count; ++i) logarithm[i] += share * other.logarithm[i];
}

void Shift::apply(Variant& variant) const {
  for (std::size_t i = 0; i < count; ++i) {
    // A factor of 1 would change nothing but the variant itself, which the simulator knows motions
    // by.
    if (logarithm[i] == 0.0) continue;
    auto found = std::ranges::find(variant.effects, names()[i], &plant::Effect::name);
    // A shift acts on all of them, fitted or not: a mesh that is too stiff does not ask what is
    // free.
    if (found == variant.effects.end()) {
      variant.effects.push_back({names()[i], {}, {{"factor", {1.0}}}, {}, {}});
      found = variant.effects.end() - 1;
    }
    found->numbers["factor"][0] *= std::exp(logarithm[i]);
  }
}

Shift Corrections::shift(double share) const {
  Shift sum = own.shift;
  sum.add(share, first.shift);
  // By the powers of the spacing with which the two errors vanish: the first at junctions, the
  // second everywhere else.
  sum.add(share * share, second.shift);
  return sum;
}

void Corrections::add_rest(double share, int trial, Prediction& prediction) const {
  add(prediction, 1.0, own.rest[trial]);
  add(prediction, share, first.rest[trial]);
  add(prediction, share * share, second.rest[trial]);
}

std::vector<std::vector<Prediction>> Evaluator::predictions(std::span<const Hypothesis> hypotheses,
                                                            const FitOptions& options) {
  std::vector<Variant> variants;
  for (const Hypothesis& hypothesis : hypotheses) {
    variants.push_back(hypothesis.variant());
    // The shift goes into the model before it runs, the rest is added to what comes out. A swing
    // whose period is wrong by a little is out of phase at the end, and no small sum mends that.
    if (corrections_) corrections_->shift(hypothesis.mesh_share()).apply(variants.back());
  }
  std::vector<Simulator::Request> requests;
  for (const Variant& variant : variants)
    for (const int trial : options.trials)
      // A part of the records is simulated no longer than it counts: that is what makes searches
      // over first parts cheap.
      requests.push_back({&variant, trial, data_->end_of(trial, options.horizon)});
  std::vector<Prediction> all = simulator_->run(requests);
  std::vector<std::vector<Prediction>> result(hypotheses.size());
  std::size_t next = 0;
  for (std::size_t h = 0; h < hypotheses.size(); ++h)
    for (const int trial : options.trials) {
      Prediction& prediction = all[next++];
      if (corrections_) corrections_->add_rest(hypotheses[h].mesh_share(), trial, prediction);
      result[h].push_back(std::move(prediction));
    }
  return result;
}

Eigen::MatrixXd Evaluator::residuals(std::span<const Hypothesis> hypotheses,
                                     const FitOptions& options) {
  const auto predicted = predictions(hypotheses, options);
  Eigen::MatrixXd result(data_->size(options.trials), hypotheses.size());
  for (std::size_t h = 0; h < hypotheses.size(); ++h) {
    Eigen::Index row = 0;
    for (std::size_t t = 0; t < options.trials.size(); ++t) {
      const int size = data_->size(std::span(&options.trials[t], 1));
      data_->residual(options.trials[t], predicted[h][t], options.horizon,
                      result.col(h).segment(row, size));
      row += size;
    }
  }
  return result;
}

namespace {

FitSummary result_at(const Problem& problem, const Hypothesis& start, const Eigen::VectorXd& u) {
  // Where a fit ended is one of the two points that are kept, but for a bound that was set exactly.
  problem.compute(u);
  FitSummary result;
  result.hypothesis = start;
  result.hypothesis.set_unknowns(u);
  result.residual = problem.residual();
  result.samples = problem.seen();
  result.jacobian = problem.jacobian();
  result.spread = problem.spread();
  // Of the data alone. What is known beforehand is added by those who compare models, each in its
  // own way.
  result.cost = 0.5 * result.residual.squaredNorm();
  judge(result);
  return result;
}

FitSummary solve(const Problem& problem, const Hypothesis& start, const FitOptions& options,
                 const FitStyle& style) {
  bool converged = true;
  // Ceres has nothing to move where nothing is free. The model's residual is wanted all the same.
  std::string why = "nothing is free";
  Eigen::VectorXd u = bounded(start);
  if (start.size() > 0) {
    ceres::Solver::Options settings;
    // A few unknowns and thousands of samples: the normal equations are tiny. That their condition
    // is the square of the Jacobian's is mended by the damping of Levenberg-Marquardt, which bounds
    // it.
    settings.linear_solver_type = style.by_columns ? ceres::DENSE_QR : ceres::DENSE_NORMAL_CHOLESKY;
    settings.max_num_iterations = options.iterations;
    // Ceres compares a step's gain with the cost. Where noise alone is left the cost is half the
    // number of samples, so this share of it is `least_step` nats. A share that is the same for all
    // records would end long ones in the middle of a valley.
    settings.function_tolerance = 2.0 * options.least_step / std::max(1, problem.seen());
    // So small that fits end by what they gain, not by how far they step. In a valley where two
    // effects trade, short steps may still gain.
    settings.parameter_tolerance = 1.0e-6;
    // Where an effect does almost what modulus or density does, the valley to the minimum is narrow
    // and bent: a fit that may only go down creeps along it, or stops on its side. Measured on a
    // mass distribution: 9 steps in place of 18.
    settings.use_nonmonotonic_steps = style.goes_up;
    // With bounds Ceres searches along every step. One try is the whole step, which the trust
    // region looks at anyway; where that fails the region shrinks.
    settings.max_num_line_search_step_size_iterations = 1;
    settings.logging_type = ceres::SILENT;
    BoundedSolution found = solve_bounded(problem, start.low(), start.high(), settings, u);
    converged = found.converged;
    why = std::move(found.why);
  }
  FitSummary result = result_at(problem, start, u);
  result.converged = converged;
  result.why = std::move(why);
  return result;
}

}  // namespace

FitSummary fit(ResidualSource& evaluator, const Hypothesis& start, const FitOptions& options,
               const Eigen::MatrixXd& known) {
  const FitStyle style = evaluator.style(start);
  // Derivatives that are known are those of a model near by. Their sizes are tried before they are
  // trusted.
  const Problem problem(evaluator, start, options, style,
                        Differences(start, known, style.differences));
  if (start.size() > 0 && style.derivatives_at_once) problem.find_differences(bounded(start));
  return solve(problem, start, options, style);
}

FitSummary look_at(ResidualSource& evaluator, const Hypothesis& model, const FitOptions& options) {
  const FitStyle style = evaluator.style(model);
  return result_at(Problem(evaluator, model, options, style, Differences(model, style.differences)),
                   model, model.unknowns());
}

FitSummary refit(ResidualSource& evaluator, const FitSummary& found, const FitOptions& options) {
  const Hypothesis& start = found.hypothesis;
  const FitStyle style = evaluator.style(start);
  // These derivatives were taken at this very point, so nothing has to be found out.
  const Problem problem(evaluator, start, options, style,
                        Differences(start, found.jacobian, style.differences));
  return solve(problem, start, options, style);
}

FitSummary fit_growing(ResidualSource& evaluator, const Hypothesis& start, FitOptions options,
                       std::span<const double> horizons) {
  FitSummary result;
  result.hypothesis = start;
  // Every part starts where the last one ended, and finds the sizes of its differences anew: over a
  // longer record the same change of a frequency moves far more.
  for (const double horizon : horizons) {
    options.horizon = horizon;
    result = fit(evaluator, result.hypothesis, options);
  }
  return result;
}

Scan scan(ResidualSource& evaluator, std::span<const Hypothesis> starts,
          const FitOptions& options) {
  // By the data alone, and with no step of any fit. A start is not judged by what could become of
  // it, so this only parts valleys; what is best here may be the worse one in the end.
  const Eigen::MatrixXd residuals = evaluator.residuals(starts, options);
  Scan result;
  for (Eigen::Index i = 0; i < residuals.cols(); ++i) {
    result.cost.push_back(0.5 * residuals.col(i).squaredNorm());
    if (result.cost.back() < result.cost[result.best]) result.best = static_cast<int>(i);
  }
  return result;
}

Eigen::VectorXd believable_step(const FitSummary& model, const Eigen::VectorXd& change) {
  const Eigen::Index rows = model.jacobian.rows(), n = model.jacobian.cols();
  if (n == 0) return Eigen::VectorXd();
  // Stacked and solved by orthogonal columns, not by normal equations: modulus and density do
  // nearly the same to a free swing, and squaring would lose what little parts them.
  Eigen::MatrixXd stacked(rows + n, n);
  stacked << model.jacobian, Eigen::MatrixXd(prior_rows(model).weight.asDiagonal());
  Eigen::VectorXd wanted = Eigen::VectorXd::Zero(rows + n);
  wanted.head(rows) = change;
  return stacked.colPivHouseholderQr().solve(wanted);
}

Eigen::VectorXd least_squares_step(const Eigen::MatrixXd& jacobian,
                                   const Eigen::VectorXd& residual) {
  if (jacobian.cols() == 0) return Eigen::VectorXd();
  // Pivots, because an unknown that moves nothing must come out as nothing, and not as infinity.
  return jacobian.colPivHouseholderQr().solve(residual);
}

Eigen::VectorXd projected_out(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residual) {
  if (jacobian.cols() == 0) return residual;
  return residual - jacobian * least_squares_step(jacobian, residual);
}

}  // namespace pedicel::discrepancy
