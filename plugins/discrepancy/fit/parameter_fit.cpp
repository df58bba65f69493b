#include "pedicel/discrepancy/fit/parameter_fit.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>

#include "pedicel/core/random.h"
#include "pedicel/discrepancy/admission/admission.h"
#include "pedicel/discrepancy/fit/causes.h"
#include "pedicel/discrepancy/fit/fit_setup.h"
#include "pedicel/effects/registry/effect_definition.h"
#include "pedicel/io/csv.h"

namespace pedicel::discrepancy {

namespace {

constexpr int drawn_starts = 4, carried_on = 3, most_rounds = 3;
constexpr double probe = 0.1;  // of an unknown

struct Nominal {
  double value = 1.0;
  std::string unit = "1";
};

// A material's factor is told as the value itself where the plant states one.
Nominal nominal(const plant::MaterialValues& material, const std::string& effect,
                const FreeParameter& free) {
  const effects::EffectDefinition* known = effects::find_effect(effect);
  const auto own =
      known && known->material ? plant::number_of(material, *known->material) : std::nullopt;
  if (own) return {*own, std::string(known->material->unit)};
  return {1.0, free.unit.empty() ? "1" : free.unit};
}

std::string name_of(const plant::Effect& effect, const FreeParameter& free) {
  std::string name = effect.name;
  const effects::EffectDefinition* known = effects::find_effect(effect.name);
  if (free.name != "factor" || !known || known->home != effects::Home::material)
    name += "." + free.name;
  const auto numbers = effect.numbers.find(free.name);
  if (numbers != effect.numbers.end() && numbers->second.size() > 1)
    name += "[" + std::to_string(free.component) + "]";
  if (effect.place)
    name += "@" + effect.place->curve + ":" + io::format_number(effect.place->at, 3);
  return name;
}

// What is stated counts, with the colour that the data show. An estimate far below what is stated
// comes from stretches in which nothing moves, and says little of the rest.
constexpr NoiseRule noise_rule{0.5, false};

/// One fit on its way.
class Run {
 public:
  Run(const Experiment& experiment, const std::vector<Hypothesis>& starts,
      const ParameterFitOptions& options)
      : options_(options),
        admission_(admitted(experiment)),
        starts_(starts),
        setup_(admission_.experiment, options.threads, noise_rule, options.stop,
               default_settings()) {
    for (const std::string& remark : admission_.remarks) result_.remarks.push_back(remark + ".");
  }

  ParameterFit run() {
    const Clock::time_point began = Clock::now();
    choose_start();
    refine();
    setup_.renew_noise(result_.summary.hypothesis);
    for (int round = 0; round < most_rounds && !stopped(); ++round) {
      say("fitting", 0.35);
      polish();
      if (!profile_all()) break;
    }
    measure_trials();
    result_.position_noise = setup_.data().position_noise();
    result_.force_noise = setup_.data().force_noise();
    result_.numerics = setup_.numerics();
    result_.stopped = stopped();
    result_.simulations = setup_.simulations();
    result_.seconds = std::chrono::duration<double>(Clock::now() - began).count();
    return std::move(result_);
  }

 private:
  using Clock = std::chrono::steady_clock;
  static Admission admitted(const Experiment& experiment) {
    Admission admission = admit(experiment);
    Diagnostics diagnostics;
    add_refusal(diagnostics, admission);
    if (diagnostics.has_errors()) throw InvalidFile(diagnostics);
    return admission;
  }
  const Experiment& experiment() const { return setup_.experiment(); }
  bool stopped() const { return setup_.stopped(); }
  void say(const std::string& what, double share) const {
    if (options_.progress) options_.progress(what, share);
  }

  // Some starts besides, anywhere within reach of the given ones.
  void draw_starts() {
    Random random(options_.seed);
    const std::size_t given = starts_.size();
    for (int i = 0; i < drawn_starts; ++i) {
      Hypothesis start = starts_[i % given];
      for (int p = 0; p < start.size(); ++p) {
        const FreeParameter& free = start.free[p];
        const double reach = free.logarithmic ? 1.0 : 2.0;
        const double u = free.to_unknown(start.value(p)) + random.uniform(-reach, reach);
        start.set_value(p, std::clamp(free.to_value(u), free.low, free.high));
      }
      starts_.push_back(start);
    }
  }

  void choose_start() {
    say("looking from several starts", 0.02);
    if (starts_.front().size() > 0) draw_starts();
    result_.starts = static_cast<int>(starts_.size());
    FitOptions first = setup_.options();
    first.horizon = first.settings->budget.baseline_horizon;
    Evaluator with = setup_.evaluator();
    const Scan looked = scan(with, starts_, first);
    std::vector<int> order(starts_.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, {}, [&](int i) { return looked.cost[i]; });
    order.resize(std::min<std::size_t>(order.size(), carried_on));
    std::vector<FitSummary> fits =
        fits_by(options_.parts, "starts", static_cast<int>(order.size()),
                [&](int i) { return fit(with, starts_[order[i]], first); });
    std::ranges::stable_sort(fits, {}, &FitSummary::cost);
    keep_what_is_seen(fits.front().hypothesis);
    result_.summary = fit(with, result_.summary.hypothesis, setup_.options());
  }

