#include "plugins/discrepancy/select/stalk_strength.h"

#include <ceres/ceres.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "plugins/discrepancy/data/sentence.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {

namespace {

// Three and no more: a dozen breaks cannot tell an exponent of 2 from one of 2.3. An exponent that
// is chosen from a list costs the logarithm of its length. A free one would cost half the logarithm
// of the number of stalks.
constexpr std::array exponents{1.0, 2.0, 3.0};
// Times of steps are multiples of dt, and breaks are read from a file.
constexpr double rounding = 1.0e-9;  // s

double below(double deviations) {
  return 0.5 * std::erfc(-deviations / std::sqrt(2.0));
}

bool is_broken(const StalkLoads& stalk) {
  return std::isfinite(stalk.came_off);
}

// `borne`: the largest load before the window; `reached`: up to the break. What cannot be costs
// much, not all: one break that was recorded wrongly must not refute a law.
// Strength is log-normal about 1, in units of what the stalk bears: it is positive, and half and
// twice are equally far. The probability of a break is that of a strength between what was borne
// and what was reached; that of a stalk that held is that of a larger one than it bore.
double log_likelihood(double borne, double reached, bool broke, double scatter,
                      const Evidence& weights) {
  const auto share = [&](double load) {
    // Without a load there is no logarithm, and nothing breaks.
    return load > 0.0 ? below(std::log(load) / scatter) : 0.0;
  };
  const double probability = broke ? share(reached) - share(borne) : 1.0 - share(borne);
  // Bounded from below: a logarithm of zero would leave the fit nowhere to go, and no other break
  // could outweigh it.
  return std::log(std::max(probability, weights.impossible_break));
}

// Of a stalk's loads those that are the largest under some law: no other one is larger in force,
// moment and torsion alike.
// The Pareto front of the three loads. A law is monotonous in each of them, so its largest load is
// on the front, whatever its scales and exponent are. Fits look at laws a thousand times, and a
// trial has as many rows.
std::vector<StalkNumbers> largest(const StalkLoads& stalk, double until) {
  const auto exceeds = [](const StalkNumbers& a, const StalkNumbers& b) {
    return a[stalk_force] >= b[stalk_force] && a[stalk_moment] >= b[stalk_moment] &&
           a[stalk_torsion] >= b[stalk_torsion];
  };
  std::vector<StalkNumbers> front;
  for (std::size_t row = 0; row < stalk.load.size() && stalk.time[row] <= until + rounding; ++row) {
    const StalkNumbers& load = stalk.load[row];
    // An equal one counts as exceeded, so that a load that is held does not fill the front.
    if (std::ranges::any_of(front, [&](const auto& other) { return exceeds(other, load); }))
      continue;
    std::erase_if(front, [&](const auto& other) { return exceeds(load, other); });
    front.push_back(load);
  }
  return front;
}

// All that a fit needs of a stalk, without its trial.
struct Reading {
  std::vector<StalkNumbers> borne, reached;
  bool broke = false;
};

Reading read(const StalkLoads& stalk, double window) {
  // The window is the time between two looks: the break was some time in it. A stalk that held came
  // off at infinity, and both are its whole trial.
  return {largest(stalk, stalk.came_off - window), largest(stalk, stalk.came_off),
          is_broken(stalk)};
}

double most(const BreakLaw& law, std::span<const StalkNumbers> loads) {
  double most = 0.0;
  for (const StalkNumbers& load : loads) most = std::max(most, law.load(load));
  return most;
}

double log_likelihood(const BreakLaw& law, const Reading& reading, const Evidence& weights) {
  return log_likelihood(most(law, reading.borne), most(law, reading.reached), reading.broke,
                        law.scatter, weights);
}

// The unknowns are logarithms: of the scatter, then of the scales that take part.
// Logarithms keep all of them positive without bounds, and make a factor of two one step
// everywhere.
class Likelihood : public ceres::FirstOrderFunction {
 public:
  Likelihood(const BreakLaw& start, std::vector<Reading> readings, const Evidence& weights)
      : start_(start), readings_(std::move(readings)), weights_(weights) {
    // An infinite scale takes no part, and a law with fewer terms has fewer numbers to pay for.
    for (int i = 0; i < stalk_load_count; ++i)
      if (std::isfinite(start.scale[i])) terms_.push_back(i);
  }

