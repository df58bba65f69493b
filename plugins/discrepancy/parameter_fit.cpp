#include "discrepancy/parameter_fit.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>

#include "core/random.h"
#include "discrepancy/admission.h"
#include "discrepancy/causes.h"
#include "discrepancy/trial_split.h"
#include "io/csv.h"

namespace pedicel::discrepancy {

namespace {

constexpr double allowed_error = 0.15;  // of the noise, RMS, before it is corrected for
constexpr double early = 0.3;           // share of the records in which periods do not slip
constexpr int drawn_starts = 4, carried_on = 3, most_rounds = 3;
constexpr double probe = 0.1;         // of an unknown
constexpr double least_change = 0.1;  // noise units

struct Nominal {
  double value = 1.0;
  std::string unit = "1";
};

// A material's factor is told as the value itself where the plant states one.
Nominal nominal(const plant::MaterialValues& material, const std::string& effect,
                const FreeParameter& free) {
  if (effect == "youngs_modulus" && material.youngs_modulus)
    return {*material.youngs_modulus, "Pa"};
  if (effect == "density" && material.density) return {*material.density, "kg/m3"};
  if (effect == "damping_time" && material.damping_time) return {*material.damping_time, "s"};
  return {1.0, free.unit.empty() ? "1" : free.unit};
}

std::string name_of(const plant::Effect& effect, const FreeParameter& free) {
  std::string name = effect.name;
  if (free.name != "factor" || effect.place || effect.name == "marker_scale")
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
  Run(const Experiment& experiment, const std::vector<Hypothesis>& starts,
      const ParameterFitOptions& options)
      : options_(options),
        admission_(admit(experiment)),
        starts_(starts),
        data_(this->experiment()) {
    if (!admission_.refusal.empty())
      throw InvalidFile({(experiment.folder / "experiment.yaml").string(), 0, 0},
                        admission_.refusal);
    for (const std::string& remark : admission_.remarks) result_.remarks.push_back(remark + ".");
    const TrialSplit split = split_trials(this->experiment());
    fit_options_.trials = split.fit;
    check_ = split.check;
    result_.numerics = {this->experiment().plant.distance, 1.0 / 480.0};
    std::vector<Series> position, force;
    measured_series(this->experiment(), position, force);
    set_noise(position, force);
    renew();
  }

  ParameterFit run() {
    const Clock::time_point began = Clock::now();
    choose_start();
    refine();
    renew_noise();
    for (int round = 0; round < most_rounds && !stopped(); ++round) {
      say("fitting", 0.35);
      polish();
      if (!profile_all()) break;
    }
    measure_trials();
    result_.stopped = stopped();
    count();
    result_.seconds = std::chrono::duration<double>(Clock::now() - began).count();
    return std::move(result_);
  }

 private:
  using Clock = std::chrono::steady_clock;
  const Experiment& experiment() const { return admission_.experiment; }
  bool stopped() const { return options_.stop && *options_.stop; }
  void say(const std::string& what, double share) const {
    if (options_.progress) options_.progress(what, share);
  }

  // What is stated counts, with the colour that the data show. Motion can only raise an estimate;
  // and one far below what is stated comes from stretches in which nothing moves, and says little
  // of the rest.
  void set_noise(const std::vector<Series>& position, const std::vector<Series>& force) {
    const auto choose = [](const std::vector<Series>& series, double std) {
      Noise noise = estimate_noise(series, std);
      if (std > 0.0 && noise.std < 0.5 * std) return white_noise(std);
      if (std > 0.0 && noise.std > 1.2 * std) {
        for (double& innovation : noise.innovation) innovation *= std / noise.std;
        noise.std = std;
      }
      return noise;
    };
    result_.position_noise = choose(position, experiment().noise.position_std.value_or(0.0));
    result_.force_noise = choose(force, experiment().noise.force_std.value_or(0.0));
    data_.set_noise(result_.position_noise, result_.force_noise);
  }

  void count() {
    if (simulator_) result_.simulations += simulator_->simulations();
  }
  void renew() {
    count();
    simulator_ = std::make_unique<Simulator>(experiment(), result_.numerics, options_.threads);
  }
  Evaluator evaluator() {
    return Evaluator(*simulator_, data_, corrections_.empty() ? nullptr : &corrections_);
  }
  int samples() const { return data_.samples(fit_options_.trials); }

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
    FitOptions first = fit_options_;
    first.horizon = early;
    Evaluator with = evaluator();
    const Scan looked = scan(with, starts_, first);
    std::vector<int> order(starts_.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, {}, [&](int i) { return looked.cost[i]; });
    order.resize(std::min<std::size_t>(order.size(), carried_on));
    std::vector<FitSummary> fits;
    for (const int i : order) fits.push_back(fit(with, starts_[i], first));
    std::ranges::stable_sort(fits, {}, &FitSummary::cost);
    keep_what_is_seen(fits.front().hypothesis);
    result_.summary = fit(with, result_.summary.hypothesis, fit_options_);
  }