  // What moves no sample is held where it was given: a fit would only walk about. A number that
  // the first part of the records drove to where it does nothing is given back.
  void keep_what_is_seen(const Hypothesis& found) {
    const int n = found.size();
    std::vector<Hypothesis> models{found};
    for (int p = 0; p < n; ++p) {
      const FreeParameter& free = found.free[p];
      double u = free.to_unknown(found.value(p));
      u += u + probe > free.to_unknown(free.high) ? -probe : probe;
      models.push_back(found);
      models.back().set_value(p, free.to_value(u));
    }
    for (int p = 0; p < n; ++p) {
      models.push_back(found);
      models.back().set_value(p, starts_.front().value(p));
    }
    Evaluator with = setup_.evaluator();
    const Eigen::MatrixXd r = with.residuals(models, setup_.options());
    const auto moves = [&](int model) {
      return (r.col(model) - r.col(0)).cwiseAbs().maxCoeff() >=
             setup_.options().settings->accuracy.seen;
    };
    Hypothesis& kept = result_.summary.hypothesis;
    kept = found;
    kept.free.clear();
    for (int p = 0; p < n; ++p) {
      const FreeParameter& free = found.free[p];
      const bool seen = moves(1 + p);
      if (!seen) kept.effects[free.effect] = starts_.front().effects[free.effect];
      if (seen || moves(1 + n + p))
        kept.free.push_back(free);
      else
        unseen_.push_back(free);
    }
  }

  void refine() {
    const NumericsCheck check = setup_.refine(
        result_.summary,
        {[this](int round) { say("checking our own numerical error", 0.1 + 0.05 * round); }, {}});
    result_.numerical_error = check.largest;
    asked_ = result_.summary.hypothesis.size();
    result_.summary.hypothesis.add(mesh_nuisance());
    Evaluator with = setup_.evaluator();
    result_.summary = fit(with, result_.summary.hypothesis, setup_.options());
  }

  // To the bottom: an interval's end is a matter of nats, not of a share of the cost.
  void polish() {
    Evaluator with = setup_.evaluator();
    result_.summary = fit(with, result_.summary.hypothesis, setup_.options());
    FitOptions fine = setup_.options();
    fine.least_step = std::min(fine.least_step, 0.01);
    result_.summary = fit(with, result_.summary.hypothesis, fine);
    result_.spread =
        std::sqrt(std::max(1.0, 2.0 * result_.summary.cost / std::max(1, setup_.samples())));
  }

  // True: a better fit turned up on the way, and the intervals must be done again.
  bool profile_all() {
    result_.parameters.clear();
    std::vector<Profile> profiles;
    if (options_.parts)
      profiles =
          profiles_by(*options_.parts, "profiles", asked_, [this](int p) { return profiled(p); });
    for (int p = 0; p < asked_ && !stopped(); ++p) {
      say("profiling " + described(result_.summary.hypothesis.free[p]).name,
          0.4 + 0.55 * p / asked_);
      const Profile found = profiles.empty() ? profiled(p) : profiles[p];
      result_.refits += found.low.refits + found.high.refits;
      if (found.better) {
        result_.summary.hypothesis = found.better->hypothesis;
        return true;
      }
      report(p, found);
    }
    for (const FreeParameter& lost : unseen_) {
      FittedParameter parameter = described(lost);
      parameter.seen = false;
      parameter.low_open = parameter.high_open = true;
      result_.parameters.push_back(parameter);
    }
    return false;
  }

  Profile profiled(int p) {
    Evaluator with = setup_.evaluator();
    return profile(with, result_.summary, p, setup_.options(),
                   deviance95 * result_.spread * result_.spread);
  }

  FittedParameter described(const FreeParameter& free) const {
    Hypothesis alone;
    alone.effects = result_.summary.hypothesis.effects;
    alone.free = {free};
    const plant::Effect& effect = alone.effects[free.effect];
    const Nominal unit = nominal(experiment().plant.material, effect.name, free);
    FittedParameter made;
    made.name = name_of(effect, free);
    made.unit = unit.unit;
    made.value = unit.value * alone.value(0);
    made.low = unit.value * free.low;
    made.high = unit.value * free.high;
    return made;
  }

  void report(int p, const Profile& found) {
    const FreeParameter& free = result_.summary.hypothesis.free[p];
    const plant::Effect& effect = result_.summary.hypothesis.effects[free.effect];
    const double unit = nominal(experiment().plant.material, effect.name, free).value;
    FittedParameter made = described(free);
    made.low = unit * free.to_value(found.low.unknown);
    made.high = unit * free.to_value(found.high.unknown);
    made.low_open = found.low.at_bound;
    made.high_open = found.high.at_bound;
    made.at_bound =
        std::ranges::find(result_.summary.at_bound, p) != result_.summary.at_bound.end();
    made.seen = !(made.low_open && made.high_open);
    result_.parameters.push_back(made);
  }

  void measure_trials() {
    const auto predicted = setup_.predictions(std::span(&result_.summary.hypothesis, 1)).front();
    const std::vector<int>& check = setup_.check_trials();
    for (int t = 0; t < static_cast<int>(predicted.size()); ++t)
      result_.trials.push_back({experiment().trials[t].name,
                                std::ranges::find(check, t) != check.end(),
                                setup_.data().rms(std::span(&t, 1), predicted)});
  }

  ParameterFitOptions options_;
  Admission admission_;
  std::vector<Hypothesis> starts_;
  FitSetup setup_;
  std::vector<FreeParameter> unseen_;
  int asked_ = 0;  // free parameters that were asked for and are seen, the first of the model's
  ParameterFit result_;
};

}  // namespace

ParameterFit fit_parameters(const Experiment& experiment, const std::vector<Hypothesis>& starts,
                            const ParameterFitOptions& options) {
  return Run(experiment, starts, options).run();
}

}  // namespace pedicel::discrepancy
