#include "plugins/discrepancy/scene_fit/scene_fit.h"

#include <algorithm>
#include <cmath>

namespace pedicel::discrepancy {

Eigen::MatrixXd SceneEvaluator::residuals(std::span<const Hypothesis> models,
                                          const FitOptions& options) {
  std::vector<SceneVariant> variants;
  // All models and trials in one call, so that they fill the solver's lanes and all threads.
  for (const Hypothesis& model : models) variants.push_back({model.effects});
  std::vector<SceneSimulator::Request> requests;
  for (const SceneVariant& variant : variants)
    for (const int t : options.trials) requests.push_back({&variant, t});
  const std::vector<SceneReadings> readings = simulator_.run(requests);
  Eigen::MatrixXd out(size(options.trials), static_cast<long>(models.size()));
  std::size_t next = 0;
  for (long m = 0; m < out.cols(); ++m) {
    long row = 0;
    for (const int t : options.trials) {
      const long rows = data_.size(t);
      // In the order of the requests: models first, trials within.
      data_.residual(t, readings[next++], std::numeric_limits<double>::infinity(),
                     out.col(m).segment(row, rows));
      row += rows;
    }
  }
  return out;
}

// Entries, measured or not, so that a residual has one layout for all models. What was not measured
// is zero in all of them.
int SceneEvaluator::size(std::span<const int> trials) const {
  int rows = 0;
  for (const int t : trials) rows += data_.size(t);
  return rows;
}

int SceneEvaluator::samples(std::span<const int> trials, double) const {
  // What was measured: the zeros of the rest would make any model look better.
  int count = 0;
  for (const int t : trials) count += data_.samples(t, std::numeric_limits<double>::infinity());
  return count;
}

FitStyle SceneEvaluator::style(const Hypothesis& model) const {
  const SceneFitSettings& how = settings_.fit;
  FitStyle style;
  // Far above what the solver's tolerance and contacts that begin a step earlier or later make, and
  // small beside how models bend.
  style.differences = {how.wanted_change,
                       how.first_step,
                       how.least_step,
                       how.most_step,
                       10.0,
                       false,
                       Eigen::VectorXd::Constant(model.size(), how.least_step)};
  // Moved by a micrometre, an unseen plant sticks to the tool elsewhere, which changes as much as
  // a millimetre does: derivatives over less would be of that, and errors a tenth of what they
  // are.
  for (int p = 0; p < model.size(); ++p) {
    const effects::FreeParameter& free = model.free[static_cast<std::size_t>(p)];
    if (told_of_baseline(model.effects[static_cast<std::size_t>(free.effect)], free))
      style.differences.own_least[p] = how.least_place_step;
  }
  // Derivatives are a simulation of a scene each, and a step that is refused needs none.
  style.derivatives_at_once = false;
  // By its own deviation, whatever the model leaves.
  style.weighs_priors = false;
  style.goes_up = false;
  // Modulus, density and a place do nearly the same to a push, and normal equations would square
  // that.
  style.by_columns = true;
  return style;
}

FitOptions SceneEvaluator::options(const std::vector<int>& trials, int iterations) const {
  FitOptions options;
  options.trials = trials;
  options.iterations = iterations;
  options.least_step = settings_.fit.least_gain;
  return options;
}

Misfit SceneEvaluator::misfit(const Hypothesis& model, const std::vector<int>& trials) {
  return {residuals({&model, 1}, options(trials)).squaredNorm(), samples(trials)};
}

FitSummary fit_scene(SceneEvaluator& evaluator, const Hypothesis& start,
                     const FitOptions& options) {
  FitSummary found = fit(evaluator, start, options);
  // Less than noise is chance.
  found.standard_error *= std::max(1.0, found.misfit().rms());
  return found;
}

void widen_errors(FitSummary& fit, const Eigen::MatrixXd& off) {
  // Without numbers, or with nothing that is off, errors are what they were.
  if (fit.jacobian.cols() == 0 || off.cols() == 0) return;
  // A prediction that is off by d moves the minimum by (J^T J + P)^-1 J^T d, to first order.
  // Samples that are off together do not average out, as noise does: white noise alone gave a
  // tool's offset an error a tenth of what it was off by.
  const Eigen::MatrixXd moved = covariance_of(fit).matrix * (fit.jacobian.transpose() * off);
  for (long p = 0; p < moved.rows(); ++p)
    // Reasons have nothing to do with each other, so their squares add up.
    fit.standard_error[p] = std::hypot(fit.standard_error[p], moved.row(p).norm());
}

void raise_errors(FitSummary& fit, std::span<const int> stretch) {
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
  const Eigen::MatrixXd moved = taken * covariance_of(fit).matrix * pull;
  for (long p = 0; p < n; ++p)
    fit.standard_error[p] = std::max(fit.standard_error[p], moved.row(p).norm());
}

Between between(const FitSummary& one, const FitSummary& other) {
  const Eigen::VectorXd way = other.residual - one.residual;
  const double length = way.norm();
  if (length == 0.0) return {0.5, std::numeric_limits<double>::infinity()};
  // Residuals are measured less predicted, so what is left of the first goes down on the way to
  // where the data are. What it leaves beyond the noise counts as noise here, too.
  return {-one.residual.dot(way) / (length * length), std::max(1.0, one.misfit().rms()) / length};
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
