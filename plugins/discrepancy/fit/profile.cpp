#include "plugins/discrepancy/fit/profile.h"

#include <algorithm>
#include <cmath>

namespace pedicel::discrepancy {

namespace {

// A deviance goes with the square of the way, so this is 1 % of the half width.
constexpr double close_enough = 0.02;  // of the wanted deviance
constexpr int most_refits = 12;
constexpr double cost_error = 0.01;  // nats a refit may be from its minimum

/// A free parameter held at chosen values, the others refitted.
class Held {
 public:
  Held(ResidualSource& evaluator, const FitSummary& fit, int parameter, const FitOptions& options)
      : evaluator_(evaluator), best_(fit), parameter_(parameter), options_(options) {
    // Differences of costs are what an interval is made of. Fits that end as early as others would
    // give ends that depend on where they gave up.
    options_.least_step = std::min(options.least_step, cost_error);
    const Eigen::VectorXd u = fit.hypothesis.unknowns();
    best_unknown_ = u[parameter];
    best_others_ = others_of(u);
    // How the others go along when this one is moved, to first order. From where they stood best
    // every refit would begin on the side of a valley.
    Eigen::MatrixXd jacobian(fit.jacobian.rows(), u.size() - 1);
    for (int p = 0, column = 0; p < u.size(); ++p)
      if (p != parameter) jacobian.col(column++) = fit.jacobian.col(p);
    slope_ = -least_squares_step(jacobian, fit.jacobian.col(parameter));
    // Derivatives of a simulation that failed. Refits from the best values are slower, not wrong.
    if (!slope_.allFinite()) slope_.setZero();
  }

  // A valley may bend the other way there.
  void other_side() { has_last_ = false; }

  double deviance(double unknown) {
    Hypothesis held = best_.hypothesis;
    // Held by taking it out of what is free: a narrow prior in its place would let it give a
    // little.
    held.set_value(parameter_, held.free[parameter_].to_value(unknown));
    const FreeParameter dropped = held.free[parameter_];
    held.free.erase(held.free.begin() + parameter_);
    held.set_unknowns(guess(unknown));
    FitSummary found = fit(evaluator_, held, options_);
    // Kept whatever came out: the next value lies near by, so this is where its valley is.
    last_unknown_ = unknown;
    last_others_ = found.hypothesis.unknowns();
    has_last_ = true;
    leans_ = false;
    for (const int p : found.at_bound)
      // What has a prior is no sign of it: the prior objects long before the bound does. Nor is
      // what stood at its bound in the best fit, which objected to nothing.
      leans_ = leans_ || (found.hypothesis.free[p].prior <= 0.0 && !leant_already(p));
    const double twice = 2.0 * (objective(found) + prior_of(dropped, unknown) - objective(best_));
    // Below zero the fit was not at its minimum. A little below is where fits end; more is a better
    // fit, and all ends that were measured from the old one are worth nothing.
    if (twice < -close_enough * deviance95 && twice < least_) {
      least_ = twice;
      found.hypothesis.free.insert(found.hypothesis.free.begin() + parameter_, dropped);
      better_ = std::move(found);
    }
    // A root is taken of it.
    return std::max(0.0, twice);
  }

  /// In the last refit another parameter stands at a bound that it does not reach in the best fit:
  /// that bound objects, not the data.
  bool leans() const { return leans_; }

  std::optional<FitSummary> better() { return std::move(better_); }

 private:
  static double prior_of(const FreeParameter& p, double unknown) {
    if (p.prior <= 0.0) return 0.0;
    return 0.5 * std::pow((unknown - p.to_unknown(p.prior_centre)) / p.prior, 2);
  }

  Eigen::VectorXd others_of(const Eigen::VectorXd& u) const {
    Eigen::VectorXd others(u.size() - 1);
    others << u.head(parameter_), u.tail(u.size() - 1 - parameter_);
    return others;
  }

  bool leant_already(int other) const {
    // The others are numbered without this one.
    const int whole = other < parameter_ ? other : other + 1;
    return std::ranges::find(best_.at_bound, whole) != best_.at_bound.end();
  }

