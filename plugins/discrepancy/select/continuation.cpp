#include "plugins/discrepancy/select/continuation.h"

#include <algorithm>
#include <cmath>

#include "plugins/discrepancy/select/place_search.h"

namespace pedicel::discrepancy {

using plant::MaterialRole;

namespace {

constexpr double no_change = 1.0e-12;

// How far back it is for each unknown; 0 for those that are within so many deviations.
Eigen::VectorXd way_of(const Hypothesis& model, double deviations) {
  Eigen::VectorXd way = Eigen::VectorXd::Zero(model.size());
  const Eigen::VectorXd u = model.unknowns();
  for (int p = 0; p < model.size(); ++p) {
    const FreeParameter& free = model.free[p];
    // Only what is known beforehand can be pulled away from what is known.
    if (free.name != "factor" || free.prior <= 0.0) continue;
    const double step = free.to_unknown(free.prior_centre) - u[p];
    if (std::abs(step) > deviations * free.prior) way[p] = step;
  }
  return way;
}

// What a part of the way changes of the prediction. Masses add up, their logarithms do not.
Eigen::VectorXd change_of(const FitSummary& base, const Eigen::VectorXd& way, double part) {
  Eigen::VectorXd change = Eigen::VectorXd::Zero(base.jacobian.rows());
  for (int p = 0; p < way.size(); ++p)
    if (way[p] != 0.0) {
      const bool logarithmic = base.hypothesis.free[p].logarithmic;
      change += base.jacobian.col(p) * (logarithmic ? std::expm1(part * way[p]) : part * way[p]);
    }
  return change;
}

// The size of a cause, over that of its direction, that undoes a change, and what that leaves.
struct TakenOver {
  double size = 0.0, left = 1.0;
};

TakenOver taken_over(const FitSummary& base, const Direction& direction,
                     const Eigen::VectorXd& change) {
  const Eigen::VectorXd own = direction.change + base.jacobian * direction.nuisance_step;
  const double square = own.squaredNorm();
  // Below its threshold such a cause does nothing, so its direction says nothing of its size.
  if (direction.has_threshold || square < no_change) return {};
  const double size = -own.dot(change) / square;
  return {size, (change + size * own).norm() / std::max(change.norm(), no_change)};
}

// With the factors held to a part of their way.
Hypothesis at_part(const Hypothesis& model, const FitSummary& base, const Eigen::VectorXd& way,
                   double part, double held_to) {
  Hypothesis held = model;
  Eigen::VectorXd u = held.unknowns();
  for (int p = 0; p < way.size(); ++p) {
    if (way[p] == 0.0) continue;
    u[p] = base.hypothesis.unknowns()[p] + part * way[p];
    // Held by a narrow prior: the data may still pull at it.
    held.free[p].prior = held_to;
    held.free[p].prior_centre = held.free[p].to_value(u[p]);
  }
  held.set_unknowns(u);
  return held;
}

// The cause by a factor larger, what it extends as it is.
Hypothesis grown(const Hypothesis& model, const FitSummary& base, double factor) {
  Hypothesis added;
  const auto known = base.hypothesis.effects.size();
  added.effects.assign(model.effects.begin() + static_cast<std::ptrdiff_t>(known),
                       model.effects.end());
  added.free.assign(model.free.begin() + base.hypothesis.size(), model.free.end());
  // Indices count from the first effect of the hypothesis that they stand in.
  for (FreeParameter& free : added.free) free.effect -= static_cast<int>(known);
  Hypothesis result = model;
  result.effects.resize(known);
  result.free.resize(base.hypothesis.size());
  result.add(added.shrunk(factor).bounded());
  return result;
}

}  // namespace

bool has_prior_shift(const Hypothesis& model, const DiagnosisSettings& settings) {
  return (way_of(model, settings.levels.believed).array() != 0.0).any();
}

bool conflicts_with_prior(const FitSummary& model, const DiagnosisSettings& settings) {
  const Hypothesis& numbers = model.hypothesis;
  return (way_of(numbers, settings.levels.prior_conflict).array() != 0.0).any() ||
         std::ranges::any_of(model.at_bound, [&](int p) {
           return p == numbers.factor_on(MaterialRole::stiffness) ||
                  p == numbers.factor_on(MaterialRole::mass);
         });
}

Hypothesis at_prior(Hypothesis model) {
  model.set_unknowns(model.unknowns() + way_of(model, 0.0));
  return model;
}

std::vector<Direction> likest_continuations(const FitSummary& base, const std::string& cause,
                                            const std::vector<Direction>& directions,
                                            const Budget& budget) {
  const Eigen::VectorXd way = way_of(base.hypothesis, budget.continuation_way);
  if ((way.array() == 0.0).all()) return {};
  const Eigen::VectorXd change = change_of(base, way, 1.0);
  std::vector<std::pair<double, const Direction*>> like;
  for (const Direction& direction : directions) {
    if (direction.cause != cause) continue;
    const TakenOver found = taken_over(base, direction, change);
    // The cause must undo most of what the pulled factor does, and with the sign that it can have.
    if (found.size > 0.0 && found.left < budget.continuation_unlike)
      like.emplace_back(found.left, &direction);
  }
  std::ranges::stable_sort(like, {}, &std::pair<double, const Direction*>::first);
  std::vector<Direction> first;
  for (std::size_t i = 0;
       i < std::min(static_cast<std::size_t>(budget.continuation_starts), like.size()); ++i)
    first.push_back(*like[i].second);
  return first;
}

std::optional<FitSummary> continue_to_prior(Evaluator& evaluator, const FitSummary& base,
                                            const Direction& cause, const FitOptions& options) {
  const Budget& budget = options.settings->budget;
  const Eigen::VectorXd way = way_of(base.hypothesis, budget.continuation_way);
  // Short enough that each step starts within reach of its minimum.
  const int steps =
      std::clamp(static_cast<int>(std::ceil(way.cwiseAbs().maxCoeff() / budget.continuation_step)),
                 1, budget.continuation_steps);
  const auto change_at = [&](int step) {
    return change_of(base, way, static_cast<double>(step) / steps);
  };
  FitOptions few = options;
  few.iterations = std::min(budget.continuation_iterations, options.iterations);
  Hypothesis model = base.hypothesis;
  model.add(cause.start.shrunk(taken_over(base, cause, change_at(1)).size).bounded());
  model.name = cause.cause;
  for (int step = 1; step <= steps; ++step) {
    // The cause takes over what the factor gives up; linear between two steps.
    if (step > 1) model = grown(model, base, change_at(step).norm() / change_at(step - 1).norm());
    const Hypothesis held =
        at_part(model, base, way, static_cast<double>(step) / steps, budget.continuation_hold);
    const FitSummary found = fit(evaluator, held, few, base.jacobian);
    // Once the trail is lost, further steps lead elsewhere.
    if (!(found.cost < budget.continuation_lost * base.cost)) return {};
    model.set_unknowns(found.hypothesis.unknowns());
  }
  // At the end the factors are free again: the data have the last word.
  return slide_along(evaluator, fit(evaluator, model, options, base.jacobian), options);
}

}  // namespace pedicel::discrepancy
