#include "plugins/discrepancy/scene_fit/scene_screen.h"

#include <algorithm>
#include <cmath>

namespace pedicel::discrepancy {

namespace {

// Two batches of the solver's eight lanes.
constexpr std::size_t most_at_once = 16;  // models, whose readings are all kept

/// One start of a cause and the models that tell of it.
struct Start {
  std::string name;
  Hypothesis model;  // the base and the cause
  bool vanishes = false;
  int at = -1;             // index of its residual; -1: that of the base
  std::vector<int> moved;  // of the residuals with one number moved
  std::vector<double> step;
};

// Where all its numbers stand at their vanishing values. Then the base's residual is its own, and a
// simulation is saved.
bool does_nothing(const SceneFit& start) {
  return std::ranges::all_of(start.free, [&](const effects::FreeParameter& free) {
    // A place or a direction is not among the numbers.
    // So it has to be simulated where it stands.
    if (free.vanishes == effects::Vanishes::never) return false;
    const double value =
        start.effect.numbers.at(free.name)[static_cast<std::size_t>(free.component)];
    return (free.vanishes == effects::Vanishes::at_zero && value == 0.0) ||
           (free.vanishes == effects::Vanishes::at_one && value == 1.0);
  });
}

// Least squares in which no number goes farther than its own scale goes a few times.
Eigen::VectorXd linear_step(const Eigen::VectorXd& residual, const Eigen::MatrixXd& jacobian,
                            const Hypothesis& model, double& left) {
  const long n = jacobian.cols();
  Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
  const Eigen::VectorXd right = jacobian.transpose() * residual;
  for (long p = 0; p < n; ++p) {
    // What is known beforehand holds the step. Where two causes nearly do the same, least squares
    // alone would go far with both, against each other.
    const double width = model.free[static_cast<std::size_t>(p)].width();
    // A contact that is not touched has no derivative, and its step would be infinite.
    normal(p, p) += 1.0 / (width * width) + 1.0e-9;
  }
  // Of the base's numbers, too: a cause is worth what they cannot do without it.
  const Eigen::VectorXd step = normal.ldlt().solve(right);
  // Of the data alone: what the step costs of what is known is not a part of what is left.
  left = 0.5 * (residual - jacobian * step).squaredNorm();
  return step;
}

class Screen {
 public:
  Screen(SceneEvaluator& evaluator, const SceneFitResult& base, std::span<const int> trials)
      : evaluator_(evaluator), base_(base), trials_(trials) {}

  void add(const std::string& name, const SceneFit& fit) {
    Start start;
    start.name = name;
    start.model = base_.model;
    // On top of all that the base has, whose numbers stay free beside it.
    Hypothesis added;
    added.effects = {fit.effect};
    added.free = fit.free;
    start.model.add(added);
    start.vanishes = does_nothing(fit);
    // A start that does nothing has the residual of the base, which is known.
    if (!start.vanishes) start.at = want(start.model);
    const Eigen::VectorXd u = start.model.unknowns(), high = start.model.high();
    // The base's own numbers were differentiated with it, once for all causes.
    for (int p = base_.model.size(); p < start.model.size(); ++p) {
      // A part of what is known: derivatives of contacts need more than a trifle.
      const SceneFitSettings& how = evaluator_.settings().fit;
      double step = start.model.free[static_cast<std::size_t>(p)].logarithmic
                        ? how.screen_factor_step
                        : how.screen_step;
      // Inwards of the bounds: beyond them a model may not be simulated at all.
      if (u[p] + step > high[p]) step = -step;
      Eigen::VectorXd moved = u;
      moved[p] += step;
      Hypothesis other = start.model;
      other.set_unknowns(moved);
      // Asked for here and simulated later, all causes together, so that the solver's lanes are
      // full.
      start.moved.push_back(want(other));
      start.step.push_back(step);
    }
    starts_.push_back(std::move(start));
  }

  std::vector<ScreenedCause> run(std::vector<SeenFrom>* seen) {
    Eigen::MatrixXd all(base_.residual.size(), static_cast<long>(wanted_.size()));
    // In parts, as readings of a long trial with cameras take megabytes a model.
    for (std::size_t first = 0; first < wanted_.size(); first += most_at_once) {
      const std::size_t count = std::min(most_at_once, wanted_.size() - first);
      all.middleCols(static_cast<long>(first), static_cast<long>(count)) =
          evaluator_.residuals(std::span(wanted_).subspan(first, count), trials_);
    }
    // Every start by itself: which one of a cause stands for it is decided by whoever refits.
    std::vector<ScreenedCause> screened;
    for (const Start& start : starts_) {
      screened.push_back(judged(start, all));
      if (seen) keep_clearest(*seen, seen_from(start, all));
    }
    // Stable, so that ties go by the order of the definitions and verdicts repeat.
    std::ranges::stable_sort(screened, {}, &ScreenedCause::linear_cost);
    return screened;
  }

 private:
  int want(const Hypothesis& model) {
    wanted_.push_back(model);
    return static_cast<int>(wanted_.size()) - 1;
  }

