#include "discrepancy/diagnosis.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>

#include "discrepancy/missing_force.h"
#include "discrepancy/symptoms.h"
#include "discrepancy/trial_split.h"
#include "plant/effects.h"

namespace pedicel::discrepancy {

namespace {

// Nats that a named cause must be worth: an effect of twice the size that could just be seen (10
// noise units in all) is worth 50 less some 15 for its parameters; two honest solvers differ by up
// to 15.
constexpr double enough_evidence = 25.0;
// Of the noise variance, an excess that is no sign of a missing effect.
constexpr double small_excess = 0.01;
constexpr double clear_margin = 5.0;    // nats by which a rival must lose
constexpr double margin_share = 0.01;   // and of the gain: our model errors scale with it
constexpr double most_margin = 20.0;    // nats, of that
constexpr double allowed_error = 0.15;  // of the noise, RMS, before it is corrected for
constexpr double numerical_limit = 0.5;
constexpr double left_uncorrected = 0.3;  // of our numerical error, and of the data's own
constexpr double least_gain = 0.2;        // on trials kept back
// Logarithm of a factor: two honest solvers' moduli differ by up to 0.3 % on the same data.
constexpr double least_parameter_change = 0.005;
constexpr int most_causes = 3;
constexpr int least_outliers = 12;  // wild samples that are worth a name
constexpr double interval95 = 1.96;

std::string text(const char* format, double a, double b = 0.0) {
  char buffer[160];
  std::snprintf(buffer, sizeof buffer, format, a, b);
  return buffer;
}

/// One diagnosis on its way from the data to the verdict.
class Procedure {
 public:
  Procedure(const Experiment& experiment, const DiagnosisOptions& options)
      : options_(options), start_(std::chrono::steady_clock::now()) {
    result_.admission = admit(experiment);
  }

  Diagnosis run() {
    if (!result_.admission.refusal.empty()) {
      result_.verdict.outcome = Outcome::bad_data;
      result_.verdict.remainder = result_.admission.refusal;
      return finished();
    }
    prepare();
    fit_baseline();
    if (result_.verdict.outcome == Outcome::numerical) return finished();
    look();
    if (result_.before.raised) {
      search();
      extend();
    }
    conclude();
    return finished();
  }

 private:
  const Experiment& experiment() const { return result_.admission.experiment; }
  bool stopped() const { return options_.stop && *options_.stop; }
  void say(const std::string& what, double share) {
    if (options_.progress) options_.progress(what, share);
  }
  void note(const std::string& sentence) {
    result_.steps.push_back(sentence);
    if (options_.note) options_.note(sentence);
  }
  void note_fit(const std::string& what, const FitSummary& fit) {
    std::string sentence =
        what + text(": %.6g per sample", 2.0 * fit.cost / std::max(1, samples()));
    for (int p = 0; p < fit.hypothesis.size(); ++p) {
      const FreeParameter& free = fit.hypothesis.free[p];
      sentence +=
          ", " + fit.hypothesis.effects[free.effect].name + " " + free.name +
          text(" %.5g +- %.2g", fit.hypothesis.value(p),
               fit.standard_error[p] * (free.logarithmic ? fit.hypothesis.value(p) : free.scale));
    }
    note(sentence + ".");
  }

  // ---- Steps 0 and 1 ----------------------------------------------------------------------------

  void prepare() {
    say("reading the noise", 0.0);
    for (const std::string& remark : result_.admission.remarks) note(remark + ".");
    data_ = std::make_unique<DataSet>(experiment());
    std::vector<Series> position, force;
    measured_series(experiment(), position, force);
    set_noise(position, force);
    const TrialSplit split = split_trials(experiment());
    result_.fit_trials = split.fit;
    result_.check_trials = split.check;
    fit_options_.trials = split.fit;
    scales_ = scales_of(experiment());
    causes_ = candidate_causes(experiment(), scales_);
    result_.numerics = {experiment().plant.distance, 1.0 / 480.0};
  }

