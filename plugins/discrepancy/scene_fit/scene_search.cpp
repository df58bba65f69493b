#include "pedicel/discrepancy/scene_fit/scene_search.h"

#include <algorithm>
#include <cmath>

#include "pedicel/io/csv.h"

namespace pedicel::discrepancy {

namespace {

/// Of a material's number, beside its standard error: what a file's own number is known to.
constexpr double known_to = 0.03, clear = 3.0;

/// A model to be looked at, and what it may come to.
struct Screened {
  Hypothesis model;
  std::string name;
  double promised = 0.0;  // nats, that a linear fit would have
};

double cost_of(const SceneFitResult& fit) {
  return 0.5 * fit.sum.square +
         0.5 * fit.model.size() * std::log(std::max(2.0, static_cast<double>(fit.sum.count)));
}

// Least squares with the priors of the free numbers.
double linear_cost(const Eigen::VectorXd& residual, const Eigen::MatrixXd& jacobian,
                   const Hypothesis& model) {
  const long n = jacobian.cols();
  Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
  const Eigen::VectorXd right = jacobian.transpose() * residual;
  for (long p = 0; p < n; ++p) {
    // A step goes no farther than the number's own scale, or the linear promises anything.
    const double width = model.free[static_cast<std::size_t>(p)].width();
    normal(p, p) += 1.0 / (width * width) + 1.0e-9;
  }
  const Eigen::VectorXd step = normal.ldlt().solve(right);
  return 0.5 * (residual.squaredNorm() - right.dot(step));
}

class Search {
 public:
  Search(SceneEvaluator& evaluator, const SceneSearchOptions& options)
      : evaluator_(evaluator), options_(options), experiment_(evaluator.simulator().experiment()) {}

  SceneFindings run() {
    const Hypothesis plain;
    tell("simulating the scene as the files say", 0.0);
    const SceneFitResult nominal = look_at(evaluator_, plain, options_.trials);
    found_.nominal_excess = SceneDataSet::beyond_noise(nominal.sum);
    tell("fitting modulus, density and damping", 0.05);
    found_.baseline = fit(scene_baseline(experiment_));
    found_.baseline_excess = SceneDataSet::beyond_noise(found_.baseline.sum);
    if (found_.baseline_excess > options_.floor && !stopped()) look_for_causes();
    conclude();
    found_.partial = stopped();
    return std::move(found_);
  }

 private:
  void look_for_causes() {
    std::vector<std::string> none;
    add_round(found_.baseline, none, 0.2, 0.6);
    // A second one only where the first leaves more than solvers differ by.
    for (int more = 1; more < options_.most_causes && !stopped(); ++more) {
      if (found_.candidates.empty()) return;
      const SceneCandidate best = found_.candidates.front();
      if (best.excess <= options_.floor || static_cast<int>(best.names.size()) < more) return;
      add_round(best.fit, best.names, 0.6, 0.95);
    }
  }

  // Extends a model by each cause that it has not; refits the most promising.
  void add_round(const SceneFitResult& base, const std::vector<std::string>& names, double from,
                 double to) {
    std::vector<Screened> all;
    const auto& definitions = scene_effect_definitions();
    for (std::size_t d = 0; d < definitions.size() && !stopped(); ++d) {
      if (std::ranges::find(names, definitions[d].name) != names.end()) continue;
      tell("looking at " + definitions[d].name,
           from + 0.4 * (to - from) * static_cast<double>(d) / definitions.size());
      for (const SceneFit& start : starts_of(definitions[d], {experiment_}))
        all.push_back(screen(base, definitions[d].name, start));
    }
    std::ranges::stable_sort(all, {}, &Screened::promised);
    const double before = 0.5 * base.sum.square;
    int done = 0;
    for (const Screened& one : all) {
      if (done == options_.most_refits || stopped()) break;
      const double best = before - all.front().promised;
      // What promises a tenth of the best is no rival of it.
      if (before - one.promised < 0.1 * best) break;
      tell("refitting with " + one.name,
           from + (to - from) * (0.4 + 0.6 * done / options_.most_refits));
      SceneCandidate candidate;
      candidate.names = names;
      candidate.names.push_back(one.name);
      candidate.fit = fit(one.model);
      candidate.cost = cost_of(candidate.fit);
      candidate.excess = SceneDataSet::beyond_noise(candidate.fit.sum);
      found_.candidates.push_back(std::move(candidate));
      ++done;
    }
    std::ranges::stable_sort(found_.candidates, {}, &SceneCandidate::cost);
    keep_best_of_each();
  }

  // The best start of a cause stands for it.
  void keep_best_of_each() {
    std::vector<SceneCandidate> kept;
    for (SceneCandidate& one : found_.candidates)
      if (std::ranges::none_of(
              kept, [&](const SceneCandidate& other) { return other.names == one.names; }))
        kept.push_back(std::move(one));
    found_.candidates = std::move(kept);
  }