  ScreenedCause judged(const Start& start, const Eigen::MatrixXd& all) const {
    const Eigen::VectorXd here = start.at < 0 ? base_.residual : Eigen::VectorXd(all.col(start.at));
    const long own = static_cast<long>(start.moved.size()), old = base_.jacobian.cols();
    Eigen::MatrixXd jacobian(here.size(), old + own);
    // Taken at the base. What a start of some size changes of it is left out. Its own derivatives
    // would be as many simulations again for each start.
    jacobian.leftCols(old) = base_.jacobian;
    for (long p = 0; p < own; ++p)
      jacobian.col(old + p) = (here - all.col(start.moved[static_cast<std::size_t>(p)])) /
                              start.step[static_cast<std::size_t>(p)];
    ScreenedCause out;
    out.name = start.name;
    out.model = start.model;
    // Of all numbers together. A cause whose own numbers take the whole residual, with the base
    // held, would win against one that the base makes room for.
    const Eigen::VectorXd step = linear_step(here, jacobian, start.model, out.linear_cost);
    const Eigen::VectorXd u = start.model.unknowns() + step;
    // A linear step may leave the bounds, and a fit may not begin there.
    out.model.set_unknowns(u.cwiseMax(start.model.low()).cwiseMin(start.model.high()));
    return out;
  }

  // Noise units RMS that a change makes beyond what the base's own numbers can make.
  double clear_of_base(const Eigen::VectorXd& change) const {
    const Eigen::MatrixXd& j = base_.jacobian;
    Eigen::VectorXd left = change;
    if (j.cols() > 0) {
      Eigen::MatrixXd normal = j.transpose() * j;
      for (long p = 0; p < j.cols(); ++p) {
        // With what is known of them: a density may not go anywhere to imitate a payload.
        const double width = base_.model.free[static_cast<std::size_t>(p)].width();
        normal(p, p) += 1.0 / (width * width);
      }
      // What the baseline's numbers can imitate is not seen, however large it is.
      left -= j * normal.ldlt().solve(j.transpose() * change);
    }
    // In the unit in which misfits are told, so that one is compared with the other.
    return left.norm() / std::sqrt(std::max(1.0, static_cast<double>(base_.sum.count)));
  }

  SeenFrom seen_from(const Start& start, const Eigen::MatrixXd& all) const {
    SeenFrom out;
    out.name = start.name;
    const int old = base_.model.size();
    for (int p = old; p < start.model.size(); ++p) {
      const effects::FreeParameter& free = start.model.free[static_cast<std::size_t>(p)];
      // Only numbers with a value at which the cause is gone have a size.
      if (free.vanishes == effects::Vanishes::never) continue;
      // The first of its numbers that has a size stands for the cause.
      if (out.parameter.empty()) {
        out.parameter = free.name;
        out.unit = free.unit;
        out.vanishes = free.vanishes;
        out.nominal = free.nominal;
      }
      // Others of its numbers have other units, and say little by themselves.
      if (free.name != out.parameter) continue;
      const double step = start.step[static_cast<std::size_t>(p - old)];
      const double value = start.model.value(p);
      double way = 0.0;
      Eigen::VectorXd change;
      // Where the start does nothing a step from there is its size. Elsewhere the start as a whole
      // is.
      if (start.at < 0) {
        change = base_.residual - all.col(start.moved[static_cast<std::size_t>(p - old)]);
        way = free.logarithmic ? std::abs(step) : std::abs(free.scale * step);
      } else {
        change = base_.residual - all.col(start.at);
        using effects::Vanishes;
        // In the way in which it grows: a factor by its logarithm, a stiffness by its inverse. So a
        // size may be scaled to what is just seen.
        way = free.vanishes == Vanishes::at_zero       ? std::abs(value)
              : free.vanishes == Vanishes::at_one      ? std::abs(std::log(value))
              : free.vanishes == Vanishes::at_infinity ? 1.0 / value
                                                       : std::abs(value - free.nominal);
      }
      if (const double size = clear_of_base(change); size > 0.0)
        // Of a vector the clearest component stands for it.
        out.a_unit = std::min(out.a_unit, way / size);
    }
    return out;
  }

  // Of several starts the one that shows most. A size is told once for a cause, by the start that
  // would be noticed first.
  static void keep_clearest(std::vector<SeenFrom>& seen, const SeenFrom& one) {
    const auto known = std::ranges::find(seen, one.name, &SeenFrom::name);
    if (known == seen.end())
      seen.push_back(one);
    else if (one.a_unit < known->a_unit)
      *known = one;
  }

  SceneEvaluator& evaluator_;
  const SceneFitResult& base_;
  std::span<const int> trials_;
  std::vector<Hypothesis> wanted_;
  std::vector<Start> starts_;
};

}  // namespace

double SeenFrom::size(double noise_units) const {
  const double way = a_unit * noise_units;
  // Back from the way in which it grows. The sizes are told upwards, a factor above 1.
  if (vanishes == effects::Vanishes::at_one) return std::exp(way);
  return vanishes == effects::Vanishes::at_infinity ? 1.0 / way : way;
}

std::vector<ScreenedCause> screen_causes(SceneEvaluator& evaluator, const SceneFitResult& base,
                                         const std::vector<std::string>& has,
                                         std::span<const int> trials, std::vector<SeenFrom>* seen) {
  Screen screen(evaluator, base, trials);
  const SceneExperiment& experiment = evaluator.simulator().experiment();
  for (const SceneEffectDefinition& definition : scene_effect_definitions()) {
    // Twice the same cause would be one with more numbers.
    if (std::ranges::find(has, definition.name) != has.end()) continue;
    // All starts of all causes, with each joint, camera and sensor: which of them it is nobody
    // knows yet.
    for (const SceneFit& start : starts_of(definition, {experiment, evaluator.settings()})) {
      // An unseen plant's place is in the base already. By its words as well: the place of another
      // plant is another thing.
      const bool in_base = std::ranges::any_of(base.model.effects, [&](const plant::Effect& one) {
        return one.name == start.effect.name && one.words == start.effect.words;
      });
      if (!in_base) screen.add(definition.name, start);
    }
  }
  return screen.run(seen);
}

}  // namespace pedicel::discrepancy