  void set_noise(const std::vector<Series>& position, const std::vector<Series>& force) {
    const StatedNoise& stated = experiment().noise;
    const auto choose = [](const std::vector<Series>& series, double std) {
      Noise noise = estimate_noise(series, std);
      // Motion that no window is free of can only raise the estimate, and a marker that stands
      // still scatters less than one that moves: what is stated bounds it on both sides.
      if (std > 0.0 && (noise.std > 1.2 * std || noise.std < std)) {
        const double share = std / noise.std;
        noise.std = std;
        for (double& innovation : noise.innovation) innovation *= share;
      }
      return noise;
    };
    result_.position_noise = choose(position, stated.position_std.value_or(0.0));
    result_.force_noise = choose(force, stated.force_std.value_or(0.0));
    data_->set_noise(result_.position_noise, result_.force_noise);
  }

  void make_workers() {
    simulators_.clear();
    workers_.clear();
    for (int i = 0; i < options_.threads; ++i) {
      simulators_.push_back(std::make_unique<Simulator>(experiment(), result_.numerics, 1));
      workers_.emplace_back(*simulators_.back(), *data_, corrections());
    }
    wide_ = std::make_unique<Simulator>(experiment(), result_.numerics, options_.threads);
  }
  const Corrections* corrections() const {
    return corrections_.empty() ? nullptr : &corrections_;
  }
  Evaluator wide() { return Evaluator(*wide_, *data_, corrections()); }
  void count_simulations() {
    for (const auto& simulator : simulators_)
      result_.verdict.simulations += simulator->simulations();
    if (wide_) result_.verdict.simulations += wide_->simulations();
  }

  // Parameters that move nothing by a tenth of the noise when they change by a tenth.
  Hypothesis seen_baseline() {
    const Hypothesis all = baseline();
    Evaluator evaluator = wide();
    std::vector<Hypothesis> models{all};
    for (int p = 0; p < all.size(); ++p) {
      models.push_back(all);
      models.back().set_value(p, 1.1);
    }
    const Eigen::MatrixXd r = evaluator.residuals(models, fit_options_);
    Hypothesis seen;
    for (int p = 0; p < all.size(); ++p) {
      if ((r.col(p + 1) - r.col(0)).cwiseAbs().maxCoeff() < 0.1) {
        result_.unseen.push_back(all.effects[p].name);
        continue;
      }
      Hypothesis one;
      one.effects.push_back(all.effects[p]);
      one.free.push_back(all.free[p]);
      one.free.back().effect = 0;
      seen.add(one);
    }
    return seen;
  }

  void fit_baseline() {
    say("refitting modulus, density and damping", 0.02);
    make_workers();
    Hypothesis start = seen_baseline();
    Evaluator evaluator = wide();
    if (start.size() > 0) {
      std::vector<Hypothesis> starts;
      for (const double factor : {1.0, 0.4, 0.55, 0.7, 0.85, 1.2, 1.5, 2.2}) {
        starts.push_back(start);
        starts.back().set_value(0, factor);
      }
      FitOptions early = fit_options_;
      early.horizon = 0.3;
      start = starts[scan(evaluator, starts, early).best];
    }
    constexpr std::array horizons{0.3, 1.0};
    note_noise();
    result_.base = fit_growing(evaluator, start, fit_options_, horizons);
    note_fit("Baseline", result_.base);
    refine();
    renew_noise(result_.base);
    Evaluator again = wide();
    result_.base = fit(again, result_.base.hypothesis, fit_options_);
    note_noise();
    note_fit("Baseline", result_.base);
  }

  void note_noise() {
    const auto said = [](const Noise& noise) {
      return text("%.3g, lag-one correlation %.2g", noise.std, noise.correlation());
    };
    note("Noise of positions (m) " + said(result_.position_noise) + "; of forces (N) " +
         said(result_.force_noise) + ".");
  }

