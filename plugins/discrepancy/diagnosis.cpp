#include "discrepancy/diagnosis.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>

#include "discrepancy/baseline_start.h"
#include "discrepancy/cause_names.h"
#include "discrepancy/coarse_model.h"
#include "discrepancy/conclusion.h"
#include "discrepancy/diagnosis_log.h"
#include "discrepancy/evidence.h"
#include "discrepancy/fit_setup.h"
#include "discrepancy/held_out.h"
#include "discrepancy/promise.h"
#include "discrepancy/sentence.h"
#include "discrepancy/trial_split.h"
#include "discrepancy/way_back.h"
#include "plant/effects.h"

namespace pedicel::discrepancy {

namespace {

constexpr double numerical_limit = 0.5;  // of the noise, RMS
// Of the gain of a cause, what another of its family must bring to be one.
constexpr double family_share = 0.5;
constexpr double beyond_linear = 4.0;  // times that a cause may gain what its direction promises
constexpr int most_causes = 3;
constexpr std::size_t most_rivals = 4;   // that another trial should part
constexpr int junction_iterations = 15;  // a small change converges in a few, or is no small one
// Nats that one cause, and several together, do not explain to the last by chance.
constexpr double beyond_doubt = 300.0, beyond_doubt_together = 3000.0;
// Of a trial kept back: deviations, and a share of the noise's square, above which it is missed.
constexpr double least_objection = 6.0, small_objection = 0.1;
// Where the best known cause leaves so much (mean square in noise units) a force from outside the
// list is asked for. It takes the place of known causes where it leaves so much less.
constexpr double much_left = 4.0, left_by_force = 1.0 / 3.0;
constexpr double far_from_data = 2.0;  // mean square in noise units
// What one force may gain less than several causes: nats, or a share of theirs.
constexpr double force_margin = 5.0, force_share = 0.05;
// Of the causes' gain, what a free force must promise, by its linear response, for its law to be
// looked for.
constexpr double promising_force = 0.5;

/// One diagnosis on its way from the data to the verdict.
class Procedure {
 public:
  Procedure(const Experiment& experiment, const DiagnosisOptions& options)
      : given_(experiment),
        options_(options),
        start_(std::chrono::steady_clock::now()),
        log_(options.progress, options.note, result_.steps) {
    result_.admission = admit(experiment);
  }

  Diagnosis run() {
    if (result_.admission.refusal.empty()) {
      prepare();
      fit_baseline();
      if (result_.verdict.outcome != Outcome::numerical && !stopped()) decide();
    } else {
      result_.verdict.outcome = Outcome::bad_data;
      result_.verdict.remainder = result_.admission.refusal;
    }
    return finished();
  }

  /// With another trial kept back, where the diagnosis should begin anew.
  const std::optional<Experiment>& exchanged() const { return exchanged_; }

 private:
  void decide() {
    look();
    const bool wrong = result_.before.raised || is_pulled(result_.base.hypothesis);
    if (!wrong && !stopped()) look_at_check_trials();
    if (objecting_ >= 0) {
      Experiment other = given_;
      const TrialSplit split{result_.fit_trials, result_.check_trials};
      if (exchange_trials(other, split, objecting_)) {
        log_.note("It is fitted in place of another one, and all begins anew.");
        exchanged_ = std::move(other);
        result_.exchanged = experiment().trials[objecting_].name;
        return;
      }
    }
    if (wrong) {
      search();
      extend();
    }
    if (!stopped()) conclude_all();
  }

  const Experiment& experiment() const { return result_.admission.experiment; }
  const FitOptions& fit_options() const { return setup_->options(); }
  bool stopped() const { return options_.stop && *options_.stop; }

  // ---- Steps 0 and 1 ----------------------------------------------------------------------------

  void prepare() {
    log_.say("reading the noise", 0.0);
    for (const std::string& remark : result_.admission.remarks) log_.note(remark + ".");
    // A marker that stands still scatters less than one that moves: what is stated is a lower
    // bound, too.
    setup_ = std::make_unique<FitSetup>(experiment(), options_.threads, NoiseRule{}, options_.stop);
    findings_.data = &setup_->data();
    findings_.fit_trials = result_.fit_trials = fit_options().trials;
    result_.check_trials = setup_->check_trials();
    causes_ = candidate_causes(experiment(), scales_of(experiment()));
  }

