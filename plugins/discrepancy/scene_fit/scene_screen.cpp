#include "plugins/discrepancy/scene_fit/scene_screen.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "plugins/discrepancy/scene_fit/plant_causes.h"

namespace pedicel::discrepancy {

namespace {

// Two batches of the solver's eight lanes.
constexpr std::size_t most_at_once = 16;  // models, whose readings are all kept

/// One start of a cause and the models that tell of it.
struct Start {
  std::string name;
  const FitSummary* base = nullptr;
  SceneFit fit;
  Hypothesis model;  // the base and the cause
  bool vanishes = false;
  bool is_bare = false;    // without derivatives: what it changes as a whole is all that is known
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
  Screen(SceneEvaluator& evaluator, const FitSummary& base, const std::vector<int>& trials)
      : evaluator_(evaluator), base_(base), options_(evaluator.options(trials)) {}

  void add(const std::string& name, const SceneFit& fit) {
    Start start = begun(base_, name, fit);
    differentiate(start);
    starts_.push_back(std::move(start));
  }

  /// The same without derivatives, which only those get that promise most once all are simulated.
  void add_bare(const std::string& name, const SceneFit& fit) {
    Start start = begun(base_, name, fit);
    start.is_bare = true;
    if (start.at < 0) differentiate(start);
    starts_.push_back(std::move(start));
  }

  std::vector<ScreenedCause> run(std::vector<SeenFrom>* seen) {
    simulate_rest();
    differentiate_best();
    simulate_rest();
    // Every start by itself: which one of a cause stands for it is decided by whoever refits.
    std::vector<ScreenedCause> screened;
    for (const Start& start : starts_) {
      if (!start.moved.empty()) screened.push_back(judged(start));
      if (seen && start.base == &base_) keep_clearest(*seen, seen_from(start));
    }
    // Stable, so that ties go by the order of the definitions and verdicts repeat.
    std::ranges::stable_sort(screened, {}, &ScreenedCause::linear_cost);
    return screened;
  }

 private:
  Start begun(const FitSummary& base, const std::string& name, const SceneFit& fit) {
    Start start;
    start.name = name;
    start.base = &base;
    start.fit = fit;
    start.model = base.hypothesis;
    // On top of all that the base has, whose numbers stay free beside it.
    Hypothesis added;
    added.effects = {fit.effect};
    added.free = fit.free;
    start.model.add(added);
    start.vanishes = does_nothing(fit);
    // A start that does nothing has the residual of the base, which is known.
    if (!start.vanishes) start.at = want(start.model);
    return start;
  }