  // Mesh and step, until our own error is a small part of the noise, or until that costs too much.
  void refine() {
    for (int round = 0;; ++round) {
      say("checking our own numerical error", 0.05 + 0.03 * round);
      const NumericsCheck check =
          check_numerics(experiment(), *data_, result_.base, result_.numerics, fit_options_,
                         options_.threads, result_.verdict.simulations);
      result_.numerical_error = check.largest;
      numerical_ = left_uncorrected * check.correction;
      parameter_shift_ = check.parameter_shift;
      if (check.largest <= allowed_error || round == 3) {
        corrections_ = check.corrections;
        if (check.largest > numerical_limit && !is_drowned(check)) {
          result_.verdict.outcome = Outcome::numerical;
          result_.verdict.remainder = text(
              "half the step and half the mesh still move the prediction by %.2g times the "
              "noise",
              check.largest);
        }
        break;
      }
      note(text("Numerical error %.3g by step, %.3g by mesh", check.by_step, check.by_mesh));
      count_simulations();
      result_.numerics = refined(check);
      make_workers();
      Evaluator evaluator = wide();
      result_.base = fit(evaluator, result_.base.hypothesis, fit_options_);
    }
    note(text("Nodes every %.3g mm and a step of %.3g ms", 1e3 * result_.numerics.distance,
              1e3 * result_.numerics.dt) +
         text(": the numerical error was %.2g of the noise and was corrected for.",
              result_.numerical_error));
    count_simulations();
    make_workers();
    result_.base.hypothesis.add(mesh_freedom());
    Evaluator evaluator = wide();
    result_.base = fit(evaluator, result_.base.hypothesis, fit_options_);
  }

  // Against a residual many times larger a numerical error above the noise does not matter.
  bool is_drowned(const NumericsCheck& check) const {
    const double rms = std::sqrt(2.0 * result_.base.cost / std::max(1, samples()));
    return check.largest < 0.1 * rms;
  }

  void renew_noise(const FitSummary& model) {
    Evaluator evaluator = wide();
    std::vector<Series> position, force;
    const auto predicted =
        evaluator.predictions(std::span(&model.hypothesis, 1), all_trials()).front();
    for (int t = 0; t < trial_count(); ++t) data_->raw_residuals(t, predicted[t], position, force);
    set_noise(position, force);
  }

  // ---- Step 2 -----------------------------------------------------------------------------------

  void look() {
    say("looking for anything that is wrong", 0.15);
    Evaluator evaluator = wide();
    result_.directions = directions_of(evaluator, result_.base, causes_, fit_options_);
    result_.before = judge(result_.directions, result_.base, numerical_, options_.seed);
    if (could_be_junctions(result_.before) && quiet_with_junctions(result_.base))
      result_.before.raised = false;
    result_.best = result_.base;
    note_directions(result_.directions, result_.before);
  }

  // What loud alarms are about no mesh hides.
  static bool could_be_junctions(const Alarm& alarm) {
    return alarm.raised && alarm.statistic < 30.0;
  }

  // Whether nothing is left once the junctions may give a little; then they do.
  bool quiet_with_junctions(FitSummary& model) {
    const Hypothesis junctions = junction_freedom(experiment());
    if (junctions.size() == 0) return false;
    Hypothesis with = model.hypothesis;
    with.add(junctions);
    Evaluator evaluator = wide();
    FitSummary found = fit(evaluator, with, fit_options_);
    std::vector<Direction> directions = directions_of(evaluator, found, causes_, fit_options_);
    const Alarm alarm = judge(directions, found, numerical_, options_.seed);
    note_fit("With junctions that give a little", found);
    note_directions(directions, alarm);
    if (alarm.raised) return false;
    note("What is left is below what the plant file's mesh resolves at the junctions.");
    model = std::move(found);
    return true;
  }