  void refit_base() {
    Evaluator evaluator = setup_->evaluator();
    result_.base = fit(evaluator, result_.base.hypothesis, fit_options());
  }

  void fit_baseline() {
    log_.say("refitting modulus, density and damping", 0.02);
    Evaluator evaluator = setup_->evaluator();
    const Hypothesis start = baseline_start(evaluator, fit_options(), result_.unseen);
    constexpr std::array horizons{0.3, 1.0};
    log_.noise(setup_->data());
    result_.base = fit_growing(evaluator, start, fit_options(), horizons);
    log_.fit("Baseline", result_.base, setup_->samples());
    refine();
    setup_->renew_noise(result_.base.hypothesis);
    Evaluator again = setup_->evaluator();
    if (add_plainly_seen(again, fit_options(), result_.unseen, result_.base.hypothesis)) {
      log_.note("With the noise as it is read now these data see more of the parameters.");
      refit_base();
      setup_->renew_noise(result_.base.hypothesis);
    }
    refit_base();
    log_.noise(setup_->data());
    log_.fit("Baseline", result_.base, setup_->samples());
  }

  void refine() {
    const NumericsCheck check = setup_->refine(
        result_.base,
        {[this](int round) { log_.say("checking our own numerical error", 0.05 + 0.03 * round); },
         [this](const NumericsCheck& coarse) {
           log_.note(
               text("Numerical error %.3g by step, %.3g by mesh", coarse.by_step, coarse.by_mesh));
         }});
    result_.numerics = setup_->numerics();
    result_.numerical_error = check.largest;
    numerical_ = left_uncorrected * check.correction;
    findings_.parameter_shift = check.parameter_shift;
    if (check.largest > numerical_limit && !is_drowned(check)) {
      result_.verdict.outcome = Outcome::numerical;
      result_.verdict.remainder =
          text("half the step and half the mesh still move the prediction by %.2g times the noise",
               check.largest);
    }
    log_.note(text("Nodes every %.3g mm and a step of %.3g ms", 1e3 * result_.numerics.distance,
                   1e3 * result_.numerics.dt) +
              text(": the numerical error was %.2g of the noise and was corrected for.",
                   result_.numerical_error));
    setup_->renew();
    result_.base.hypothesis.add(mesh_freedom());
    refit_base();
  }

  // Against a residual many times larger a numerical error above the noise does not matter.
  bool is_drowned(const NumericsCheck& check) const {
    const double rms = std::sqrt(2.0 * result_.base.cost / std::max(1, setup_->samples()));
    return check.largest < 0.1 * rms;
  }

  // ---- Step 2 -----------------------------------------------------------------------------------

  void look() {
    log_.say("looking for anything that is wrong", 0.15);
    coarse_at(result_.base);
    result_.directions = directions_at(result_.base);
    result_.before = judged(result_.directions, result_.base);
    if (could_be_junctions(result_.before) && quiet_with_junctions(result_.base)) {
      // The base has more numbers now; a search for what pulled it starts from there.
      coarse_at(result_.base);
      result_.directions = directions_at(result_.base);
      result_.before = judged(result_.directions, result_.base);
      result_.before.raised = false;
    }
    result_.best = result_.base;
    log_.directions(result_.directions, result_.before);
  }

  // What acts in a trial kept back alone is not seen in those that are fitted.
  void look_at_check_trials() {
    Evaluator evaluator = setup_->evaluator();
    const double dispersion = std::max(1.0, 2.0 * result_.base.cost / setup_->samples());
    double most = 0.0;
    for (const int t : result_.check_trials) {
      FitOptions check = fit_options();
      check.trials = {t};
      const int samples = setup_->data().samples(check.trials);
      const double excess =
          kept_back_excess(kept_back(evaluator, result_.base, check), samples, dispersion) - 1.0;
      const double deviations = excess / std::sqrt(2.0 / std::max(1, samples));
      log_.note("What is left of trial " + experiment().trials[t].name +
                text(", kept back, is %.3g deviations above the noise.", deviations));
      if (deviations < least_objection || excess < small_objection || excess < most) continue;
      most = excess;
      objecting_ = t;
    }
  }

