#include "plugins/discrepancy/fit/parameter_fit.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>

#include "engine/core/random.h"
#include "engine/io/csv.h"
#include "plugins/discrepancy/admission/admission.h"
#include "plugins/discrepancy/fit/baseline_start.h"
#include "plugins/discrepancy/fit/causes.h"
#include "plugins/discrepancy/fit/fit_setup.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {

namespace {

constexpr int drawn_starts = 4, carried_on = 3, most_rounds = 3;
// A tenth either way, as in the baseline of a diagnosis.
constexpr double probe = 0.1;  // of an unknown

struct Nominal {
  double value = 1.0;
  std::string unit = "1";
};

// A material's factor is told as the value itself where the plant states one.
Nominal nominal(const Experiment& experiment, const std::string& effect,
                const FreeParameter& free) {
  const effects::EffectDefinition* known = effects::find_effect(effect);
  // A person knows a modulus in pascals, and would have to look up what a factor is on.
  // Of several plants each has its own.
  const auto own = known && known->material && experiment.plants.size() == 1
                       ? plant::number_of(experiment.plant().material, *known->material)
                       : std::nullopt;
  if (own) return {*own, std::string(known->material->unit)};
  return {1.0, free.unit.empty() ? "1" : free.unit};
}

// As it was asked for, so that a name can be copied from the answer into the next request.
std::string name_of(const plant::Effect& effect, const FreeParameter& free) {
  std::string name = effect.name;
  const effects::EffectDefinition* known = effects::find_effect(effect.name);
  // Modulus, density and damping time are asked for by their names alone.
  if (free.name != "factor" || !known || known->home != effects::Home::material)
    name += "." + free.name;
  const auto numbers = effect.numbers.find(free.name);
  if (numbers != effect.numbers.end() && numbers->second.size() > 1)
    name += "[" + std::to_string(free.component) + "]";
  if (effect.place)
    name += "@" + effect.place->curve + ":" + io::format_number(effect.place->at, 3);
  return name;
}

/// One fit on its way.
class Run {
 public:
  Run(FitGround& ground, const std::vector<Hypothesis>& starts, const ParameterFitOptions& options)
      : options_(options), ground_(ground), starts_(starts) {}

  ParameterFit run() {
    const Clock::time_point began = Clock::now();
    // First the valley, then mesh and step about it, then the noise that this model leaves.
    // Intervals need all three: each of them moves the cost's minimum or its curvature.
    choose_start();
    refine();
    ground_.renew_noise(result_.summary.hypothesis);
    // A profile walks along valleys that the fit did not see, and may come out lower. Then that is
    // the fit. A few times and not until nothing changes, because a round takes many refits.
    for (int round = 0; round < most_rounds && !stopped(); ++round) {
      say("fitting", 0.35);
      polish();
      if (!profile_all(round + 1 == most_rounds)) break;
    }
    measure_trials();
    ground_.describe(result_);
    result_.simulations = ground_.simulations();
    result_.stopped = stopped();
    result_.seconds = std::chrono::duration<double>(Clock::now() - began).count();
    return std::move(result_);
  }

 private:
  using Clock = std::chrono::steady_clock;
  const Experiment& experiment() const { return ground_.experiment(); }
  bool stopped() const { return options_.stop && *options_.stop; }
  void say(const std::string& what, double share) const {
    if (options_.progress) options_.progress(what, share);
  }

  // Some starts besides, anywhere within reach of the given ones.
  void draw_starts() {
    // Drawn with a seed, so that a fit can be repeated. The given starts are what effects usually
    // are; these look where nobody expects anything.
    Random random(options_.seed);
    const std::size_t given = starts_.size();
    for (int i = 0; i < drawn_starts; ++i) {
      // Each about another one of the given starts, as far as these go.
      Hypothesis start = starts_[i % given];
      for (int p = 0; p < start.size(); ++p) {
        const FreeParameter& free = start.free[p];
        // A factor of e, or two of the steps in which an effect's number is counted.
        const double reach = free.logarithmic ? 1.0 : 2.0;
        const double u = free.to_unknown(start.value(p)) + random.uniform(-reach, reach);
        start.set_value(p, std::clamp(free.to_value(u), free.low, free.high));
      }
      starts_.push_back(start);
    }
  }