  void note_directions(std::vector<Direction> directions, const Alarm& alarm) {
    note(text("Largest directed statistic %.3g, level %.3g.", alarm.statistic, alarm.level));
    std::ranges::stable_sort(directions, [](const Direction& a, const Direction& b) {
      return std::abs(a.statistic) > std::abs(b.statistic);
    });
    for (std::size_t i = 0; i < std::min<std::size_t>(8, directions.size()); ++i)
      note("  " + directions[i].cause +
           text(": %.3g, of which our own error may be %.3g", directions[i].statistic,
                directions[i].systematic));
  }

  // ---- Steps 4 to 7 -----------------------------------------------------------------------------

  RefitOptions refit_options(double from, double to, const std::string& what) {
    RefitOptions refit{fit_options_, {}, options_.stop};
    refit.progress = [this, from, to, what](double share) {
      say(what, from + share * (to - from));
    };
    return refit;
  }

  void search() {
    result_.ranking = refit_all(workers_, result_.base, causes_, result_.directions,
                                refit_options(0.2, 0.6, "refitting candidates"));
    for (std::size_t i = 0; i < std::min<std::size_t>(6, result_.ranking.size()); ++i)
      note_fit(text("Evidence %.5g", result_.ranking[i].evidence), result_.ranking[i].fit);
    if (result_.ranking.empty() || result_.ranking.front().evidence < enough_evidence) return;
    result_.best = result_.ranking.front().fit;
    chain_ = {result_.ranking.front()};
  }

  // Adds causes while something is left.
  void extend() {
    while (!chain_.empty() && static_cast<int>(chain_.size()) < most_causes && !stopped()) {
      Evaluator evaluator = wide();
      std::vector<Direction> directions =
          directions_of(evaluator, result_.best, causes_, fit_options_);
      result_.after = judge(directions, result_.best, numerical_, options_.seed);
      note_directions(directions, result_.after);
      if (!result_.after.raised) return;
      if (could_be_junctions(result_.after) && quiet_with_junctions(result_.best)) {
        result_.after.raised = false;
        return;
      }
      const double from = 0.5 + 0.15 * static_cast<double>(chain_.size());
      const std::vector<Cause> likely = promising(directions);
      const std::vector<Candidate> next =
          refit_all(workers_, result_.best, likely, directions,
                    refit_options(from, from + 0.15, "looking for another cause"));
      if (next.empty() || next.front().evidence < enough_evidence) return;
      chain_.push_back(next.front());
      result_.best = next.front().fit;
    }
    if (chain_.empty()) return;
    Evaluator evaluator = wide();
    std::vector<Direction> directions =
        directions_of(evaluator, result_.best, causes_, fit_options_);
    result_.after = judge(directions, result_.best, numerical_, options_.seed);
  }