  // The directed tests, and what they do not look for.
  Alarm judged(std::vector<Direction>& directions, const FitSummary& model) const {
    Alarm alarm = judge(directions, model, numerical_, options_.seed);
    alarm.leftover = leftover(setup_->data(), fit_options().trials, model, numerical_);
    alarm.raised = alarm.raised || alarm.leftover.shows();
    return alarm;
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
    Evaluator evaluator = setup_->evaluator();
    FitOptions few = fit_options();
    few.iterations = std::min(junction_iterations, few.iterations);
    FitSummary found = fit(evaluator, with, few);
    CoarseModel coarse(*setup_, found);
    Evaluator there = coarse.evaluator();
    std::vector<Direction> directions =
        directions_of(there, found, causes_, fit_options(), result_.directions);
    gone_simulations_ += coarse.simulations();
    const Alarm alarm = judged(directions, found);
    log_.fit("With junctions that give a little", found, setup_->samples());
    log_.directions(directions, alarm);
    if (alarm.raised || !is_by_convention(found, junctions.size())) return false;
    log_.note("What is left is below what the plant file's mesh resolves at the junctions.");
    model = std::move(found);
    return true;
  }

  // ---- Steps 4 to 7 -----------------------------------------------------------------------------

  RefitOptions refit_options(double from, double to, const std::string& what) {
    RefitOptions refit{fit_options(), result_.check_trials, {}, options_.stop};
    refit.progress = [this, from, to, what](double share) {
      log_.say(what, from + share * (to - from));
    };
    return refit;
  }

  void search() {
    make_workers();
    result_.ranking =
        refit_all({coarse_workers_, workers_}, result_.base, causes_, result_.directions,
                  refit_options(0.2, 0.6, "refitting candidates"));
    if (stopped()) return;
    for (std::size_t i = 0; i < std::min<std::size_t>(6, result_.ranking.size()); ++i)
      if (result_.ranking[i].whole)
        log_.fit(text("Evidence %.5g", result_.ranking[i].evidence), result_.ranking[i].fit,
                 setup_->samples());
    if (result_.ranking.empty() || result_.ranking.front().evidence < worth_naming) return;
    if (leaves_much(result_.ranking.front().fit) && one_force_does_more()) return;
    result_.best = result_.ranking.front().fit;
    findings_.chain = {result_.ranking.front()};
  }

  bool leaves_much(const FitSummary& model) const {
    return 2.0 * model.cost > much_left * setup_->samples();
  }

  // More known causes would but imitate what none of them is, slowly.
  bool one_force_does_more() {
    const Candidate& best = result_.ranking.front();
    const double noise = 0.5 * setup_->samples();
    const double left = (best.fit.cost - noise) / std::max(1.0, result_.base.cost - noise);
    const std::string sentence = "the best known cause, " + best.cause +
                                 text(", leaves %.2g %% of what is wrong", 100.0 * left);
    log_.note("One force is asked for: " + sentence + ".");
    const MissingForce& force = missing_force(0.6);
    if (!force.found || force.fit.why == "not run" || 1.0 - force.share > left_by_force * left)
      return false;
    instead_of_ = sentence;
    return true;
  }