  // What moves no sample is held where it was given: a fit would only walk about.
  void keep_what_is_seen(const Hypothesis& found) {
    std::vector<Hypothesis> models{found};
    for (int p = 0; p < found.size(); ++p) {
      const FreeParameter& free = found.free[p];
      double u = free.to_unknown(found.value(p));
      u += u + probe > free.to_unknown(free.high) ? -probe : probe;
      models.push_back(found);
      models.back().set_value(p, free.to_value(u));
    }
    Evaluator with = evaluator();
    const Eigen::MatrixXd r = with.residuals(models, fit_options_);
    Hypothesis& kept = result_.summary.hypothesis;
    kept = found;
    kept.free.clear();
    for (int p = 0; p < found.size(); ++p) {
      if ((r.col(p + 1) - r.col(0)).cwiseAbs().maxCoeff() >= least_change) {
        kept.free.push_back(found.free[p]);
        continue;
      }
      FreeParameter lost = found.free[p];
      kept.effects[lost.effect] = starts_.front().effects[lost.effect];
      unseen_.push_back(lost);
    }
  }

  // Mesh and step, until our own error is a small part of the noise, or until that costs too much.
  void refine() {
    for (int round = 0;; ++round) {
      say("checking our own numerical error", 0.1 + 0.05 * round);
      const NumericsCheck check =
          check_numerics(experiment(), data_, result_.summary, result_.numerics, fit_options_,
                         options_.threads, result_.simulations);
      result_.numerical_error = check.largest;
      if (check.largest <= allowed_error || round == 3 || stopped()) {
        corrections_ = check.corrections;
        break;
      }
      result_.numerics = refined(check);
      renew();
      Evaluator with = evaluator();
      result_.summary = fit(with, result_.summary.hypothesis, fit_options_);
    }
    asked_ = result_.summary.hypothesis.size();
    result_.summary.hypothesis.add(mesh_freedom());
    Evaluator with = evaluator();
    result_.summary = fit(with, result_.summary.hypothesis, fit_options_);
  }

  void renew_noise() {
    const auto predicted = predictions();
    std::vector<Series> position, force;
    for (std::size_t t = 0; t < predicted.size(); ++t)
      data_.raw_residuals(static_cast<int>(t), predicted[t], position, force);
    set_noise(position, force);
  }

  std::vector<Prediction> predictions() {
    FitOptions all = fit_options_;
    all.trials.resize(experiment().trials.size());
    std::iota(all.trials.begin(), all.trials.end(), 0);
    Evaluator with = evaluator();
    return with.predictions(std::span(&result_.summary.hypothesis, 1), all).front();
  }

  // To the bottom: an interval's end is a matter of nats, not of a share of the cost.
  void polish() {
    Evaluator with = evaluator();
    result_.summary = fit(with, result_.summary.hypothesis, fit_options_);
    FitOptions fine = fit_options_;
    fine.tolerance = std::min(fine.tolerance, 0.01 / std::max(1.0, result_.summary.cost));
    result_.summary = fit(with, result_.summary.hypothesis, fine);
    result_.spread = std::sqrt(std::max(1.0, 2.0 * result_.summary.cost / std::max(1, samples())));
  }

  // True: a better fit turned up on the way, and the intervals must be done again.
  bool profile_all() {
    result_.parameters.clear();
    for (int p = 0; p < asked_ && !stopped(); ++p) {
      say("profiling " + described(result_.summary.hypothesis.free[p]).name,
          0.4 + 0.55 * p / asked_);
      Evaluator with = evaluator();
      Profile found = profile(with, result_.summary, p, fit_options_,
                              deviance95 * result_.spread * result_.spread);
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
    const auto predicted = predictions();
    for (std::size_t t = 0; t < predicted.size(); ++t) {
      double sum = 0.0;
      int count = 0;
      const int trial = static_cast<int>(t);
      const Eigen::MatrixXd r = data_.scaled_residual(trial, predicted[t]);
      for (const double x : r.reshaped())
        if (std::isfinite(x)) {
          sum += x * x;
          ++count;
        }
      result_.trials.push_back({experiment().trials[t].name,
                                std::ranges::find(check_, trial) != check_.end(),
                                count > 0 ? std::sqrt(sum / count) : 0.0});
    }
  }

  ParameterFitOptions options_;
  Admission admission_;
  std::vector<Hypothesis> starts_;
  DataSet data_;
  FitOptions fit_options_;
  std::vector<int> check_;
  Corrections corrections_;
  std::unique_ptr<Simulator> simulator_;
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
