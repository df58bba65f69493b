#include "discrepancy/place_search.h"

#include <array>
#include <vector>

#include "discrepancy/profile.h"

namespace pedicel::discrepancy {

namespace {

constexpr std::array shifts{-0.3, -0.1, -0.04, 0.04, 0.1, 0.3};  // of the curve
constexpr int most_rounds = 3, round_iterations = 10;
constexpr double worth_a_fit = 1.0;  // nats

int place_of(const Hypothesis& model) {
  const int last = static_cast<int>(model.effects.size()) - 1;
  for (int p = 0; p < model.size(); ++p)
    if (model.free[p].effect == last && model.free[p].name == "at") return p;
  return -1;
}

// Least squares of a residual and of what is known beforehand by all unknowns but one.
class Others {
 public:
  Others(const FitSummary& model, int held) : prior_(prior_rows(model)), held_(held) {
    const Eigen::Index rows = model.jacobian.rows(), n = model.jacobian.cols();
    stacked_.resize(rows + n, n);
    stacked_ << model.jacobian, Eigen::MatrixXd(prior_.weight.asDiagonal());
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
  const int place = place_of(found.hypothesis);
  if (place < 0 || found.jacobian.size() == 0) return found;
  FitOptions few = options;
  few.iterations = round_iterations;
  for (int round = 0; round < most_rounds; ++round) {
    std::vector<Hypothesis> there;
    for (const double shift : shifts) {
      const double at = found.hypothesis.value(place) + shift;
      if (at < found.hypothesis.free[place].low || at > found.hypothesis.free[place].high) continue;
      there.push_back(found.hypothesis);
      there.back().set_value(place, at);
    }
    if (there.empty()) break;
    const Eigen::MatrixXd residuals = evaluator.residuals(there, options);
    const Others others(found, place);
    double least = objective(found) - worth_a_fit;
    const Hypothesis* best = nullptr;
    for (std::size_t i = 0; i < there.size(); ++i) {
      const Others::Moved moved = others.move(residuals.col(static_cast<Eigen::Index>(i)));
      if (!(moved.cost < least)) continue;
      least = moved.cost;
      there[i].set_unknowns(there[i].unknowns() + moved.step);
      best = &there[i];
    }
    if (!best) break;
    FitSummary next = fit(evaluator, *best, few, found.jacobian);
    if (!(objective(next) < objective(found) - worth_a_fit)) break;
    found = std::move(next);
  }
  return found;
}

}  // namespace pedicel::discrepancy