  // Adds causes while something is left.
  void extend() {
    while (!findings_.chain.empty() && static_cast<int>(findings_.chain.size()) < most_causes &&
           !stopped()) {
      const std::vector<Direction> directions = look_again();
      log_.directions(directions, result_.after);
      if (!result_.after.raised || is_small(result_.after)) return;
      if (could_be_junctions(result_.after) && quiet_with_junctions(result_.best)) {
        result_.after.raised = false;
        return;
      }
      const double from = 0.5 + 0.15 * static_cast<double>(findings_.chain.size());
      const std::vector<Cause> likely = promising(causes_, directions);
      const std::vector<Candidate> next =
          refit_all({coarse_workers_, workers_}, result_.best, likely, directions,
                    refit_options(from, from + 0.15, "looking for another cause"));
      if (stopped() || next.empty()) return;
      const Candidate& first = next.front();
      log_.fit(text("Beside what was found, evidence %.4g", first.evidence), first.fit,
               setup_->samples());
      log_.note(text("It gains %.4g nats, of %.4g that another cause must; ", first.gain,
                     least_gain_beside(findings_.chain)) +
                text("for the trials kept back %.4g.", first.held_out.gain));
      if (!is_another_cause(first)) return;
      findings_.chain.push_back(first);
      result_.best = first.fit;
    }
    if (!findings_.chain.empty()) look_again();
  }

  void correct_at(const FitSummary& model) {
    setup_->correct_at(model);
    if (setup_->numerics() == result_.numerics) return;
    result_.numerics = setup_->numerics();
    log_.note(text("Here nodes every %.3g mm and a step of %.3g ms",
                   1e3 * result_.numerics.distance, 1e3 * result_.numerics.dt) +
              " are needed.");
    make_workers();
  }

  // So that a model which explains them is far from it.
  bool base_misses_the_data() const {
    return 2.0 * result_.base.cost > far_from_data * setup_->samples();
  }

  // What the model with all causes so far leaves. Where that is far from the base, our own error
  // is another one there.
  std::vector<Direction> look_again() {
    if (base_misses_the_data()) {
      correct_at(result_.best);
      Evaluator evaluator = setup_->evaluator();
      result_.best = findings_.chain.back().fit = refit(evaluator, result_.best, fit_options());
    }
    coarse_at(result_.best);
    std::vector<Direction> directions = directions_at(result_.best);
    result_.after = judged(directions, result_.best);
    return directions;
  }

  // Whether what is left alarms, but promises too little for another cause.
  bool is_small(const Alarm& alarm) const {
    const double promised = 0.5 * alarm.statistic * alarm.statistic;  // were the model linear
    return !alarm.leftover.shows() && beyond_linear * promised < least_gain_beside(findings_.chain);
  }

  // Whether the data tell how large the effects from `first` on are: to a factor of e, one
  // deviation.
  static bool has_a_size(const FitSummary& model, int first) {
    for (int p = 0; p < model.hypothesis.size(); ++p) {
      const FreeParameter& free = model.hypothesis.free[p];
      const bool size =
          free.effect >= first && free.vanishes != Vanishes::never && free.prior <= 0.0;
      if (size && free.logarithmic && model.standard_error[p] > 1.0) return false;
    }
    return true;
  }

  // The trials kept back may ask for what those fitted to hardly show: that is no finding.
  bool is_another_cause(const Candidate& next) const {
    if (next.evidence < worth_naming || next.gain < least_gain_beside(findings_.chain) ||
        !next.held_out.carries_over())
      return false;
    if (!has_a_size(next.fit, static_cast<int>(result_.best.hypothesis.effects.size())))
      return false;
    return std::ranges::all_of(findings_.chain, [&](const Candidate& found) {
      return !same_family(found.cause, next.cause) || next.gain > family_share * found.gain;
    });
  }

  // Searches go by a cheaper simulator that agrees with the fine one at the model they extend.
  void coarse_at(const FitSummary& model) {
    drop_coarse();
    coarse_ = std::make_unique<CoarseModel>(*setup_, model);
    coarse_workers_ = coarse_->workers();
    log_.note(text("Searching with nodes every %.3g mm and a step of %.3g ms",
                   1e3 * coarse_->numerics().distance, 1e3 * coarse_->numerics().dt) +
              text(", carried along as a correction: %.2g of the noise.", coarse_->error()));
  }

  void drop_coarse() {
    if (coarse_) gone_simulations_ += coarse_->simulations();
    coarse_.reset();
  }

  std::vector<Direction> directions_at(const FitSummary& model) {
    Evaluator evaluator = coarse_->evaluator();
    return directions_of(evaluator, model, causes_, fit_options(), result_.directions);
  }