  int NumParameters() const override { return 1 + static_cast<int>(terms_.size()); }
  const std::vector<int>& terms() const { return terms_; }

  Eigen::VectorXd unknowns() const {
    Eigen::VectorXd u(NumParameters());
    u[0] = std::log(start_.scatter);
    for (std::size_t k = 0; k < terms_.size(); ++k) u[k + 1] = std::log(start_.scale[terms_[k]]);
    return u;
  }

  BreakLaw law(const double* u) const {
    BreakLaw law = start_;
    // Our own loads err by some per cent. Without that floor a few breaks that lie on one law by
    // chance would make it certain.
    law.scatter = std::hypot(std::exp(u[0]), weights_.stalk_scatter);
    for (std::size_t k = 0; k < terms_.size(); ++k) law.scale[terms_[k]] = std::exp(u[k + 1]);
    return law;
  }

  double value(const double* u) const {
    const BreakLaw at = law(u);
    double sum = 0.0;
    for (const Reading& reading : readings_) sum += log_likelihood(at, reading, weights_);
    // Keeps a scale that no break asks for, and a scatter that none bounds, within reason.
    double far = 0.0;
    const Eigen::VectorXd from = unknowns();
    // Weak: a factor of e^4 costs half a nat. It only closes directions in which the likelihood is
    // flat.
    for (int i = 0; i < NumParameters(); ++i) far += std::pow((u[i] - from[i]) / 4.0, 2);
    // Ceres minimises, so the sign is turned.
    return 0.5 * far - sum;
  }

  bool Evaluate(const double* u, double* cost, double* gradient) const override {
    *cost = value(u);
    if (!gradient) return true;
    Eigen::VectorXd at = Eigen::Map<const Eigen::VectorXd>(u, NumParameters());
    for (int i = 0; i < NumParameters(); ++i) {
      const double middle = at[i];
      // Differences: a likelihood of a maximum over a front has kinks where another load becomes
      // the largest, and a formula for the slope would have to know of them.
      at[i] = middle + step;
      const double above = value(at.data());
      at[i] = middle - step;
      gradient[i] = (above - value(at.data())) / (2.0 * step);
      at[i] = middle;
    }
    return true;
  }

  // Of a logarithm. Smaller ones drown in the difference of two error functions.
  static constexpr double step = 1.0e-4;