  void choose_start() {
    say("looking from several starts", 0.02);
    // A model with nothing free is only looked at.
    if (starts_.front().size() > 0) draw_starts();
    result_.starts = static_cast<int>(starts_.size());
    FitOptions first = ground_.options();
    // Over the first part nothing is out of phase yet, and a cost tells which start is the nearest
    // one.
    first.horizon = ground_.first_horizon();
    ResidualSource& with = ground_.source();
    const Scan looked = scan(with, starts_, first);
    std::vector<int> order(starts_.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, {}, [&](int i) { return looked.cost[i]; });
    // More than the best one: an unfitted start in the right valley may cost more than one on the
    // slope of a wrong one. All would take too long.
    order.resize(std::min<std::size_t>(order.size(), carried_on));
    // In the order of their costs, wherever they are computed, so that the result does not depend
    // on who did.
    std::vector<FitSummary> fits =
        fits_by(options_.parts, "starts", static_cast<int>(order.size()),
                [&](int i) { return fit(with, starts_[order[i]], first); });
    // By the data alone. What is asked for by name has no prior.
    std::ranges::stable_sort(fits, {}, &FitSummary::cost);
    // Asked at the fitted start, where an effect is as large as it seems to be. At its first value
    // it may move nothing, and be fitted to something.
    keep_what_is_seen(fits.front().hypothesis);
    result_.summary = fit(with, result_.summary.hypothesis, ground_.options());
  }

  // What moves no sample is held where it was given: a fit would only walk about. A number that
  // the first part of the records drove to where it does nothing is given back.
  void keep_what_is_seen(const Hypothesis& found) {
    const int n = found.size();
    std::vector<Hypothesis> models{found};
    for (int p = 0; p < n; ++p) {
      const FreeParameter& free = found.free[p];
      double u = free.to_unknown(found.value(p));
      // Downwards where upwards would leave the bounds, outside of which an effect means nothing.
      u += u + probe > free.to_unknown(free.high) ? -probe : probe;
      models.push_back(found);
      models.back().set_value(p, free.to_value(u));
    }
    for (int p = 0; p < n; ++p) {
      models.push_back(found);
      // All the way back to the first start, for a number that no small step moves anything with
      // where it stands now.
      models.back().set_value(p, starts_.front().value(p));
    }
    ResidualSource& with = ground_.source();
    // Over the whole records: what the first part does not show a later one may.
    const Eigen::MatrixXd r = with.residuals(models, ground_.options());
    const auto moves = [&](int model) {
      // The largest change of any sample: a number may be seen in one sample alone.
      return (r.col(model) - r.col(0)).cwiseAbs().maxCoeff() >=
             ground_.options().settings->accuracy.seen;
    };
    Hypothesis& kept = result_.summary.hypothesis;
    kept = found;
    // Freedom is given back to each that earns it. The effects stay whole: what is not fitted still
    // acts as it was given.
    kept.free.clear();
    for (int p = 0; p < n; ++p) {
      const FreeParameter& free = found.free[p];
      const bool seen = moves(1 + p);
      // With the whole of its effect, whose other numbers were fitted about a value that means
      // nothing.
      if (!seen) kept.effects[free.effect] = starts_.front().effects[free.effect];
      if (seen || moves(1 + n + p))
        kept.free.push_back(free);
      else
        // Told at the end as what these data cannot see. Silence would look like a number that was
        // forgotten.
        unseen_.push_back(free);
    }
  }

  void refine() {
    result_.numerical_error = ground_.refine(result_.summary, [this](int round) {
      say("checking our own numerical error", 0.1 + 0.05 * round);
    });
    // Counted before the mesh's share joins them. That one is a nuisance that nobody asked for, and
    // has no interval.
    asked_ = result_.summary.hypothesis.size();
    // Which mesh the modulus came with is not known. Without this freedom an interval would leave
    // out the largest doubt of precise data.
    result_.summary.hypothesis.add(ground_.nuisance());
    ResidualSource& with = ground_.source();
    result_.summary = fit(with, result_.summary.hypothesis, ground_.options());
  }