  // One simulator a thread: candidates are refitted side by side.
  void make_workers() {
    drop_workers();
    for (int i = 0; i < options_.threads; ++i) {
      simulators_.push_back(
          std::make_unique<Simulator>(experiment(), result_.numerics, 1, options_.stop));
      workers_.emplace_back(*simulators_.back(), setup_->data(), setup_->corrections());
    }
  }

  void drop_workers() {
    for (const auto& simulator : simulators_) gone_simulations_ += simulator->simulations();
    workers_.clear();
    simulators_.clear();
  }

  // ---- Steps 8 and 9 ----------------------------------------------------------------------------

  void conclude_all() {
    log_.say("writing the verdict", 0.95);
    if (findings_.chain.size() > 1) findings_.held_out = held_out_together();
    // What is left of the best model is the best sample of the noise.
    if (!findings_.chain.empty()) setup_->renew_noise(result_.best.hypothesis);
    if (findings_.chain.empty() && instead_of_.empty()) {
      Evaluator evaluator = setup_->evaluator();
      findings_.needed =
          needed_parameters(evaluator, result_.base, causes_, fit_options(), result_.check_trials);
      if (const FitSummary* law = findings_.needed.better()) result_.best = *law;
    }
    predict();
    measure_errors(findings_, result_);
    findings_.symptoms = symptoms(experiment(), setup_->data(), result_.predictions[refitted]);
    conclude(findings_, result_);
    if (result_.verdict.causes.empty() && findings_.needed.better()) {
      // What a law stood for may be nominal, but for our own errors: then nothing is extended.
      predict();
      measure_errors(findings_, result_);
    }
    if (objecting_ >= 0) {
      name_nothing(result_.verdict);
      result_.verdict.outcome = Outcome::unknown;
      result_.verdict.remainder = "the refitted model explains the fitted trials, but not trial " +
                                  experiment().trials[objecting_].name +
                                  ", which is kept back: fit it, too";
    } else if (result_.verdict.outcome == Outcome::unknown) {
      if (!instead_of_.empty()) result_.verdict.remainder = instead_of_ + ", one force far less";
      tell_of_force();
    } else if (!findings_.chain.empty()) {
      ask_for_one_force();
    }
    conclude_outliers(result_);
    judge_stalks();
    report_parameters(findings_, result_);
    report_hidden(causes_, result_);
    choose_next();
  }

  // What several causes do together for the trials kept back.
  HeldOut held_out_together() {
    if (result_.check_trials.empty()) return {};
    Evaluator evaluator = setup_->evaluator();
    FitOptions check = fit_options();
    check.trials = result_.check_trials;
    const KeptBack base = kept_back(evaluator, result_.base, check);
    const std::array extended{kept_back(evaluator, result_.best, check)};
    const double dispersion = std::max(1.0, 2.0 * result_.best.cost / setup_->samples());
    return held_out(base, extended, setup_->data().samples(check.trials), dispersion).front();
  }

  // Several causes are none where one force from outside the list explains as much of the fitted
  // trials, nor is one that does so at the end of what its numbers may be; any other single cause
  // is none where a force explains clearly more. That holds for the trials kept back, too. What is
  // explained to the last, and loudly, is not by chance.
  void ask_for_one_force() {
    const bool several = findings_.chain.size() > 1;
    const bool alone = !several && !stands_at_bound(findings_.chain.front());
    const Candidate& first = findings_.chain.front();
    double explained = first.evidence - first.held_out.gain;
    for (std::size_t c = 1; c < findings_.chain.size(); ++c) explained += findings_.chain[c].gain;
    if ((!result_.after.raised || is_small(result_.after)) &&
        explained > (several ? beyond_doubt_together : beyond_doubt))
      return;
    const MissingForce& force =
        missing_force(0.96, promising_force * (result_.base.cost - result_.best.cost));
    if (!force.found || force.fit.why == "not run") return;
    // With the noise as it was read last.
    Evaluator evaluator = setup_->evaluator();
    const std::vector<Hypothesis> models{result_.base.hypothesis, result_.best.hypothesis,
                                         force.fit.hypothesis};
    const Eigen::VectorXd cost =
        0.5 * evaluator.residuals(models, fit_options()).colwise().squaredNorm();
    const double by_causes = cost[0] - cost[1], by_force = cost[0] - cost[2];
    log_.note(text("One force gains %.4g nats, what was found %.4g.", by_force, by_causes));
    const double margin = std::max(force_margin, force_share * by_causes);
    if (by_force < by_causes + (alone ? margin : -margin)) return;
    const std::optional<double>& gain = result_.verdict.gain;
    if (gain && force.gain && *force.gain < *gain - (alone ? 0.0 : force_share)) return;
    result_.verdict.outcome = Outcome::unknown;
    result_.verdict.remainder =
        several ? "one force explains as much as several known causes together"
        : alone ? "one force explains more than any known cause"
                : "one force explains as much as a known cause that stands at the end of what its "
                  "numbers may be";
    tell_of_force();
  }

