#include "plugins/discrepancy/select/candidate_starts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {

using plant::MaterialRole;

namespace {

constexpr double no_change = 1.0e-12;  // a direction without length

// Of matrix step = right, with those that are held where they are.
Eigen::VectorXd solve_others(Eigen::MatrixXd matrix, Eigen::VectorXd right,
                             const std::vector<bool>& held, const Eigen::VectorXd& step) {
  for (int p = 0; p < step.size(); ++p) {
    if (!held[p]) continue;
    right -= step[p] * matrix.col(p);
    matrix.row(p).setZero();
    matrix.col(p).setZero();
    matrix(p, p) = 1.0;
  }
  for (int p = 0; p < step.size(); ++p)
    if (held[p]) right[p] = step[p];
  return matrix.ldlt().solve(right);
}

// Where the linear model about the baseline puts a cause, the baseline's numbers moved along with
// it; nothing where the data ask for the sign that the cause cannot have.
std::optional<Hypothesis> linear_start(const FitSummary& base, const Direction& direction,
                                       const DiagnosisSettings& settings) {
  const double size = length(direction);
  // Too little is seen of it for a size.
  if (size < no_change || std::abs(direction.statistic) < settings.budget.least_statistic)
    return {};
  const double share = direction.has_threshold ? 1.0 : direction.statistic / size;
  for (const FreeParameter& free : direction.start.free) {
    const bool one_sided = free.vanishes == Vanishes::at_infinity ||
                           (free.vanishes == Vanishes::at_zero && free.logarithmic);
    // A cause cannot be less than absent.
    if (share < 0.0 && one_sided) return {};
  }
  Hypothesis both = base.hypothesis;
  // A change of full size is too large to move along with.
  if (!direction.has_threshold)
    both.set_unknowns(base.hypothesis.unknowns() +
                      allowed_step(base, -share * direction.nuisance_step, settings));
  both.add(direction.start.shrunk(share).bounded());
  both.name = direction.cause;
  return both;
}

bool is_ladder(const Cause& cause, const Budget& budget) {
  return cause.starts.size() >= static_cast<std::size_t>(budget.ladder_rungs) &&
         std::ranges::all_of(cause.starts, [](const Hypothesis& s) {
           return s.size() == 1 && s.free[0].logarithmic;
         });
}

// Of those that do as well as the best one, as all thresholds that do nothing.
int lowest_of_best(const Scan& found, double tie) {
  int lowest = 0;
  // A threshold that nothing reaches cannot be told from a higher one; the lowest is the most
  // informative.
  while (found.cost[lowest] > found.cost[found.best] + tie) ++lowest;
  return lowest;
}

// From a start's one neighbour to the other, in steps that are several times shorter.
std::vector<Hypothesis> finer_ladder(const std::vector<Hypothesis>& ladder, int at, int parts) {
  const int first = std::max(0, at - 1);
  const int last = std::min(at + 1, static_cast<int>(ladder.size()) - 1);
  std::vector<Hypothesis> finer;
  for (int i = first; i < last; ++i)
    for (int k = 0; k < parts; ++k) {
      const double share = static_cast<double>(k) / parts;
      finer.push_back(ladder[i]);
      finer.back().set_unknowns((1.0 - share) * ladder[i].unknowns() +
                                share * ladder[i + 1].unknowns());
    }
  finer.push_back(ladder[last]);
  return finer;
}

}  // namespace

Hypothesis joined(const Hypothesis& base, const Hypothesis& start, bool from_nominal) {
  Hypothesis both = base;
  // A baseline that was pulled away by what it lacks may be a bad place to start from.
  if (from_nominal)
    for (int i = 0; i < both.size(); ++i)
      if (both.free[i].name == "factor" && both.free[i].prior_centre == 1.0) both.set_value(i, 1.0);
  both.add(start);
  both.name = start.name;
  return both;
}