 private:
  BreakLaw start_;
  std::vector<Reading> readings_;
  const Evidence& weights_;
  std::vector<int> terms_;
};

struct Maximum {
  Eigen::VectorXd unknowns;
  double cost = 0.0;
};

Maximum maximise(const Likelihood& likelihood) {
  Maximum found{likelihood.unknowns(), 0.0};
  ceres::GradientProblemSolver::Options options;
  options.logging_type = ceres::SILENT;
  // Far more than a few unknowns take. The bound is for kinks, on which it may go to and fro.
  options.max_num_iterations = 100;
  // A copy is the problem's own.
  const ceres::GradientProblem problem(new Likelihood(likelihood));
  ceres::GradientProblemSolver::Summary summary;
  ceres::Solve(options, problem, found.unknowns.data(), &summary);
  // Computed again and not taken from the summary, since the last step may have been refused.
  found.cost = likelihood.value(found.unknowns.data());
  return found;
}

double median(std::vector<double> values) {
  // The median: one stalk that came off by a knock does not move the start.
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

/// Laws fitted to some of the stalks, which all have the same list of terms to choose from.
class LawFit {
 public:
  LawFit(std::vector<Reading> readings, const Evidence& weights)
      : readings_(std::move(readings)), weights_(weights) {
    for (int i = 0; i < stalk_load_count; ++i) {
      // With a scale of 1 and nothing else the law's load is the load itself.
      BreakLaw alone;  // of the largest ratio
      alone.scale[i] = 1.0;
      std::vector<double> at_break;
      for (const Reading& reading : readings_)
        if (reading.broke) at_break.push_back(most(alone, reading.reached));
      typical_[i] = at_break.empty() ? 0.0 : median(at_break);
    }
  }

  /// Of the terms: a bit each of force, moment and torsion.
  std::optional<FittedLaw> fit(int terms, double exponent) const {
    BreakLaw start;
    start.exponent = exponent;
    int count = 0;
    for (int i = 0; i < 3; ++i)
      if (terms >> i & 1) {
        // No stalk that broke bore any of it: the scale would be anything.
        if (typical_[stalk_force + i] <= 0.0) return {};
        start.scale[stalk_force + i] = typical_[stalk_force + i];
        ++count;
      }
    std::optional<FittedLaw> best;
    // Which of the terms carries most is not known beforehand.
    // Each term once as the one that carries, 1.2 times its typical load, and once as one that
    // matters little, at 3 times. A fit of three terms has as many valleys.
    // Narrow and wide: from a wide scatter a fit may find a law, from a narrow one it sharpens it.
    for (int first = 0; first < std::max(1, count == 1 ? 1 : 1 << count); ++first)
      for (const double scatter : {0.05, 0.3}) {
        BreakLaw from = start;
        from.scatter = scatter;
        for (int i = 0, k = 0; i < 3; ++i)
          if (terms >> i & 1) from.scale[stalk_force + i] *= (first >> k++ & 1) ? 3.0 : 1.2;
        const FittedLaw found = fit(from);
        // By evidence, which for one set of terms is the likelihood but for a constant.
        if (!best || found.evidence > best->evidence) best = found;
      }
    return best;
  }

  FittedLaw fit(const BreakLaw& from) const {
    const Likelihood likelihood(from, readings_, weights_);
    const Maximum found = maximise(likelihood);
    FittedLaw fitted;
    fitted.law = likelihood.law(found.unknowns.data());
    // Without the weak prior of the fit: models are compared by what they say of the events alone.
    for (const Reading& reading : readings_)
      fitted.likelihood += log_likelihood(fitted.law, reading, weights_);
    // Which exponent is one more choice among them.
    const double choices = likelihood.terms().size() > 1 ? std::log(double(exponents.size())) : 0.0;
    // BIC (Schwarz 1978), with a stalk as a sample: breaks are the events, and rows of a trial are
    // not independent.
    fitted.evidence = fitted.likelihood - choices -
                      0.5 * likelihood.NumParameters() * std::log(double(readings_.size()));
    set_errors(likelihood, found.unknowns, fitted);
    // The likelihood takes each break as being anywhere in its window by itself. What is common to
    // all breaks, such as a camera that always sees late, does not average out.
    for (const int term : likelihood.terms())
      fitted.error[term] = std::hypot(fitted.error[term], timing_error(fitted.law));
    return fitted;
  }

  /// Absent where no stalk that broke bore anything.
  std::optional<FittedLaw> best() const {
    std::optional<FittedLaw> best;
    // Seven sets of force, moment and torsion, as bits.
    for (int terms = 1; terms < 8; ++terms)
      for (const double exponent : exponents) {
        // A power of two: one bit. Of one term any exponent gives the same law, and it is counted
        // once.
        const bool alone = (terms & (terms - 1)) == 0;
        if (alone && exponent != 2.0) continue;  // of one term it says nothing
        const std::optional<FittedLaw> found = fit(terms, exponent);
        if (found && (!best || found->evidence > best->evidence)) best = found;
      }
    return best;
  }

 private:
  // By the curvature of the likelihood, from differences of its gradient.
  static void set_errors(const Likelihood& likelihood, const Eigen::VectorXd& at,
                         FittedLaw& fitted) {
    const int n = likelihood.NumParameters();
    // Longer than the step of the gradient, whose own noise would else be all of the curvature.
    constexpr double step = 1.0e-2;
    Eigen::MatrixXd hessian(n, n);
    Eigen::VectorXd above(n), below_it(n);
    double cost = 0.0;
    for (int i = 0; i < n; ++i) {
      Eigen::VectorXd u = at;
      u[i] += step;
      likelihood.Evaluate(u.data(), &cost, above.data());
      u[i] -= 2.0 * step;
      likelihood.Evaluate(u.data(), &cost, below_it.data());
      hessian.col(i) = (above - below_it) / (2.0 * step);
    }
    // Differences leave it a little unsymmetric. Directions that are flat get no error from here,
    // and none is told of a scale that the data do not see.
    const Eigen::MatrixXd covariance =
        (0.5 * (hessian + hessian.transpose())).completeOrthogonalDecomposition().pseudoInverse();
    for (std::size_t k = 0; k < likelihood.terms().size(); ++k)
      fitted.error[likelihood.terms()[k]] = std::sqrt(std::max(0.0, covariance(k + 1, k + 1)));
  }

  // How late in their windows breaks happen may be the same for all of them: half of what the load
  // gains in one, as the deviation of an even distribution.
  double timing_error(const BreakLaw& law) const {
    double sum = 0.0;
    int count = 0;
    for (const Reading& reading : readings_) {
      const double borne = most(law, reading.borne);
      if (!reading.broke || borne <= 0.0) continue;
      sum += 0.5 * std::log(most(law, reading.reached) / borne);
      ++count;
    }
    // An even distribution of half-width a has the deviation a / sqrt(3).
    return count > 0 ? sum / count / std::sqrt(3.0) : 0.0;
  }

  std::vector<Reading> readings_;
  const Evidence& weights_;
  StalkNumbers typical_{};  // median at the breaks
};

// What a stalk's own threshold says of it.
struct Against {
  double borne = 0.0, reached = 0.0;
  bool broke = false;
};

// Thresholds are known, and our loads right, to a common factor.
// The plant file's thresholds are the model to beat, and not a model without any: they are what a
// simulation would go on with.
struct ThresholdModel {
  const Evidence* weights;
  double scatter, factor = 1.0;
  double likelihood(const Against& one) const {
    return log_likelihood(factor * one.borne, factor * one.reached, one.broke, scatter, *weights);
  }
  double likelihood(const std::vector<Against>& all) const {
    // A prior and no free number: thresholds that are 10 % off together are no finding. So a law
    // must explain more than a common factor does.
    double sum = -0.5 * std::pow(std::log(factor) / weights->threshold_error, 2);
    for (const Against& one : all) sum += likelihood(one);
    return sum;
  }
};

// The likeliest scatter and factor.
ThresholdModel likeliest(const std::vector<Against>& all, const Evidence& weights) {
  ThresholdModel best{&weights, weights.stalk_scatter};
  double most = best.likelihood(all);
  // A grid, since there are two numbers only: it cannot end in a wrong valley, and it is what a law
  // is compared with.
  for (double scatter = weights.stalk_scatter; scatter < 3.0; scatter *= 1.1)
    for (double factor = 0.7; factor < 1.45; factor *= 1.01) {
      const ThresholdModel tried{&weights, scatter, factor};
      const double found = tried.likelihood(all);
      if (found > most) most = found, best = tried;
    }
  return best;
}

// Each stalk by what the others say, with the terms and the exponent of the law found.
// Each stalk by itself is left out, because a law with as many scales as breaks follows all of
// them. Terms and exponent stay, so that each fit is short; the evidence has paid for their choice.
double foretold_by_others(const BreakLaw& law, const std::vector<Reading>& readings,
                          const std::vector<Against>& thresholds, const Evidence& weights) {
  double gain = 0.0;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    std::vector<Reading> others = readings;
    others.erase(others.begin() + i);
    std::vector<Against> without = thresholds;
    without.erase(without.begin() + i);
    // Both sides are fitted to the same others: the thresholds, too, have a scatter and a factor
    // that must not have seen the stalk.
    gain += log_likelihood(LawFit(others, weights).fit(law).law, readings[i], weights) -
            likeliest(without, weights).likelihood(thresholds[i]);
  }
  return gain;
}

}  // namespace