  static bool stands_at_bound(const Candidate& found) {
    const Hypothesis& model = found.fit.hypothesis;
    return std::ranges::any_of(found.fit.at_bound, [&](int p) {
      return model.effects[model.free[p].effect].name == found.cause;
    });
  }

  // Where, when and of what kind the force is that no cause stands for; none where even a free one
  // promises too little.
  const MissingForce& missing_force(double from, double least_evidence = 0.0) {
    if (force_) return *force_;
    log_.say("looking for a force that is missing", from);
    coarse_at(result_.base);
    // Refits are fine ones: a force moves the model so far from the base that a coarse one, which
    // agrees with it there alone, misleads about the place.
    Evaluator evaluator = setup_->evaluator();
    // The noise was read anew since the base was fitted.
    const FitSummary base = fit(evaluator, result_.base.hypothesis, fit_options());
    MissingForceOptions options;
    options.fit = fit_options();
    options.check = result_.check_trials;
    options.threads = options_.threads;
    options.response_distance = coarse_->numerics().distance;
    options.least_evidence = least_evidence;
    if (base_misses_the_data())
      options.correct_at = [&](const FitSummary& model) {
        correct_at(model);
        evaluator = setup_->evaluator();
      };
    options.note = [this](const std::string& sentence) { log_.note(sentence); };
    force_ = infer_missing_force(evaluator, base, options);
    result_.verdict.simulations += force_->simulations;
    return *force_;
  }

  void tell_of_force() {
    const MissingForce& force = result_.force = missing_force(0.96);
    name_nothing(result_.verdict);
    std::string& remainder = result_.verdict.remainder;
    if (!remainder.empty()) remainder += ". ";
    remainder +=
        force.found ? force.sentence() : "No force at a marker explains it. Do not extrapolate.";
    if (force.fit.why == "not run") return;
    coarse_at(force.fit);
    std::vector<Direction> left = directions_at(force.fit);
    const Alarm alarm = judged(left, force.fit);
    log_.note(text("With that force the largest directed statistic is %.3g, level %.3g.",
                   alarm.statistic, alarm.level));
  }

  // What the stalks bore and broke at, by the best model, against the file's thresholds.
  void judge_stalks() {
    if (!records_detachments(experiment()) || stopped()) return;
    const Variant variant = result_.best.hypothesis.variant();
    // The moment under a fruit depends on how far below it the next joint is: here as where the
    // law will be used, with the plant file's own nodes.
    Numerics own = result_.numerics;
    own.distance = experiment().plant.distance;
    own.junction = 0.0;
    Simulator simulator(experiment(), own, 1, options_.stop);
    std::vector<StalkLoads> stalks;
    std::vector<BreakLaw> thresholds;
    std::vector<double> intervals;
    for (int t = 0; t < static_cast<int>(experiment().trials.size()); ++t) {
      const std::vector<double>& time = experiment().trials[t].markers.time;
      for (std::size_t i = 1; i < time.size(); ++i) intervals.push_back(time[i] - time[i - 1]);
      std::ranges::move(simulator.stalk_loads(variant, t), std::back_inserter(stalks));
      for (const plant::PlantFruit& fruit : experiment().plant.fruits)
        thresholds.push_back(break_law_of(experiment().plant, fruit));
    }
    result_.verdict.simulations += simulator.simulations();
    if (intervals.empty()) return;
    std::ranges::nth_element(intervals, intervals.begin() + intervals.size() / 2);
    // Seen with the next sample.
    const double window = intervals[intervals.size() / 2];
    result_.strength = judge_strength(std::move(stalks), std::move(thresholds), window);
    log_.note(result_.strength.summary());
    conclude_detachment(result_);
  }