  // Where the others should be: along the valley of the last refit, or of the linear model.
  Eigen::VectorXd guess(double unknown) const {
    const double moved = unknown - best_unknown_;
    if (!has_last_ || last_unknown_ == best_unknown_) return best_others_ + moved * slope_;
    return best_others_ + moved / (last_unknown_ - best_unknown_) * (last_others_ - best_others_);
  }

  ResidualSource& evaluator_;
  const FitSummary& best_;
  int parameter_;
  FitOptions options_;
  double best_unknown_ = 0.0, last_unknown_ = 0.0, least_ = 0.0;
  bool has_last_ = false, leans_ = false;
  Eigen::VectorXd best_others_, last_others_, slope_;
  std::optional<FitSummary> better_;
};

}  // namespace

ProfileEnd profile_end(const Deviance& deviance, double best, double bound, double step,
                       double wanted) {
  ProfileEnd end;
  // On roots, because the root of a parabola is straight: one secant hits what bisection needs
  // seven refits for.
  const double side = bound < best ? -1.0 : 1.0, reach = std::abs(bound - best);
  const double root = std::sqrt(wanted);
  double near = 0.0, near_root = 0.0, far = -1.0, far_root = 0.0;
  double away = std::min(std::abs(step), reach);
  while (end.refits < most_refits) {
    // The bound itself and not a sum that rounds to it: beyond it a value would be cut back in
    // silence.
    const double found = std::sqrt(deviance(away < reach ? best + side * away : bound));
    ++end.refits;
    // What was tried last is the end, with its refit: others look at which numbers stood at bounds
    // there.
    if (std::abs(found * found - wanted) < close_enough * wanted) break;
    if (found < root) {
      // At the bound the deviance is still too small: the data object to nothing there.
      if (away >= reach) {
        end.at_bound = true;
        break;
      }
      near = away;
      near_root = found;
    } else {
      far = away;
      far_root = found;
    }
    // Not bracketed yet: on along the line through the origin. At least a tenth farther, so that it
    // gets past the end, and four times at most, because a flat stretch near the best value says
    // little of what comes behind it.
    if (far < 0.0) {
      away *= std::clamp(root / std::max(found, 1.0e-6), 1.1, 4.0);
    } else {
      // Between the two, but never next to either: in a bent valley a secant may stay at one side
      // for ever, and the other would never come nearer.
      const double share = (root - near_root) / (far_root - near_root);
      away = near + std::clamp(share, 0.05, 0.95) * (far - near);
    }
    // Bounds are tried before they are believed: a number may be open up to its own.
    away = std::min(away, reach);
  }
  end.unknown = end.at_bound ? bound : best + side * away;
  return end;
}

double objective(const FitSummary& fit) {
  double sum = fit.cost;
  const Eigen::VectorXd u = fit.hypothesis.unknowns();
  for (int p = 0; p < u.size(); ++p) {
    const FreeParameter& free = fit.hypothesis.free[p];
    if (free.prior > 0.0)
      // Each prior by its own deviation. The fit's spread is left out: each fit sets its own at its
      // start, so that sums with it would not compare.
      sum += 0.5 * std::pow((u[p] - free.to_unknown(free.prior_centre)) / free.prior, 2);
  }
  return sum;
}

Profile profile(ResidualSource& evaluator, const FitSummary& fit, int parameter,
                const FitOptions& options, double wanted) {
  Held held(evaluator, fit, parameter, options);
  const Hypothesis& model = fit.hypothesis;
  const double best = model.unknowns()[parameter];
  const double low = model.low()[parameter], high = model.high()[parameter];
  const double error = fit.standard_error[parameter];
  // Where the linear model has its end. Without an error, a tenth of what is allowed: the data
  // hardly see it, and the bound is the likely end.
  const double step =
      std::isfinite(error) && error > 0.0 ? std::sqrt(wanted) * error : 0.1 * (high - low);
  const Deviance deviance = [&held](double u) { return held.deviance(u); };
  Profile result;
  result.low = profile_end(deviance, best, low, step, wanted);
  // An end where another number meets its bound is told as open: with a wider bound it would lie
  // farther away.
  result.low.at_bound = result.low.at_bound || held.leans();
  held.other_side();
  result.high = profile_end(deviance, best, high, step, wanted);
  result.high.at_bound = result.high.at_bound || held.leans();
  result.better = held.better();
  return result;
}

}  // namespace pedicel::discrepancy
