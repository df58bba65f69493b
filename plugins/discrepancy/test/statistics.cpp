#include "plugins/discrepancy/test/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "engine/core/random.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {

namespace {

// Noise units over a whole experiment: what is below is rounding.
constexpr double no_change = 1.0e-3;
Hypothesis with(const Hypothesis& base, const Hypothesis& start) {
  Hypothesis both = base;
  both.add(start);
  both.name = start.name;
  return both;
}

// What the starts of `which` directions change of the base's prediction.
void measure_changes(Evaluator& evaluator, const FitSummary& base, const FitOptions& options,
                     const std::vector<std::size_t>& which, std::vector<Direction>& directions) {
  // Some at a time: predictions of all together would take most of a diagnosis's memory.
  constexpr std::size_t at_once = 32;
  const Eigen::VectorXd without =
      evaluator.residuals(std::span(&base.hypothesis, 1), options).col(0);
  for (std::size_t first = 0; first < which.size(); first += at_once) {
    const std::span some = std::span(which).subspan(first, std::min(at_once, which.size() - first));
    std::vector<Hypothesis> models;
    for (const std::size_t d : some) models.push_back(with(base.hypothesis, directions[d].start));
    const Eigen::MatrixXd residuals = evaluator.residuals(models, options);
    // Residual is measured less predicted, so this is the prediction with the cause less that
    // without it. What was measured cancels.
    for (std::size_t i = 0; i < some.size(); ++i)
      directions[some[i]].change = without - residuals.col(static_cast<Eigen::Index>(i));
  }
}

// The parameters take of each change what they can, as far as that goes with what is known of them.
// Without this every cause would look like the modulus that mimics it, and one alarm would raise
// all others.
void project_out_nuisance(const FitSummary& base, std::vector<Direction>& directions) {
  const Eigen::Index rows = base.jacobian.rows(), n = base.jacobian.cols();
  const Eigen::VectorXd weight = prior_rows(base).weight;
  Eigen::MatrixXd stacked(rows + n, n);
  // What is known beforehand are further rows of the same least squares: a density that is known to
  // 10 % may hide only so much.
  stacked << base.jacobian, Eigen::MatrixXd(weight.asDiagonal());
  // By QR and not by normal equations: modulus and density of a free swing are nearly one column,
  // and squaring would lose what tells them apart. One factorisation serves all directions.
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> all(stacked);
  Eigen::VectorXd change = Eigen::VectorXd::Zero(rows + n);
  for (Direction& direction : directions) {
    if (n > 0) {
      change.head(rows) = direction.change;
      direction.nuisance_step = all.solve(change);
    }
    direction.change -= base.jacobian * direction.nuisance_step;
    // Its share of the prior's rows. Left out, a direction that goes against what is known would be
    // taken for shorter than it is.
    direction.against = -weight.cwiseProduct(direction.nuisance_step);
  }
}

std::vector<std::size_t> all_of(const std::vector<Direction>& directions) {
  std::vector<std::size_t> all(directions.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

}  // namespace

std::vector<Direction> directions_of(Evaluator& evaluator, const FitSummary& base,
                                     const std::vector<Cause>& causes, const FitOptions& options,
                                     const std::vector<Direction>& known) {
  const Accuracy& accuracy = options.settings->accuracy;
  std::vector<Direction> directions;
  for (const Cause& cause : causes)
    for (const Hypothesis& start : cause.starts) {
      const std::size_t d = directions.size();
      // Directions come in the order of causes and starts, so those of another model stand at the
      // same places.
      const bool sized = d < known.size() && !known[d].has_threshold;
      directions.push_back({cause.name,
                            sized ? known[d].start : start.shrunk(1.0 / accuracy.full_size),
                            {},
                            {},
                            false});
    }
  measure_changes(evaluator, base, options, all_of(directions), directions);
  // The first look says how large a start is in units of the noise. What has a threshold and does
  // nothing when it is small is taken at its full size.
  std::vector<std::size_t> again;
  for (std::size_t d = 0; d < directions.size(); ++d) {
    Direction& direction = directions[d];
    const double size = direction.change.norm();
    // Between these the response is about linear and well above rounding. One simulation is saved
    // for each that is.
    if (size >= 0.2 * accuracy.direction_change && size <= accuracy.most_change) continue;
    const effects::EffectDefinition* definition = effects::find_effect(direction.cause);
    direction.has_threshold = size < no_change || (definition && definition->has_threshold);
    // Bounded: a start that does nearly nothing must not be blown up to nonsense.
    const double share = direction.has_threshold
                             ? accuracy.full_size
                             : std::clamp(accuracy.direction_change / size, 1.0e-4, 20.0);
    direction.start = direction.start.shrunk(share).bounded();
    again.push_back(d);
  }
  measure_changes(evaluator, base, options, again, directions);
  // Last, as sizes are about what a cause does by itself.
  project_out_nuisance(base, directions);
  return directions;
}

double length(const Direction& direction) {
  // Of the whole row of data and prior, in which the statistic is a unit normal.
  return std::sqrt(direction.change.squaredNorm() + direction.against.squaredNorm());
}

Alarm judge(std::vector<Direction>& directions, const FitSummary& base,
            const Eigen::VectorXd& numerical, std::uint64_t seed,
            const DiagnosisSettings& settings) {
  Alarm alarm;
  // What a direction is divided by; a copy of each would be as large as all of them.
  std::vector<double> unit;
  // The base has paid for its numbers' distance from what is known. That is a part of what is left.
  const Eigen::VectorXd left = prior_rows(base).left;
  double most = 0.0;
  for (std::size_t d = 0; d < directions.size(); ++d) {
    Direction& direction = directions[d];
    const double size = length(direction);
    // What the parameters explain in full has no direction of its own, and a statistic of zero.
    unit.push_back(size > no_change ? 1.0 / size : 0.0);
    direction.statistic =
        unit.back() * (direction.change.dot(base.residual) + direction.against.dot(left));
    direction.systematic =
        numerical.size() > 0 ? unit.back() * direction.change.head(numerical.size()).dot(numerical)
                             : 0.0;
    // Our own error may push either way, so all of it is taken off.
    const double beyond = std::abs(direction.statistic) - std::abs(direction.systematic);
    if (beyond <= most) continue;
    most = beyond;
    alarm.statistic = std::abs(direction.statistic);
    alarm.strongest = static_cast<int>(d);
  }
  // Where nothing is wrong the statistics are jointly normal with the directions' own correlations:
  // noise through them is the bootstrap of the whole linear pipeline, the refit included, because
  // the directions hold nothing that the parameters can take up.
  const auto count = static_cast<Eigen::Index>(unit.size());
  Eigen::MatrixXd correlation(count, count);
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index j = 0; j <= i; ++j)
      correlation(i, j) = correlation(j, i) = unit[i] * unit[j] *
                                              (directions[i].change.dot(directions[j].change) +
                                               directions[i].against.dot(directions[j].against));
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(correlation);
  // A root of the correlations. By eigenvalues, since directions of one cause are nearly the same
  // and the matrix is singular; rounding makes some of them a little negative.
  const Eigen::MatrixXd root =
      eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
  // A fixed seed: the level is a number of the data, and must be the same in each run.
  Random random(seed);
  std::vector<double> largest;
  // Draws of all statistics together cost nothing beside one simulation.
  for (int b = 0; b < settings.budget.bootstraps; ++b) {
    Eigen::VectorXd normal(count);
    for (double& x : normal) x = random.normal();
    largest.push_back(count > 0 ? (root * normal).cwiseAbs().maxCoeff() : 0.0);
  }
  std::sort(largest.begin(), largest.end());
  // The quantile of the largest, and not of one: a hundred directions have a large one by chance.
  // The floor holds where directions are few, and a bootstrap of 400 does not reach so far.
  alarm.level = std::max(settings.levels.least_alarm,
                         largest[static_cast<std::size_t>(settings.levels.alarm_quantile *
                                                          settings.budget.bootstraps)]);
  alarm.raised = most > alarm.level;
  return alarm;
}

double detectable_limit(const Direction& direction, double sigma, std::string& parameter) {
  constexpr double never = std::numeric_limits<double>::infinity();
  const std::vector<FreeParameter>& free = direction.start.free;
  // The first number that vanishes is the size; places and shapes never do.
  const auto sized = std::ranges::find_if(
      free, [](const FreeParameter& p) { return p.vanishes != Vanishes::never; });
  if (sized == free.end()) return never;
  parameter = sized->name;
  const double size = length(direction);
  if (size < no_change || (direction.has_threshold && size < sigma)) return never;
  // A change grows with its size, so the size at which it would be `sigma` long follows by a ratio.
  const Hypothesis seen =
      direction.has_threshold ? direction.start : direction.start.shrunk(sigma / size);
  double squares = 0.0;  // of a vector's components
  for (int i = 0; i < seen.size(); ++i)
    if (free[i].effect == sized->effect && free[i].name == parameter)
      squares += seen.value(i) * seen.value(i);
  return std::sqrt(squares);
}

}  // namespace pedicel::discrepancy
