#include "pedicel/discrepancy/select/stalk_strength.h"

#include <ceres/ceres.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "pedicel/discrepancy/data/sentence.h"

namespace pedicel::discrepancy {

namespace {

constexpr std::array exponents{1.0, 2.0, 3.0};
constexpr double rounding = 1.0e-9;  // s

double below(double deviations) {
  return 0.5 * std::erfc(-deviations / std::sqrt(2.0));
}

bool is_broken(const StalkLoads& stalk) {
  return std::isfinite(stalk.came_off);
}

// `borne`: the largest load before the window; `reached`: up to the break. What cannot be costs
// much, not all: one break that was recorded wrongly must not refute a law.
double log_likelihood(double borne, double reached, bool broke, double scatter,
                      const Evidence& weights) {
  const auto share = [&](double load) {
    return load > 0.0 ? below(std::log(load) / scatter) : 0.0;
  };
  const double probability = broke ? share(reached) - share(borne) : 1.0 - share(borne);
  return std::log(std::max(probability, weights.impossible_break));
}

// Of a stalk's loads those that are the largest under some law: no other one is larger in force,
// moment and torsion alike.
std::vector<StalkNumbers> largest(const StalkLoads& stalk, double until) {
  const auto exceeds = [](const StalkNumbers& a, const StalkNumbers& b) {
    return a[stalk_force] >= b[stalk_force] && a[stalk_moment] >= b[stalk_moment] &&
           a[stalk_torsion] >= b[stalk_torsion];
  };
  std::vector<StalkNumbers> front;
  for (std::size_t row = 0; row < stalk.load.size() && stalk.time[row] <= until + rounding; ++row) {
    const StalkNumbers& load = stalk.load[row];
    if (std::ranges::any_of(front, [&](const auto& other) { return exceeds(other, load); }))
      continue;
    std::erase_if(front, [&](const auto& other) { return exceeds(load, other); });
    front.push_back(load);
  }
  return front;
}

struct Reading {
  std::vector<StalkNumbers> borne, reached;
  bool broke = false;
};

Reading read(const StalkLoads& stalk, double window) {
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
class Likelihood : public ceres::FirstOrderFunction {
 public:
  Likelihood(const BreakLaw& start, std::vector<Reading> readings, const Evidence& weights)
      : start_(start), readings_(std::move(readings)), weights_(weights) {
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
    for (int i = 0; i < NumParameters(); ++i) far += std::pow((u[i] - from[i]) / 4.0, 2);
    return 0.5 * far - sum;
  }

  bool Evaluate(const double* u, double* cost, double* gradient) const override {
    *cost = value(u);
    if (!gradient) return true;
    Eigen::VectorXd at = Eigen::Map<const Eigen::VectorXd>(u, NumParameters());
    for (int i = 0; i < NumParameters(); ++i) {
      const double middle = at[i];
      at[i] = middle + step;
      const double above = value(at.data());
      at[i] = middle - step;
      gradient[i] = (above - value(at.data())) / (2.0 * step);
      at[i] = middle;
    }
    return true;
  }

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
  options.max_num_iterations = 100;
  // A copy is the problem's own.
  const ceres::GradientProblem problem(new Likelihood(likelihood));
  ceres::GradientProblemSolver::Summary summary;
  ceres::Solve(options, problem, found.unknowns.data(), &summary);
  found.cost = likelihood.value(found.unknowns.data());
  return found;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

/// Laws fitted to some of the stalks, which all have the same list of terms to choose from.
class LawFit {
 public:
  LawFit(std::vector<Reading> readings, const Evidence& weights)
      : readings_(std::move(readings)), weights_(weights) {
    for (int i = 0; i < stalk_load_count; ++i) {
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
        if (typical_[stalk_force + i] <= 0.0) return {};
        start.scale[stalk_force + i] = typical_[stalk_force + i];
        ++count;
      }
    std::optional<FittedLaw> best;
    // Which of the terms carries most is not known beforehand.
    for (int first = 0; first < std::max(1, count == 1 ? 1 : 1 << count); ++first)
      for (const double scatter : {0.05, 0.3}) {
        BreakLaw from = start;
        from.scatter = scatter;
        for (int i = 0, k = 0; i < 3; ++i)
          if (terms >> i & 1) from.scale[stalk_force + i] *= (first >> k++ & 1) ? 3.0 : 1.2;
        const FittedLaw found = fit(from);
        if (!best || found.evidence > best->evidence) best = found;
      }
    return best;
  }

  FittedLaw fit(const BreakLaw& from) const {
    const Likelihood likelihood(from, readings_, weights_);
    const Maximum found = maximise(likelihood);
    FittedLaw fitted;
    fitted.law = likelihood.law(found.unknowns.data());
    for (const Reading& reading : readings_)
      fitted.likelihood += log_likelihood(fitted.law, reading, weights_);
    // Which exponent is one more choice among them.
    const double choices = likelihood.terms().size() > 1 ? std::log(double(exponents.size())) : 0.0;
    fitted.evidence = fitted.likelihood - choices -
                      0.5 * likelihood.NumParameters() * std::log(double(readings_.size()));
    set_errors(likelihood, found.unknowns, fitted);
    for (const int term : likelihood.terms())
      fitted.error[term] = std::hypot(fitted.error[term], timing_error(fitted.law));
    return fitted;
  }

  /// Absent where no stalk that broke bore anything.
  std::optional<FittedLaw> best() const {
    std::optional<FittedLaw> best;
    for (int terms = 1; terms < 8; ++terms)
      for (const double exponent : exponents) {
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
struct ThresholdModel {
  const Evidence* weights;
  double scatter, factor = 1.0;
  double likelihood(const Against& one) const {
    return log_likelihood(factor * one.borne, factor * one.reached, one.broke, scatter, *weights);
  }
  double likelihood(const std::vector<Against>& all) const {
    double sum = -0.5 * std::pow(std::log(factor) / weights->threshold_error, 2);
    for (const Against& one : all) sum += likelihood(one);
    return sum;
  }
};

// The likeliest scatter and factor.
ThresholdModel likeliest(const std::vector<Against>& all, const Evidence& weights) {
  ThresholdModel best{&weights, weights.stalk_scatter};
  double most = best.likelihood(all);
  for (double scatter = weights.stalk_scatter; scatter < 3.0; scatter *= 1.1)
    for (double factor = 0.7; factor < 1.45; factor *= 1.01) {
      const ThresholdModel tried{&weights, scatter, factor};
      const double found = tried.likelihood(all);
      if (found > most) most = found, best = tried;
    }
  return best;
}

// Each stalk by what the others say, with the terms and the exponent of the law found.
double foretold_by_others(const BreakLaw& law, const std::vector<Reading>& readings,
                          const std::vector<Against>& thresholds, const Evidence& weights) {
  double gain = 0.0;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    std::vector<Reading> others = readings;
    others.erase(others.begin() + i);
    std::vector<Against> without = thresholds;
    without.erase(without.begin() + i);
    gain += log_likelihood(LawFit(others, weights).fit(law).law, readings[i], weights) -
            likeliest(without, weights).likelihood(thresholds[i]);
  }
  return gain;
}

}  // namespace

double BreakLaw::load(const StalkNumbers& given) const {
  double result = 0.0;
  if (std::isinf(exponent)) {
    for (int i = 0; i < stalk_load_count; ++i) result = std::max(result, given[i] / scale[i]);
    return result;
  }
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
  const std::array limits{fruit.detach.stretch, fruit.detach.bend, fruit.detach.force,
                          fruit.detach.moment, fruit.detach.torsion};
  for (int i = 0; i < stalk_load_count; ++i)
    if (limits[i]) law.scale[i] = *limits[i];
  for (const plant::Effect& effect : plant.effects) {
    const bool meant = !effect.place || effect.place->curve == fruit.place.curve;
    if (effect.name != "detachment_law" || !meant) continue;
    law = BreakLaw();
    const std::array names{"force", "moment", "torsion"};
    for (int i = 0; i < 3; ++i)
      if (effect.numbers.contains(names[i])) law.scale[stalk_force + i] = effect.number(names[i]);
    const auto own = effect.numbers.find("exponents");
    law.exponent = own == effect.numbers.end()
                       ? 2.0
                       : *std::max_element(own->second.begin(), own->second.end());
  }
  return law;
}

bool StalkStrength::needs_law() const {
  return law && evidence > levels.outside_evidence && foretold > 0.0;
}

std::string StalkStrength::sentence() const {
  double least = std::numeric_limits<double>::infinity(), largest_load = 0.0;
  for (std::size_t i = 0; i < stalks.size(); ++i) {
    if (!is_broken(stalks[i])) continue;
    const double load = thresholds[i].most(stalks[i], stalks[i].came_off);
    least = std::min(least, load);
    largest_load = std::max(largest_load, load);
  }
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
             " The events speak for it by %.3g nats, and by %.3g where each is foretold by the "
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
  if (strength.broken < settings.levels.broken_stalks) return strength;
  const ThresholdModel thresholds_at_best = likeliest(against, settings.evidence);
  strength.scatter = thresholds_at_best.scatter;
  const double without =
      thresholds_at_best.likelihood(against) - 0.5 * std::log(double(readings.size()));
  strength.law = LawFit(readings, settings.evidence).best();
  if (!strength.law) return strength;
  strength.evidence = strength.law->evidence - without;
  if (strength.evidence > settings.levels.outside_evidence)
    strength.foretold = foretold_by_others(strength.law->law, readings, against, settings.evidence);
  return strength;
}

}  // namespace pedicel::discrepancy