  Screened screen(const SceneFitResult& base, const std::string& name, const SceneFit& start) {
    Screened one;
    one.name = name;
    one.model = base.model;
    Hypothesis added;
    added.effects = {start.effect};
    added.free = start.free;
    one.model.add(added);
    // One that does nothing where it starts: only its own derivatives are new.
    const bool vanishes = std::ranges::all_of(start.free, [&](const effects::FreeParameter& free) {
      const double value = start.effect.numbers.at(free.name)[free.component];
      return (free.vanishes == effects::Vanishes::at_zero && value == 0.0) ||
             (free.vanishes == effects::Vanishes::at_one && value == 1.0) ||
             free.vanishes == effects::Vanishes::never;
    });
    if (!vanishes) {
      const SceneFitResult there = look_at(evaluator_, one.model, options_.trials);
      one.promised = linear_cost(there.residual, there.jacobian, one.model);
      return one;
    }
    Hypothesis own = one.model;
    own.free.erase(own.free.begin(), own.free.begin() + base.model.size());
    const SceneFitResult there = look_at(evaluator_, own, options_.trials);
    Eigen::MatrixXd both(base.jacobian.rows(), base.jacobian.cols() + there.jacobian.cols());
    both << base.jacobian, there.jacobian;
    one.promised = linear_cost(base.residual, both, one.model);
    return one;
  }

  SceneFitResult fit(const Hypothesis& start) {
    SceneFitOptions how;
    how.trials = options_.trials;
    return fit_scene(evaluator_, start, how);
  }

  void conclude() {
    using Outcome = SceneFindings::Outcome;
    const SceneFitResult* model = &found_.baseline;
    if (found_.baseline_excess <= options_.floor) {
      found_.outcome = Outcome::adequate;
    } else if (found_.candidates.empty()) {
      found_.outcome = Outcome::unknown;
    } else {
      const SceneCandidate& best = found_.candidates.front();
      const double share = 1.0 - std::pow(best.excess / found_.baseline_excess, 2);
      const bool explains = best.excess <= options_.floor ||
                            (share >= options_.least_share && best.excess <= 2.0 * options_.floor);
      found_.outcome = explains ? Outcome::named : Outcome::unknown;
      model = explains ? &best.fit : &found_.baseline;
      const double gain = cost_of(found_.baseline) - best.cost;
      for (std::size_t i = 1; explains && i < found_.candidates.size(); ++i)
        if (found_.candidates[i].cost - best.cost < std::max(3.0, options_.rival_share * gain))
          found_.outcome = Outcome::ambiguous;
    }
    if (found_.outcome != Outcome::unknown) name_material(*model);
  }

  void name_material(const SceneFitResult& fit) {
    for (const char* name : {"youngs_modulus", "density", "damping_time"}) {
      const int p = fit.model.factor_on(name);
      if (p < 0) continue;
      const double off = std::log(fit.model.value(p));
      const double error = std::hypot(fit.standard_error[p], known_to);
      if (std::abs(off) > clear * error) found_.material.push_back(name);
    }
  }

  void tell(const std::string& what, double share) const {
    if (options_.progress) options_.progress(what, share);
  }
  bool stopped() const { return options_.stop && *options_.stop; }

  SceneEvaluator& evaluator_;
  const SceneSearchOptions& options_;
  const SceneExperiment& experiment_;
  SceneFindings found_;
};

std::string numbers_of(const SceneFitResult& fit) {
  std::string text;
  for (int p = 0; p < fit.model.size(); ++p) {
    const effects::FreeParameter& free = fit.model.free[static_cast<std::size_t>(p)];
    const double value = fit.model.value(p);
    const double error = fit.standard_error[p] * (free.logarithmic ? value : free.scale);
    text += (text.empty() ? "" : ", ") +
            fit.model.effects[static_cast<std::size_t>(free.effect)].name + "." + free.name;
    if (free.component > 0 || free.name == "offset" || free.name == "rotation")
      text += std::string("[") + "xyz"[free.component] + "]";
    text += " " + io::format_number(value, 4) + " +- " + io::format_number(error, 2);
    if (free.unit != "1") text += " " + free.unit;
  }
  return text;
}

}  // namespace

SceneFindings search_scene(SceneEvaluator& evaluator, const SceneSearchOptions& options) {
  return Search(evaluator, options).run();
}

std::string findings_text(const SceneFindings& found, const SceneExperiment&) {
  const auto units = [](double value) { return io::format_number(value, 3); };
  std::string text = "misfit beyond the noise, in noise units: " + units(found.nominal_excess) +
                     " as the files say, " + units(found.baseline_excess) +
                     " with modulus, density and damping refitted\n";
  text += "  refitted: " + numbers_of(found.baseline) + "\n";
  for (const SceneCandidate& one : found.candidates) {
    std::string names;
    for (const std::string& name : one.names) names += (names.empty() ? "" : " and ") + name;
    text += "  " + names + ": " + units(one.excess) + " left, " +
            io::format_number(one.cost - found.candidates.front().cost, 4) + " nats behind; " +
            numbers_of(one.fit) + "\n";
  }
  return text;
}

}  // namespace pedicel::discrepancy