  void differentiate(Start& start) {
    start.is_bare = false;
    const Eigen::VectorXd u = start.model.unknowns(), high = start.model.high();
    // The base's own numbers were differentiated with it, once for all causes.
    for (int p = start.base->hypothesis.size(); p < start.model.size(); ++p) {
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
  }

  // What is wanted and was not simulated before.
  void simulate_rest() {
    const long known = all_.cols();
    all_.conservativeResize(base_.residual.size(), static_cast<long>(wanted_.size()));
    // In parts, as readings of a long trial with cameras take megabytes a model.
    for (auto first = static_cast<std::size_t>(known); first < wanted_.size();
         first += most_at_once) {
      const std::size_t count = std::min(most_at_once, wanted_.size() - first);
      all_.middleCols(static_cast<long>(first), static_cast<long>(count)) =
          evaluator_.residuals(std::span(wanted_).subspan(first, count), options_);
    }
  }

  // A plant's own effects have some ninety starts, whose derivatives would be three hundred
  // simulations of every trial. So each is simulated once, and is worth what it takes at its best
  // size, of the same shape as at the start. Only the best are differentiated.
  void differentiate_best() {
    std::multimap<double, std::size_t> by_cost;
    for (std::size_t s = 0; s < starts_.size(); ++s)
      if (starts_[s].is_bare) by_cost.emplace(cost_by_size(all_.col(starts_[s].at)), s);
    const SceneSearchSettings& how = evaluator_.settings().search;
    std::map<std::string, int> of_cause;
    std::vector<std::size_t> best;
    for (const auto& [cost, s] : by_cost)
      if (static_cast<int>(best.size()) < how.plant_starts &&
          of_cause[starts_[s].name]++ < how.starts_of_each)
        best.push_back(s);
    for (const std::size_t s : best) differentiate(starts_[s]);
    if (!best.empty() && has_left_files()) begin_at_files(best);
  }

  // Modulus, density and damping take over much of what a plant does besides: of a soft root a fit
  // makes a modulus of a third, and from there the linear does not find the way back. So effects of
  // plants are begun where these are what the files say, too.
  void begin_at_files(const std::vector<std::size_t>& best) {
    Hypothesis model = base_.hypothesis;
    for (const effects::EffectDefinition* factor : effects::material_factors())
      if (const int p = model.factor_on(factor->name); p >= 0) model.set_value(p, 1.0);
    files_ = look_at(evaluator_, model, options_);
    // Starts are small, and a root that is softer than its stem is far from them: each is looked at
    // in other sizes, and differentiated in the best.
    std::vector<std::vector<Start>> sizes;
    for (const std::size_t s : best) {
      std::vector<Start>& all = sizes.emplace_back();
      for (const double size : {1.0, 3.0, 9.0}) {
        Start start = begun(files_, starts_[s].name, sized(starts_[s].fit, size));
        // What does nothing would leave what the files leave.
        if (start.at >= 0) all.push_back(std::move(start));
      }
    }
    simulate_rest();
    for (std::vector<Start>& all : sizes) {
      if (all.empty()) continue;
      const auto left = [&](const Start& start) {
        return without(files_, all_.col(start.at)).squaredNorm();
      };
      Start& start = *std::ranges::min_element(all, {}, left);
      differentiate(start);
      starts_.push_back(std::move(start));
    }
  }

  static SceneFit sized(const SceneFit& fit, double size) {
    Hypothesis own;
    own.effects = {fit.effect};
    own.free = fit.free;
    return {own.shrunk(size).bounded().effects.front(), fit.free};
  }

  bool has_left_files() const {
    const double far = evaluator_.settings().search.left_files;
    return std::ranges::any_of(
        effects::material_factors(), [&](const effects::EffectDefinition* factor) {
          const int p = base_.hypothesis.factor_on(factor->name);
          return p >= 0 && std::abs(std::log(base_.hypothesis.value(p))) > far;
        });
  }

  // What is left where the base's numbers and the size of a change are free.
  double cost_by_size(const Eigen::VectorXd& there) const {
    const Eigen::VectorXd change = without(base_, base_.residual - there);
    const Eigen::VectorXd left = without(base_, base_.residual);
    const double square = change.squaredNorm();
    // The other way round it would be another effect.
    const double size = square > 0.0 ? std::max(0.0, change.dot(left) / square) : 0.0;
    return 0.5 * (left - size * change).squaredNorm();
  }

  int want(const Hypothesis& model) {
    wanted_.push_back(model);
    return static_cast<int>(wanted_.size()) - 1;
  }

  ScreenedCause judged(const Start& start) const {
    const FitSummary& base = *start.base;
    const Eigen::VectorXd here = start.at < 0 ? base.residual : Eigen::VectorXd(all_.col(start.at));
    const long own = static_cast<long>(start.moved.size()), old = base.jacobian.cols();
    Eigen::MatrixXd jacobian(here.size(), old + own);
    // Taken at the base. What a start of some size changes of it is left out. Its own derivatives
    // would be as many simulations again for each start.
    jacobian.leftCols(old) = base.jacobian;
    for (long p = 0; p < own; ++p)
      jacobian.col(old + p) = (here - all_.col(start.moved[static_cast<std::size_t>(p)])) /
                              start.step[static_cast<std::size_t>(p)];
    ScreenedCause out;
    out.name = start.name;
    out.model = start.model;
    out.begun = base.hypothesis.unknowns();
    // Of all numbers together. A cause whose own numbers take the whole residual, with the base
    // held, would win against one that the base makes room for.
    const Eigen::VectorXd step = linear_step(here, jacobian, start.model, out.linear_cost);
    const Eigen::VectorXd u = start.model.unknowns() + step;
    // A linear step may leave the bounds, and a fit may not begin there.
    out.model.set_unknowns(u.cwiseMax(start.model.low()).cwiseMin(start.model.high()));
    return out;
  }

  // What is left of a change beyond what a base's own numbers can make.
  static Eigen::VectorXd without(const FitSummary& base, const Eigen::VectorXd& change) {
    const Eigen::MatrixXd& j = base.jacobian;
    Eigen::VectorXd left = change;
    if (j.cols() > 0) {
      Eigen::MatrixXd normal = j.transpose() * j;
      for (long p = 0; p < j.cols(); ++p) {
        // With what is known of them: a density may not go anywhere to imitate a payload.
        const double width = base.hypothesis.free[static_cast<std::size_t>(p)].width();
        normal(p, p) += 1.0 / (width * width);
      }
      // What the baseline's numbers can imitate is not seen, however large it is.
      left -= j * normal.ldlt().solve(j.transpose() * change);
    }
    return left;
  }

  // Noise units RMS, the unit in which misfits are told, so that one is compared with the other.
  double clear_of_base(const Eigen::VectorXd& change) const {
    return without(base_, change).norm() /
           std::sqrt(std::max(1.0, static_cast<double>(base_.misfit().count)));
  }

  SeenFrom seen_from(const Start& start) const {
    SeenFrom out;
    out.name = start.name;
    const int old = base_.hypothesis.size();
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
      const double value = start.model.value(p);
      double way = 0.0;
      Eigen::VectorXd change;
      // Where the start does nothing a step from there is its size. Elsewhere the start as a whole
      // is.
      if (start.at < 0) {
        const double step = start.step[static_cast<std::size_t>(p - old)];
        change = base_.residual - all_.col(start.moved[static_cast<std::size_t>(p - old)]);
        way = free.logarithmic ? std::abs(step) : std::abs(free.scale * step);
      } else {
        change = base_.residual - all_.col(start.at);
        using effects::Vanishes;
        // In the way in which it grows: a factor by its logarithm, a stiffness by its inverse. So a
        // size may be scaled to what is just seen.
        way = free.vanishes == Vanishes::at_zero       ? std::abs(value)
              : free.vanishes == Vanishes::at_one      ? std::abs(std::log(value))
              : free.vanishes == Vanishes::at_infinity ? 1.0 / value
                                                       : std::abs(value - free.nominal);
      }
      // A component that is zero where the start has others says nothing of how large it would be.
      if (const double size = clear_of_base(change); size > 0.0 && way > 0.0)
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
  const FitSummary& base_;
  FitSummary files_;  // of the base's model with the files' own material
  FitOptions options_;
  std::vector<Hypothesis> wanted_;
  Eigen::MatrixXd all_;  // residuals of what is wanted
  std::vector<Start> starts_;
};

}  // namespace

double SeenFrom::size(double noise_units) const {
  const double way = a_unit * noise_units;
  // Back from the way in which it grows. The sizes are told upwards, a factor above 1.
  if (vanishes == effects::Vanishes::at_one) return std::exp(way);
  return vanishes == effects::Vanishes::at_infinity ? 1.0 / way : way;
}

std::vector<ScreenedCause> screen_causes(SceneEvaluator& evaluator, const FitSummary& base,
                                         const std::vector<std::string>& has,
                                         const std::vector<int>& trials,
                                         std::vector<SeenFrom>* seen) {
  Screen screen(evaluator, base, trials);
  const Experiment& experiment = evaluator.simulator().experiment();
  for (const SceneEffectDefinition& definition : scene_effect_definitions()) {
    // Twice the same cause would be one with more numbers.
    if (std::ranges::find(has, definition.name) != has.end()) continue;
    // All starts of all causes, with each joint, camera and sensor: which of them it is nobody
    // knows yet.
    for (const SceneFit& start : starts_of(definition, {experiment, evaluator.settings()})) {
      // An unseen plant's place is in the base already. By its words as well: the place of another
      // plant is another thing.
      const bool in_base =
          std::ranges::any_of(base.hypothesis.effects, [&](const plant::Effect& one) {
            return one.name == start.effect.name && one.words == start.effect.words;
          });
      if (!in_base) screen.add(definition.name, start);
    }
  }
  // Where no cause could gain enough, ninety more simulations of each trial would tell nothing but
  // detectable limits of plants' own effects.
  const double excess = SceneDataSet::beyond_noise(base.misfit());
  if (excess * excess < evaluator.settings().search.least_gain) return screen.run(seen);
  for (const SceneFit& start : plant_starts(experiment, base.hypothesis.effects))
    if (std::ranges::find(has, start.effect.name) == has.end())
      screen.add_bare(start.effect.name, start);
  return screen.run(seen);
}

}  // namespace pedicel::discrepancy