std::vector<Hypothesis> best_starts(Evaluator& evaluator, const FitSummary& base,
                                    const Cause& cause, FitOptions options, std::size_t keep) {
  std::vector<Hypothesis> starts;
  for (const Hypothesis& start : cause.starts) {
    starts.push_back(joined(base.hypothesis, start, false));
    // Where a symptom says how large it is, no small size is guessed at.
    if (cause.led.empty()) starts.push_back(joined(base.hypothesis, start.shrunk(0.2), false));
  }
  for (const Hypothesis& start : cause.led) starts.push_back(joined(base.hypothesis, start, false));
  const std::size_t about_refitted = starts.size();
  for (const Hypothesis& start : cause.starts)
    starts.push_back(joined(base.hypothesis, start, true));
  options.horizon = options.settings->budget.candidate_horizon;
  const Scan found = scan(evaluator, starts, options);
  std::vector<std::size_t> order(starts.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(
      order, [&](std::size_t a, std::size_t b) { return found.cost[a] < found.cost[b]; });
  // The best about the refitted baseline, and the best about the nominal one: these are two
  // valleys, and a baseline that took over most of the cause makes its own look nearer than it
  // leads.
  const auto about_nominal = [&](std::size_t i) { return i >= about_refitted; };
  if (keep > 1)
    std::stable_partition(order.begin() + 1, order.end(), [&](std::size_t i) {
      return about_nominal(i) != about_nominal(order.front());
    });
  std::vector<Hypothesis> best;
  for (std::size_t i = 0; i < std::min(keep, order.size()); ++i) best.push_back(starts[order[i]]);
  return best;
}

Eigen::VectorXd allowed_step(const FitSummary& model, const Eigen::VectorXd& wanted,
                             const DiagnosisSettings& settings) {
  const int n = model.hypothesis.size();
  const Eigen::VectorXd u = model.hypothesis.unknowns();
  const Eigen::VectorXd low = model.hypothesis.low() - u, high = model.hypothesis.high() - u;
  const Eigen::MatrixXd by_data = model.jacobian.transpose() * model.jacobian;
  Eigen::MatrixXd information = by_data;
  for (int p = 0; p < n; ++p) information(p, p) += std::pow(model.hypothesis.free[p].width(), -2);
  Eigen::VectorXd step = Eigen::VectorXd::Zero(n);
  std::vector<bool> held(n, false);
  // Those that reach a bound stay there, and the others take over what they can.
  for (int round = 0; round <= n; ++round) {
    const Eigen::VectorXd free_step = solve_others(information, by_data * wanted, held, step);
    step = free_step.cwiseMax(low).cwiseMin(high);
    if (step == free_step) break;
    for (int p = 0; p < n; ++p) held[p] = held[p] || step[p] != free_step[p];
  }
  // Along the valley of a free vibration the data hold nothing: there it ends where density is no
  // longer believed.
  const int modulus = model.hypothesis.factor_on(MaterialRole::stiffness),
            density = model.hypothesis.factor_on(MaterialRole::mass);
  if (modulus < 0 || density < 0) return step;
  const double most = settings.levels.believed * model.hypothesis.free[density].width();
  const double beyond = step[density] - std::clamp(step[density], -most, most);
  step[density] -= beyond;
  step[modulus] = std::clamp(step[modulus] - beyond, low[modulus], high[modulus]);
  return step;
}

std::optional<Hypothesis> twin_of(const Hypothesis& fitted) {
  const int last = static_cast<int>(fitted.effects.size()) - 1;
  const effects::EffectDefinition* known =
      last < 0 ? nullptr : effects::find_effect(fitted.effects[last].name);
  if (!known || !known->twin) return {};
  Hypothesis twin = fitted;
  double ratio = 1.0;
  twin.effects[last] = known->twin(fitted.effects[last], ratio);
  const int modulus = fitted.factor_on(MaterialRole::stiffness);
  if (modulus >= 0) twin.set_value(modulus, ratio * fitted.value(modulus));
  return twin.bounded();
}

bool has_place(const Hypothesis& hypothesis) {
  return std::ranges::any_of(hypothesis.free,
                             [](const FreeParameter& p) { return p.name == "at"; });
}

std::vector<Hypothesis> best_linear_starts(Evaluator& evaluator, const FitSummary& base,
                                           const std::string& cause,
                                           const std::vector<Direction>& directions,
                                           const FitOptions& options) {
  std::vector<const Direction*> own;
  for (const Direction& direction : directions)
    if (direction.cause == cause) own.push_back(&direction);
  std::ranges::stable_sort(own, [](const Direction* a, const Direction* b) {
    return std::abs(a->statistic) > std::abs(b->statistic);
  });
  // A place may be softer or stiffer than drawn: the strongest of both.
  std::vector<Hypothesis> starts;
  const int linear = options.settings->budget.linear_starts;
  const int with_threshold = options.settings->budget.threshold_starts;
  std::array<int, 2> of_sign{};
  int thresholds = 0;
  for (const Direction* direction : own) {
    auto start = linear_start(base, *direction, *options.settings);
    if (start && (direction->has_threshold ? thresholds++ < with_threshold
                                           : of_sign[direction->statistic > 0.0]++ < linear))
      starts.push_back(std::move(*start));
  }
  if (starts.size() < 2 || has_place(starts.front())) return starts;
  return {starts[scan(evaluator, starts, options).best]};
}

std::vector<Hypothesis> continued(const Hypothesis& base, const Hypothesis& fitted,
                                  const Cause& cause, double amplitude) {
  const plant::Effect& special = fitted.effects.back();
  std::vector<Hypothesis> starts;
  for (const Hypothesis& start : cause.starts) {
    Hypothesis own = start;
    for (const auto& [name, numbers] : special.numbers)
      if (own.effects[0].numbers.contains(name)) own.effects[0].numbers[name] = numbers;
    if (own.effects[0].numbers.contains("amplitude"))
      own.effects[0].numbers["amplitude"] = {amplitude};
    Hypothesis both = base;
    both.set_unknowns(fitted.unknowns().head(base.size()));
    both.add(own.bounded());
    both.name = cause.name;
    starts.push_back(std::move(both));
  }
  return starts;
}

std::optional<Hypothesis> best_plain_start(Evaluator& evaluator, const FitSummary& base,
                                           const Cause& cause, const FitOptions& options) {
  const Budget& budget = options.settings->budget;
  std::vector<Hypothesis> starts;
  for (const auto* own : {&cause.starts, &cause.led})
    for (const Hypothesis& start : *own) starts.push_back(joined(base.hypothesis, start, false));
  Scan found = scan(evaluator, starts, options);
  // One threshold does nothing, and the next one too much.
  for (int round = 0; round < budget.ladder_rounds && is_ladder(cause, budget); ++round) {
    starts = finer_ladder(starts, lowest_of_best(found, budget.ladder_tie), budget.ladder_parts);
    found = scan(evaluator, starts, options);
  }
  if (!(found.cost[found.best] < base.cost)) return {};
  return starts[found.best];
}

Hypothesis with_threshold_by(Evaluator& evaluator, const Hypothesis& fitted, const Cause& cause,
                             const FitOptions& options) {
  const Budget& budget = options.settings->budget;
  if (!is_ladder(cause, budget)) return fitted;
  const Eigen::Index last = fitted.size() - 1;
  const double rung = cause.starts[1].unknowns()[0] - cause.starts[0].unknowns()[0];
  std::vector<Hypothesis> ladder(3, fitted);
  for (int i = 0; i < 3; ++i) {
    Eigen::VectorXd moved = fitted.unknowns();
    moved[last] += (i - 1) * rung;
    ladder[i].set_unknowns(moved);
    ladder[i] = ladder[i].bounded();
  }
  Scan found;
  for (int round = 0, at = 1; round < budget.ladder_rounds; ++round) {
    ladder = finer_ladder(ladder, at, budget.ladder_parts);
    found = scan(evaluator, ladder, options);
    at = lowest_of_best(found, budget.ladder_tie);
  }
  return ladder[found.best];
}

}  // namespace pedicel::discrepancy
