#include "plugins/discrepancy/select/place_search.h"

#include <array>
#include <span>
#include <vector>

#include "plugins/discrepancy/fit/profile.h"

namespace pedicel::discrepancy {

namespace {

// Of the curve, or of the time in which it may have happened. Where a slip moves everything at once
// its time does nothing between two samples: the nearest shifts are about as long as a sample.
constexpr std::array place_shifts{0.04, 0.1, 0.3};
constexpr std::array moment_shifts{0.002, 0.005, 0.015, 0.04, 0.1, 0.3};

bool is_of_moment(const FreeParameter& parameter) {
  return parameter.name == "time" && !parameter.logarithmic;  // a time constant is logarithmic
}

int slid_parameter(const Hypothesis& model) {
  const int last = static_cast<int>(model.effects.size()) - 1;
  for (int p = 0; p < model.size(); ++p)
    // Only the last effect: those before it were slid when they were added.
    if (model.free[p].effect == last && (model.free[p].name == "at" || is_of_moment(model.free[p])))
      return p;
  return -1;
}

// The same model with that parameter elsewhere, on either side, within its bounds.
std::vector<Hypothesis> moved(const Hypothesis& model, int parameter) {
  const FreeParameter& free = model.free[parameter];
  const bool moment = is_of_moment(free);
  const std::span<const double> shifts =
      moment ? std::span<const double>(moment_shifts) : std::span<const double>(place_shifts);
  const double whole = moment ? free.high - free.low : 1.0;
  std::vector<Hypothesis> there;
  for (const double shift : shifts)
    for (const double side : {-1.0, 1.0}) {
      const double at = model.value(parameter) + side * shift * whole;
      // A step out of bounds is left out, not cut: it would be tried twice.
      if (at < free.low || at > free.high) continue;
      there.push_back(model);
      there.back().set_value(parameter, at);
    }
  return there;
}

// Least squares of a residual and of what is known beforehand by all unknowns but one.
class Others {
 public:
  Others(const FitSummary& model, int held) : prior_(prior_rows(model)), held_(held) {
    const Eigen::Index rows = model.jacobian.rows(), n = model.jacobian.cols();
    stacked_.resize(rows + n, n);
    stacked_ << model.jacobian, Eigen::MatrixXd(prior_.weight.asDiagonal());
    // The place is held where it was moved to, and the others answer.
    stacked_.col(held).setZero();
    solver_.compute(stacked_);
  }

  struct Moved {
    Eigen::VectorXd step;
    double cost = 0.0;
  };
  Moved move(const Eigen::VectorXd& residual) const {
    Eigen::VectorXd wanted(stacked_.rows());
    wanted << residual, prior_.left;
    Moved moved{solver_.solve(wanted), 0.0};
    moved.step[held_] = 0.0;
    moved.cost = 0.5 * (wanted - stacked_ * moved.step).squaredNorm();
    return moved;
  }

 private:
  PriorRows prior_;
  int held_;
  Eigen::MatrixXd stacked_;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver_;
};

}  // namespace

FitSummary slide_along(Evaluator& evaluator, FitSummary found, const FitOptions& options) {
  const int parameter = slid_parameter(found.hypothesis);
  if (parameter < 0 || found.jacobian.size() == 0) return found;
  const Budget& budget = options.settings->budget;
  const int rounds =
      is_of_moment(found.hypothesis.free[parameter]) ? budget.instant_rounds : budget.place_rounds;
  FitOptions few = options;
  few.iterations = budget.slide_iterations;
  for (int round = 0; round < rounds; ++round) {
    std::vector<Hypothesis> there = moved(found.hypothesis, parameter);
    if (there.empty()) break;
    const Eigen::MatrixXd residuals = evaluator.residuals(there, options);
    // Linear, so that a place costs one simulation and no fit.
    const Others others(found, parameter);
    double least = objective(found) - budget.worth_a_fit;
    const Hypothesis* best = nullptr;
    for (std::size_t i = 0; i < there.size(); ++i) {
      const Others::Moved after = others.move(residuals.col(static_cast<Eigen::Index>(i)));
      if (!(after.cost < least)) continue;
      least = after.cost;
      there[i].set_unknowns(there[i].unknowns() + after.step);
      best = &there[i];
    }
    // Nowhere is better even after the others have moved: this is the place.
    if (!best) break;
    FitSummary next = fit(evaluator, *best, few, found.jacobian);
    if (!(objective(next) < objective(found) - budget.worth_a_fit)) break;
    found = std::move(next);
  }
  return found;
}

}  // namespace pedicel::discrepancy
