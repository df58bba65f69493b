#include "pedicel/discrepancy/test/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "pedicel/core/random.h"
#include "pedicel/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {

namespace {

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
  std::vector<Hypothesis> models{base.hypothesis};
  for (const std::size_t d : which) models.push_back(with(base.hypothesis, directions[d].start));
  const Eigen::MatrixXd residuals = evaluator.residuals(models, options);
  for (std::size_t i = 0; i < which.size(); ++i)
    directions[which[i]].change =
        residuals.col(0) - residuals.col(static_cast<Eigen::Index>(i) + 1);
}

// The parameters take of each change what they can, as far as that goes with what is known of them.
void project_out_nuisance(const FitSummary& base, std::vector<Direction>& directions) {
  const Eigen::Index rows = base.jacobian.rows(), n = base.jacobian.cols();
  const Eigen::VectorXd weight = prior_rows(base).weight;
  Eigen::MatrixXd stacked(rows + n, n);
  stacked << base.jacobian, Eigen::MatrixXd(weight.asDiagonal());
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> all(stacked);
  Eigen::VectorXd change = Eigen::VectorXd::Zero(rows + n);
  for (Direction& direction : directions) {
    if (n > 0) {
      change.head(rows) = direction.change;
      direction.nuisance_step = all.solve(change);
    }
    direction.change -= base.jacobian * direction.nuisance_step;
    direction.against = -weight.cwiseProduct(direction.nuisance_step);
  }
}

Eigen::VectorXd joined(const Eigen::VectorXd& first, const Eigen::VectorXd& second) {
  Eigen::VectorXd both(first.size() + second.size());
  both << first, second;
  return both;
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
    if (size >= 0.2 * accuracy.direction_change && size <= accuracy.most_change) continue;
    const effects::EffectDefinition* definition = effects::find_effect(direction.cause);
    direction.has_threshold = size < no_change || (definition && definition->has_threshold);
    const double share = direction.has_threshold
                             ? accuracy.full_size
                             : std::clamp(accuracy.direction_change / size, 1.0e-4, 20.0);
    direction.start = direction.start.shrunk(share).bounded();
    again.push_back(d);
  }
  measure_changes(evaluator, base, options, again, directions);
  project_out_nuisance(base, directions);
  return directions;
}

double length(const Direction& direction) {
  return std::sqrt(direction.change.squaredNorm() + direction.against.squaredNorm());
}

Alarm judge(std::vector<Direction>& directions, const FitSummary& base,
            const Eigen::VectorXd& numerical, std::uint64_t seed,
            const DiagnosisSettings& settings) {
  Alarm alarm;
  std::vector<Eigen::VectorXd> unit;
  const Eigen::VectorXd residual = joined(base.residual, prior_rows(base).left);
  double most = 0.0;
  for (std::size_t d = 0; d < directions.size(); ++d) {
    Direction& direction = directions[d];
    const double size = length(direction);
    unit.push_back(joined(direction.change, direction.against));
    unit.back() *= size > no_change ? 1.0 / size : 0.0;
    direction.statistic = unit.back().dot(residual);
    direction.systematic =
        numerical.size() > 0 ? unit.back().head(numerical.size()).dot(numerical) : 0.0;
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
      correlation(i, j) = correlation(j, i) = unit[i].dot(unit[j]);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(correlation);
  const Eigen::MatrixXd root =
      eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
  Random random(seed);
  std::vector<double> largest;
  for (int b = 0; b < settings.budget.bootstraps; ++b) {
    Eigen::VectorXd normal(count);
    for (double& x : normal) x = random.normal();
    largest.push_back(count > 0 ? (root * normal).cwiseAbs().maxCoeff() : 0.0);
  }
  std::sort(largest.begin(), largest.end());
  alarm.level = std::max(settings.levels.least_alarm,
                         largest[static_cast<std::size_t>(settings.levels.alarm_quantile *
                                                          settings.budget.bootstraps)]);
  alarm.raised = most > alarm.level;
  return alarm;
}

double detectable_limit(const Direction& direction, double sigma, std::string& parameter) {
  constexpr double never = std::numeric_limits<double>::infinity();
  const std::vector<FreeParameter>& free = direction.start.free;
  const auto sized = std::ranges::find_if(
      free, [](const FreeParameter& p) { return p.vanishes != Vanishes::never; });
  if (sized == free.end()) return never;
  parameter = sized->name;
  const double size = length(direction);
  if (size < no_change || (direction.has_threshold && size < sigma)) return never;
  const Hypothesis seen =
      direction.has_threshold ? direction.start : direction.start.shrunk(sigma / size);
  double squares = 0.0;  // of a vector's components
  for (int i = 0; i < seen.size(); ++i)
    if (free[i].effect == sized->effect && free[i].name == parameter)
      squares += seen.value(i) * seen.value(i);
  return std::sqrt(squares);
}

}  // namespace pedicel::discrepancy