// The p-norm of the ratios. Its value is linear in the load at fixed ratios, so strengths of
// different laws are in one unit, and the sum to the p-th power of the effect's own law is 1
// exactly where this is 1.
double BreakLaw::load(const StalkNumbers& given) const {
  double result = 0.0;
  if (std::isinf(exponent)) {
    for (int i = 0; i < stalk_load_count; ++i) result = std::max(result, given[i] / scale[i]);
    return result;
  }
  // Strains take part in thresholds only: the effect has no scale for them.
  for (const int i : {stalk_force, stalk_moment, stalk_torsion})
    result += std::pow(given[i] / scale[i], exponent);
  return std::pow(result, 1.0 / exponent);
}

double BreakLaw::most(const StalkLoads& stalk, double until) const {
  double most = 0.0;
  for (std::size_t row = 0; row < stalk.load.size() && stalk.time[row] <= until + rounding; ++row)
    most = std::max(most, load(stalk.load[row]));
  return most;
}

BreakLaw break_law_of(const plant::PlantFile& plant, const plant::PlantFruit& fruit) {
  BreakLaw law;
  // What the file leaves out stays infinite, and never breaks anything.
  for (int i = 0; i < stalk_load_count; ++i)
    if (const auto limit = number_of(fruit.detach, plant::detach_keys[i])) law.scale[i] = *limit;
  for (const plant::Effect& effect : plant.effects) {
    const effects::EffectDefinition* known = effects::find_effect(effect.name);
    const bool meant = !effect.place || effect.place->curve == fruit.place.curve;
    if (!known || known->home != effects::Home::stalk || !meant) continue;
    // A law takes the place of all thresholds of its fruits, as it does in a simulation.
    law = BreakLaw();
    for (int i = stalk_force; i < stalk_load_count; ++i)
      if (const std::string name(stalk_limits[i].name); effect.numbers.contains(name))
        law.scale[i] = effect.number(name);
    const auto own = effect.numbers.find("exponents");
    law.exponent = own == effect.numbers.end()
                       ? 2.0
                       : *std::max_element(own->second.begin(), own->second.end());
  }
  return law;
}