  // Causes whose direction shows in what is left; the loudest dozen.
  std::vector<Cause> promising(const std::vector<Direction>& directions) const {
    const std::vector<double> promise = promise_of(causes_, directions);
    std::vector<std::pair<double, const Cause*>> order;
    for (std::size_t i = 0; i < causes_.size(); ++i) order.emplace_back(promise[i], &causes_[i]);
    std::ranges::stable_sort(order, [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<Cause> chosen;
    for (std::size_t i = 0; i < std::min<std::size_t>(12, order.size()); ++i)
      chosen.push_back(*order[i].second);
    return chosen;
  }

  // ---- Step 9 -----------------------------------------------------------------------------------

  void conclude() {
    say("writing the verdict", 0.95);
    Verdict& verdict = result_.verdict;
    // What is left of the best model is the best sample of the noise.
    if (!chain_.empty()) renew_noise(result_.best);
    predict();
    measure_errors();
    symptoms_ = symptoms(experiment(), *data_, result_.predictions[refitted]);
    if (!result_.before.raised) {
      conclude_parameters();
    } else if (chain_.empty() && excess(result_.base) < small_excess) {
      conclude_parameters();
      verdict.remainder = text(
          "a steady difference of %.3g noise units in all, which no cause explains and no single "
          "sample shows",
          result_.before.statistic);
    } else if (chain_.empty()) {
      verdict.outcome = Outcome::unknown;
    } else {
      conclude_causes();
    }
    if (verdict.outcome == Outcome::unknown) name_nothing();
    conclude_outliers();
    report_parameters();
    what_could_hide();
    choose_next();
  }

  // What was fitted but does not explain the data is told in words, not as a cause.
  void name_nothing() {
    Verdict& verdict = result_.verdict;
    std::string nearest;
    for (const NamedCause& cause : verdict.causes)
      nearest += (nearest.empty() ? "" : " with ") + cause.name;
    verdict.causes.clear();
    if (!nearest.empty()) verdict.remainder += "; the nearest known cause is " + nearest;
    look_for_force();
  }

  // Where, when and of what kind the force is that no cause stands for.
  void look_for_force() {
    say("looking for a force that is missing", 0.96);
    Evaluator evaluator = wide();
    MissingForceOptions options;
    options.fit = fit_options_;
    options.check = result_.check_trials;
    options.threads = options_.threads;
    options.note = [this](const std::string& sentence) { note(sentence); };
    const MissingForce force = infer_missing_force(evaluator, result_.base, options);
    result_.verdict.simulations += force.simulations;
    std::string& remainder = result_.verdict.remainder;
    if (!remainder.empty()) remainder += ". ";
    remainder +=
        force.found ? force.sentence() : "No force at a marker explains it. Do not extrapolate.";
    if (force.fit.why == "not run") return;
    std::vector<Direction> left = directions_of(evaluator, force.fit, causes_, fit_options_);
    const Alarm alarm = judge(left, force.fit, numerical_, options_.seed);
    note(text("With that force the largest directed statistic is %.3g, level %.3g.",
              alarm.statistic, alarm.level));
  }

  void choose_next() {
    Verdict& verdict = result_.verdict;
    if (verdict.outcome == Outcome::ambiguous) {
      say("choosing the next experiment", 0.97);
      std::vector<Hypothesis> rivals;
      for (const Candidate& candidate : result_.ranking)
        for (const NamedCause& cause : verdict.causes)
          if (cause.name == candidate.cause && rivals.size() < 4) {
            rivals.push_back(candidate.fit.hypothesis);
            rivals.back().name = candidate.cause;
          }
      result_.next = next_experiment(experiment(), *data_, rivals,
                                     {result_.numerics, options_.threads}, verdict.simulations);
    } else if (verdict.outcome == Outcome::unknown) {
      result_.next = next_look(experiment(), *data_, result_.predictions[refitted]);
    }
    verdict.next_experiment = result_.next.sentence;
  }

  void predict() {
    Evaluator evaluator = wide();
    Hypothesis plain;
    const std::array<Hypothesis, model_count> models{plain, result_.base.hypothesis,
                                                     result_.best.hypothesis};
    auto all = evaluator.predictions(models, all_trials());
    for (int m = 0; m < model_count; ++m) result_.predictions[m] = std::move(all[m]);
  }

  double error_over(const std::vector<int>& trials, Model model) const {
    double sum = 0.0;
    int count = 0;
    for (const int t : trials) {
      const Eigen::MatrixXd r = data_->scaled_residual(t, result_.predictions[model][t]);
      for (const double x : r.reshaped())
        if (std::isfinite(x)) {
          sum += x * x;
          ++count;
        }
    }
    return count > 0 ? std::sqrt(sum / count) : 0.0;
  }

  void measure_errors() {
    const auto measure = [&](const std::vector<int>& trials, Errors& errors) {
      if (trials.empty()) return;
      errors.nominal = error_over(trials, nominal);
      errors.refitted = error_over(trials, refitted);
      errors.extended = error_over(trials, extended);
    };
    measure(result_.fit_trials, result_.verdict.fit);
    measure(result_.check_trials, result_.verdict.check);
    const Errors& check = result_.verdict.check;
    if (!chain_.empty() && check.refitted && *check.refitted > 1.0)
      result_.verdict.gain = (*check.refitted - *check.extended) / (*check.refitted - 1.0);
  }

  Estimate estimate_of(const FitSummary& fit, int p) const {
    const FreeParameter& free = fit.hypothesis.free[p];
    const double u = free.to_unknown(fit.hypothesis.value(p));
    double error = interval95 * fit.standard_error[p] * spread(fit);
    if (p < parameter_shift_.size()) error += left_uncorrected * std::abs(parameter_shift_[p]);
    return {free.to_value(u), free.to_value(u - error), free.to_value(u + error), free.unit};
  }
  // Where more than noise is left, intervals are wider.
  double spread(const FitSummary& fit) const {
    return std::sqrt(std::max(1.0, 2.0 * fit.cost / std::max(1, samples())));
  }

  // Modulus, density or damping, where nothing else is wrong and their interval leaves out 1.
  void conclude_parameters() {
    Verdict& verdict = result_.verdict;
    for (int p = 0; p < result_.base.hypothesis.size(); ++p) {
      const FreeParameter& free = result_.base.hypothesis.free[p];
      if (free.name != "factor") continue;
      const double u = free.to_unknown(result_.base.hypothesis.value(p));
      double error = result_.base.standard_error[p];
      const double shift = p < parameter_shift_.size() ? std::abs(parameter_shift_[p]) : 0.0;
      // Three parameters share the few false alarms that are allowed.
      if (std::abs(u) < 3.5 * error + shift + least_parameter_change) continue;
      NamedCause cause;
      cause.name = result_.base.hypothesis.effects[free.effect].name;
      cause.parameters["factor"] = {estimate_of(result_.base, p)};
      cause.evidence = 0.5 * std::pow(u / error, 2);
      cause.because =
          "The refitted value is " +
          text("%.4g times the nominal one, and nothing else is needed.", free.to_value(u));
      verdict.causes.push_back(cause);
    }
    verdict.outcome = verdict.causes.empty() ? Outcome::adequate : Outcome::named;
  }

  NamedCause named(const Candidate& candidate, const FitSummary& fit, int first_effect) const {
    NamedCause cause;
    cause.name = candidate.cause;
    cause.evidence = candidate.evidence;
    const plant::Effect& effect = fit.hypothesis.effects[first_effect];
    cause.where = effect.place;
    if (cause.name == "base_compliance") cause.where = root_place();
    cause.words = effect.words;
    for (int p = 0; p < fit.hypothesis.size(); ++p) {
      const FreeParameter& free = fit.hypothesis.free[p];
      if (free.effect != first_effect || free.name == "at") continue;
      cause.parameters[free.name].push_back(estimate_of(fit, p));
    }
    for (const auto& [name, numbers] : effect.numbers)
      if (!cause.parameters.contains(name))
        for (const double x : numbers)
          cause.parameters[name].push_back({x, x, x, unit_of(cause.name, name)});
    cause.because = because(cause.name);
    return cause;
  }

  // Wild samples were left out before the fit; they are named beside what else was found.
  void conclude_outliers() {
    const Admission& admission = result_.admission;
    if (admission.outliers < least_outliers) return;
    Verdict& verdict = result_.verdict;
    // Among rivals, or where nothing is known, they would read as one more explanation.
    if (verdict.outcome != Outcome::adequate && verdict.outcome != Outcome::named) return;
    NamedCause cause;
    cause.name = "outliers";
    const double count = admission.outliers, fraction = admission.outlier_fraction();
    const double error = interval95 * std::sqrt(count) / admission.samples;
    cause.parameters["fraction"] = {
        {fraction, std::max(0.0, fraction - error), fraction + error, "1"}};
    cause.because = std::to_string(admission.outliers) +
                    " samples stand far from their neighbours, each by itself; they were left out.";
    // Each lies 10 deviations out: as Gaussian noise it would cost 50 nats.
    cause.evidence = 50.0 * count;
    verdict.causes.push_back(cause);
    verdict.outcome = Outcome::named;
  }

  // The end of a curve that is clamped.
  plant::CurvePlace root_place() const {
    const plant::PlantFile& plant = experiment().plant;
    plant::CurvePlace nearest;
    double least = std::numeric_limits<double>::infinity();
    for (const plant::PlantCurve& curve : plant.curves)
      for (const double at : {0.0, 1.0}) {
        const Vec3& end = at == 0.0 ? curve.points.front() : curve.points.back();
        if ((end - plant.root).norm() >= least) continue;
        least = (end - plant.root).norm();
        nearest = {curve.name, at, {}};
      }
    return nearest;
  }

  // What is seen without the cause and gone with it.
  std::string because(const std::string& cause) const {
    const auto is_about = [&](const Symptom& symptom) {
      return symptom.shows() &&
             std::ranges::find(symptom.speaks_for, cause) != symptom.speaks_for.end();
    };
    const auto found = std::ranges::find_if(symptoms_, is_about);
    std::string sentence = found == symptoms_.end() ? "" : found->sentence + " ";
    return sentence + "With " + plain_name(cause) +
           text(" the residual falls from %.3g to %.3g times the noise",
                result_.verdict.fit.refitted.value_or(0.0),
                result_.verdict.fit.extended.value_or(0.0)) +
           " in the fitted trials.";
  }

  void conclude_causes() {
    Verdict& verdict = result_.verdict;
    const int base_effects = static_cast<int>(result_.base.hypothesis.effects.size());
    for (std::size_t c = 0; c < chain_.size(); ++c)
      verdict.causes.push_back(named(chain_[c], result_.best, base_effects + static_cast<int>(c)));
    verdict.outcome = Outcome::named;
    const Candidate& best = result_.ranking.front();
    const double margin = clear_margin + std::min(margin_share * best.gain, most_margin);
    for (std::size_t i = 1; i < result_.ranking.size(); ++i) {
      const Candidate& rival = result_.ranking[i];
      const double behind = best.evidence - rival.evidence;
      if (!rival.whole || rival.evidence < 0.0) break;
      const bool beaten = behind > margin && !wins_without_a_trial(rival, best);
      if (beaten || chain_.size() > 1 || contains(rival, best)) {
        verdict.rivals.push_back({rival.cause, behind});
        continue;
      }
      verdict.causes.push_back(named(rival, rival.fit, base_effects));
      verdict.outcome = Outcome::ambiguous;
    }
    judge_remainder();
    // A cause that does nothing for trials that it was not fitted to is none.
    if (verdict.outcome == Outcome::named && verdict.gain && *verdict.gain < least_gain) {
      verdict.outcome = Outcome::unknown;
      verdict.remainder = "what was fitted does not carry over to the trials kept back";
    }
  }

  // A rival that has the best one as a special case, and needs more parameters to do no better, is
  // no other explanation: a wind of no speed is drag.
  static bool contains(const Candidate& rival, const Candidate& best) {
    static const std::vector<std::pair<std::string, std::string>> special{
        {"leaf_drag", "wind"}, {"leaf_drag", "gust"}, {"wind", "gust"}};
    return std::ranges::find(special, std::pair(best.cause, rival.cause)) != special.end() &&
           rival.evidence < best.evidence;
  }

  // Whether leaving out one of the trials would turn the order round.
  bool wins_without_a_trial(const Candidate& rival, const Candidate& best) const {
    if (result_.fit_trials.size() < 3) return false;
    const double all = rival.fit.cost - best.fit.cost;
    Eigen::Index row = 0;
    for (const int t : result_.fit_trials) {
      const Eigen::Index size = data_->size(std::span(&t, 1));
      const double here = 0.5 * (rival.fit.residual.segment(row, size).squaredNorm() -
                                 best.fit.residual.segment(row, size).squaredNorm());
      if (all - here < -clear_margin) return true;
      row += size;
    }
    return false;
  }

  // Mean square of what is left beyond the noise, in units of it.
  double excess(const FitSummary& model) const {
    return 2.0 * model.cost / std::max(1, samples()) - 1.0;
  }

  void judge_remainder() {
    Verdict& verdict = result_.verdict;
    if (!result_.after.raised) return;
    const double excess_before = result_.base.cost - 0.5 * samples();
    const double excess_after = result_.best.cost - 0.5 * samples();
    const double left = excess_after / std::max(excess_before, 1.0);
    verdict.remainder = text("%.2g %% of what the refitted model left above the noise",
                             100.0 * std::max(left, 0.0));
    if (left > 0.05 && excess(result_.best) > small_excess) verdict.outcome = Outcome::unknown;
  }

  void report_parameters() {
    const FitSummary& fit = result_.best;
    for (int p = 0; p < fit.hypothesis.size(); ++p) {
      const FreeParameter& free = fit.hypothesis.free[p];
      const std::string& effect = fit.hypothesis.effects[free.effect].name;
      const plant::MaterialValues& material = experiment().plant.material;
      const std::optional<double> value = effect == "youngs_modulus" ? material.youngs_modulus
                                          : effect == "density"      ? material.density
                                          : effect == "damping_time" ? material.damping_time
                                                                     : std::nullopt;
      if (!value) continue;
      Estimate estimate = estimate_of(fit, p);
      for (double* x : {&estimate.value, &estimate.low, &estimate.high}) *x *= *value;
      estimate.unit = effect == "youngs_modulus" ? "Pa" : effect == "density" ? "kg/m3" : "s";
      result_.verdict.parameters[effect] = estimate;
    }
  }

  void what_could_hide() {
    for (const Cause& cause : causes_) {
      CouldHide least;
      least.name = cause.name;
      double best = 0.0;
      for (const Direction& direction : result_.directions) {
        if (direction.cause != cause.name || direction.change.norm() < best) continue;
        best = direction.change.norm();
        least.smallest_seen = smallest_seen(
            direction, result_.before.level + std::abs(direction.systematic), least.parameter);
      }
      least.unit = unit_of(cause.name, least.parameter);
      result_.verdict.could_hide.push_back(least);
    }
  }

  Diagnosis finished() {
    count_simulations();
    result_.verdict.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    return std::move(result_);
  }

  int trial_count() const { return static_cast<int>(experiment().trials.size()); }
  int samples() const { return data_->samples(fit_options_.trials); }
  FitOptions all_trials() const {
    FitOptions all = fit_options_;
    all.trials.clear();
    for (int t = 0; t < trial_count(); ++t) all.trials.push_back(t);
    return all;
  }

  DiagnosisOptions options_;
  std::chrono::steady_clock::time_point start_;
  Diagnosis result_;
  Scales scales_;
  std::vector<Cause> causes_;
  FitOptions fit_options_;
  std::unique_ptr<DataSet> data_;
  Corrections corrections_;
  Eigen::VectorXd numerical_, parameter_shift_;
  std::vector<std::unique_ptr<Simulator>> simulators_;
  std::unique_ptr<Simulator> wide_;
  std::vector<Evaluator> workers_;
  std::vector<Symptom> symptoms_;  // of the refitted model
  std::vector<Candidate> chain_;   // causes found so far, in their order
};

}  // namespace

Diagnosis diagnose(const Experiment& experiment, const DiagnosisOptions& options) {
  return Procedure(experiment, options).run();
}

plant::PlantFile extended_plant(const Experiment& experiment, const Hypothesis& hypothesis) {
  plant::PlantFile plant = experiment.plant;
  for (const plant::Effect& effect : hypothesis.effects) {
    const plant::EffectKind* kind = plant::find_effect(effect.name);
    if (kind && kind->home == plant::EffectHome::plant) plant.effects.push_back(effect);
  }
  return plant;
}

}  // namespace pedicel::discrepancy