  void choose_next() {
    Verdict& verdict = result_.verdict;
    if (verdict.outcome == Outcome::ambiguous) {
      log_.say("choosing the next experiment", 0.97);
      std::vector<Hypothesis> rivals;
      for (const NamedCause& cause : verdict.causes)
        if (rivals.size() < most_rivals) rivals.push_back(model_of(cause.name));
      result_.next =
          next_experiment(experiment(), setup_->data(), rivals,
                          {result_.numerics, options_.threads, options_.stop}, verdict.simulations);
    } else if (verdict.outcome == Outcome::unknown) {
      result_.next = next_look(experiment(), setup_->data(), result_.predictions[refitted]);
    }
    verdict.next_experiment = result_.next.sentence;
  }

  // Refitted with a cause that the verdict lists: a candidate, or what may stand for a parameter.
  Hypothesis model_of(const std::string& cause) const {
    const FitSummary* found = &findings_.needed.model;
    for (const Candidate& candidate : result_.ranking)
      if (candidate.cause == cause) found = &candidate.fit;
    for (const NeededParameters::Instead& other : findings_.needed.instead)
      if (other.model.hypothesis.name == cause) found = &other.model;
    Hypothesis model = found->hypothesis;
    model.name = cause;
    return model;
  }

  void predict() {
    const std::array<Hypothesis, model_count> models{Hypothesis{}, result_.base.hypothesis,
                                                     result_.best.hypothesis};
    auto all = setup_->predictions(models);
    for (int m = 0; m < model_count; ++m) result_.predictions[m] = std::move(all[m]);
  }

  Diagnosis finished() {
    if (setup_) {
      result_.position_noise = setup_->data().position_noise();
      result_.force_noise = setup_->data().force_noise();
      result_.verdict.simulations += setup_->simulations();
    }
    drop_workers();
    drop_coarse();
    result_.verdict.simulations += gone_simulations_;
    result_.stopped = stopped();
    result_.verdict.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    return std::move(result_);
  }

  const Experiment& given_;
  DiagnosisOptions options_;
  std::chrono::steady_clock::time_point start_;
  Diagnosis result_;
  DiagnosisLog log_;
  std::unique_ptr<FitSetup> setup_;
  std::vector<Cause> causes_;
  Eigen::VectorXd numerical_;  // what our own error may leave in the residual
  std::vector<std::unique_ptr<Simulator>> simulators_;
  std::vector<Evaluator> workers_;
  std::unique_ptr<CoarseModel> coarse_;
  std::vector<Evaluator> coarse_workers_;
  long gone_simulations_ = 0;  // of coarse models and workers that are gone
  Findings findings_;
  std::optional<MissingForce> force_;  // once it was asked for
  std::string instead_of_;             // the known cause whose place it takes, in words
  int objecting_ = -1;                 // the trial kept back that the refitted model misses most
  std::optional<Experiment> exchanged_;
};

}  // namespace

Diagnosis diagnose(const Experiment& experiment, const DiagnosisOptions& options) {
  Procedure first(experiment, options);
  Diagnosis found = first.run();
  if (!first.exchanged()) return found;
  Diagnosis again = Procedure(*first.exchanged(), options).run();
  again.exchanged = found.exchanged;
  again.steps.insert(again.steps.begin(), found.steps.begin(), found.steps.end());
  again.verdict.simulations += found.verdict.simulations;
  again.verdict.seconds += found.verdict.seconds;
  return again;
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