bool StalkStrength::needs_law() const {
  // Both: evidence may come from one group of breaks, and foretelling alone may be a small gain by
  // chance.
  return law && evidence > levels.outside_evidence && foretold > 0.0;
}

std::string StalkStrength::sentence() const {
  // Of those that broke only. What held says nothing in this sentence of how far the thresholds are
  // off.
  double least = std::numeric_limits<double>::infinity(), largest_load = 0.0;
  for (std::size_t i = 0; i < stalks.size(); ++i) {
    if (!is_broken(stalks[i])) continue;
    const double load = thresholds[i].most(stalks[i], stalks[i].came_off);
    least = std::min(least, load);
    largest_load = std::max(largest_load, load);
  }
  // No threshold in the file, or none that these loads touch.
  if (largest_load == 0.0)
    return text("%g fruits came off, and by the plant file's thresholds none does.", broken);
  return text("%g fruits came off at %.2g", broken, least) +
         text(" to %.2g times the load at which the plant file's thresholds take them off",
              largest_load) +
         (law ? text(" (scatter %.2g); about the law that fits best they scatter by %.2g.", scatter,
                     law->law.scatter)
              : ".");
}

std::string StalkStrength::summary() const {
  if (broken < levels.broken_stalks)
    return sentence() + text(" That is too few for a law: %g are needed.", levels.broken_stalks);
  if (!law) return sentence() + " By the model their stalks bore nothing.";
  return sentence() +
         text(
             " The events speak for it by %.3g nats, and by %.3g where each is predicted by the "
             "others.",
             evidence, foretold);
}

StalkStrength judge_strength(std::vector<StalkLoads> stalks, std::vector<BreakLaw> thresholds,
                             double window, const DiagnosisSettings& settings) {
  StalkStrength strength;
  strength.levels = settings.levels;
  strength.stalks = std::move(stalks);
  strength.thresholds = std::move(thresholds);
  std::vector<Reading> readings;
  std::vector<Against> against;
  for (std::size_t i = 0; i < strength.stalks.size(); ++i) {
    const StalkLoads& stalk = strength.stalks[i];
    const BreakLaw& threshold = strength.thresholds[i];
    readings.push_back(read(stalk, window));
    against.push_back({threshold.most(stalk, stalk.came_off - window),
                       threshold.most(stalk, stalk.came_off), is_broken(stalk)});
    if (is_broken(stalk)) ++strength.broken;
  }
  // A law has up to four numbers.
  if (strength.broken < settings.levels.broken_stalks) return strength;
  const ThresholdModel thresholds_at_best = likeliest(against, settings.evidence);
  strength.scatter = thresholds_at_best.scatter;
  // One free number, the scatter. The factor has paid by its prior.
  const double without =
      thresholds_at_best.likelihood(against) - 0.5 * std::log(double(readings.size()));
  strength.law = LawFit(readings, settings.evidence).best();
  if (!strength.law) return strength;
  strength.evidence = strength.law->evidence - without;
  // Only where it may be named: this takes a fit for each stalk.
  if (strength.evidence > settings.levels.outside_evidence)
    strength.foretold = foretold_by_others(strength.law->law, readings, against, settings.evidence);
  return strength;
}

}  // namespace pedicel::discrepancy