  // To the bottom: an interval's end is a matter of nats, not of a share of the cost.
  void polish() {
    ResidualSource& with = ground_.source();
    result_.summary = fit(with, result_.summary.hypothesis, ground_.options());
    FitOptions fine = ground_.options();
    fine.least_step = std::min(fine.least_step, 0.01);
    result_.summary = fit(with, result_.summary.hypothesis, fine);
    // More than noise is left where the model is not the plant. Intervals of noise alone would then
    // be too sure of it by this factor.
    result_.spread =
        std::sqrt(std::max(1.0, 2.0 * result_.summary.cost / std::max(1, result_.summary.samples)));
  }

  // True: a better fit turned up on the way, and the intervals must be done again. Never so in the
  // last round: half a table about another fit would be worse than all of it about this one.
  bool profile_all(bool is_last) {
    // Intervals about what was not the minimum say nothing.
    result_.parameters.clear();
    std::vector<Profile> profiles;
    // Other processes do all profiles at once. Here they are made one by one, so that a better fit
    // ends the round as soon as it is found.
    if (options_.parts)
      profiles =
          profiles_by(*options_.parts, "profiles", asked_, [this](int p) { return profiled(p); });
    for (int p = 0; p < asked_ && !stopped(); ++p) {
      say("profiling " + described(result_.summary.hypothesis.free[p]).name,
          0.4 + 0.55 * p / asked_);
      const Profile found = profiles.empty() ? profiled(p) : profiles[p];
      result_.refits += found.low.refits + found.high.refits;
      if (found.better && is_last)
        result_.remarks.push_back("While the interval of " +
                                  described(result_.summary.hypothesis.free[p]).name +
                                  " was looked for a better fit turned up again: the data have "
                                  "several valleys, and intervals may be too narrow.");
      if (found.better && !is_last) {
        // Its values alone. The fit that follows makes the residual and the derivatives anew, with
        // the freedom of all its numbers.
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
    ResidualSource& with = ground_.source();
    return profile(with, result_.summary, p, ground_.options(),
                   // The unit in which a deviance counts is what the model leaves, where that is
                   // more than noise.
                   deviance95 * result_.spread * result_.spread);
  }

  FittedParameter described(const FreeParameter& free) const {
    // A hypothesis of this number alone, so that headings, places and components are read as fits
    // read them.
    Hypothesis alone;
    alone.effects = result_.summary.hypothesis.effects;
    alone.free = {free};
    const plant::Effect& effect = alone.effects[free.effect];
    const Nominal unit = nominal(experiment(), effect.name, free);
    FittedParameter made;
    made.name = name_of(effect, free);
    made.unit = unit.unit;
    made.value = unit.value * alone.value(0);
    // Until an interval is known all that the number may be.
    made.low = unit.value * free.low;
    made.high = unit.value * free.high;
    return made;
  }

  void report(int p, const Profile& found) {
    const FreeParameter& free = result_.summary.hypothesis.free[p];
    const plant::Effect& effect = result_.summary.hypothesis.effects[free.effect];
    const double unit = nominal(experiment(), effect.name, free).value;
    FittedParameter made = described(free);
    made.low = unit * free.to_value(found.low.unknown);
    made.high = unit * free.to_value(found.high.unknown);
    made.low_open = found.low.at_bound;
    made.high_open = found.high.at_bound;
    made.at_bound =
        std::ranges::find(result_.summary.at_bound, p) != result_.summary.at_bound.end();
    // Open on one side is still a finding, such as "at least so stiff". Open on both is none.
    made.seen = !(made.low_open && made.high_open);
    result_.parameters.push_back(made);
  }

  void measure_trials() {
    // Of trials held out, too: their error beside that of the fitted ones tells whether the numbers
    // carry over.
    const std::vector<Misfit> misfits = ground_.misfits({&result_.summary.hypothesis, 1}).front();
    const std::vector<int> check = ground_.check_trials();
    for (std::size_t t = 0; t < misfits.size(); ++t)
      result_.trials.push_back({experiment().trials[t].name,
                                std::ranges::find(check, static_cast<int>(t)) != check.end(),
                                misfits[t].rms()});
  }

  ParameterFitOptions options_;
  FitGround& ground_;
  std::vector<Hypothesis> starts_;
  std::vector<FreeParameter> unseen_;
  int asked_ = 0;  // free parameters that were asked for and are seen, the first of the model's
  ParameterFit result_;
};

/// A single plant. The set-up refers to the admitted experiment, which is this object's own: what
/// was left out of the data there is left out of everything here.
class PlantGround : public FitGround {
 public:
  PlantGround(const Experiment& experiment, int threads, const std::atomic<bool>* stop,
              const NoiseRule& rule)
      : admission_(admitted(experiment)),
        setup_(admission_.experiment, threads, rule, stop, default_settings()) {}

  const Experiment& experiment() const override { return setup_.experiment(); }
  ResidualSource& source() override { return evaluator_.emplace(setup_.evaluator()); }
  FitOptions options() const override { return setup_.options(); }
  double first_horizon() const override { return options().settings->budget.baseline_horizon; }
  double refine(FitSummary& model, const std::function<void(int)>& begin) override {
    return setup_.refine(model, {begin, {}}).largest;
  }
  Hypothesis nuisance() const override { return mesh_nuisance(); }
  void renew_noise(const Hypothesis& model) override { setup_.renew_noise(model); }
  std::vector<int> check_trials() const override { return setup_.check_trials(); }
  Hypothesis baseline() override {
    Evaluator with = setup_.evaluator();
    std::vector<std::string> unseen;
    return baseline_start(with, setup_.options(), unseen);
  }
  std::vector<std::vector<Misfit>> misfits(std::span<const Hypothesis> models) override {
    std::vector<std::vector<Misfit>> all(models.size());
    const auto predicted = setup_.predictions(models);
    for (std::size_t m = 0; m < models.size(); ++m)
      for (int t = 0; t < static_cast<int>(predicted[m].size()); ++t) {
        const int count = setup_.data().samples(std::span(&t, 1));
        const double rms = setup_.data().rms(std::span(&t, 1), predicted[m]);
        all[m].push_back({rms * rms * count, count});
      }
    return all;
  }
  void describe(ParameterFit& fit) override {
    fit.noise = {{"position_std", setup_.data().position_noise().std},
                 {"force_std", setup_.data().force_noise().std}};
    fit.distance = setup_.numerics().distance;
    fit.dt = setup_.numerics().dt;
    for (const std::string& remark : admission_.remarks) fit.remarks.push_back(remark + ".");
  }
  long simulations() const override { return setup_.simulations(); }

 private:
  static Admission admitted(const Experiment& experiment) {
    Admission admission = admit(experiment);
    Diagnostics diagnostics;
    // Data that contradict themselves have no parameters. They end as a fault of the file.
    add_refusal(diagnostics, admission);
    if (diagnostics.has_errors()) throw InvalidFile(diagnostics);
    return admission;
  }

  // Before what refers to it: members are made in this order.
  Admission admission_;
  FitSetup setup_;
  std::optional<Evaluator> evaluator_;
};

}  // namespace

ParameterFit fit_parameters(FitGround& ground, const std::vector<Hypothesis>& starts,
                            const ParameterFitOptions& options) {
  return Run(ground, starts, options).run();
}

std::unique_ptr<FitGround> plant_ground(const Experiment& experiment, int threads,
                                        const std::atomic<bool>* stop, const NoiseRule& rule) {
  return std::make_unique<PlantGround>(experiment, threads, stop, rule);
}

ParameterFit fit_parameters(const Experiment& experiment, const std::vector<Hypothesis>& starts,
                            const ParameterFitOptions& options) {
  PlantGround ground(experiment, options.threads, options.stop, fit_noise_rule);
  return fit_parameters(ground, starts, options);
}

}  // namespace pedicel::discrepancy
