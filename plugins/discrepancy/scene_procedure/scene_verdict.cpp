#include "plugins/discrepancy/scene_procedure/scene_verdict.h"

#include <algorithm>
#include <cmath>

#include "engine/io/csv.h"
#include "plugins/discrepancy/scene_procedure/scene_decoys.h"
#include "plugins/discrepancy/select/left_misfit.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {

namespace {

constexpr double ninety_five = 1.96;
constexpr std::size_t most_nearest = 3;

Estimate estimate_of(const FitSummary& fit, int p) {
  const effects::FreeParameter& free = fit.hypothesis.free[static_cast<std::size_t>(p)];
  // The interval is made in the unknown: a factor's is one by ratio and stays above zero.
  const double u = free.to_unknown(fit.hypothesis.value(p)),
               error = ninety_five * fit.standard_error[p];
  return {fit.hypothesis.value(p), free.to_value(u - error), free.to_value(u + error), free.unit};
}

class Conclusion {
 public:
  Conclusion(SceneSimulator& simulator, const SceneDataSet& data, const SceneSearchSettings& how,
             SceneDiagnosis& diagnosis)
      : simulator_(simulator),
        experiment_(simulator.experiment()),
        data_(data),
        how_(how),
        d_(diagnosis),
        found_(diagnosis.findings),
        v_(diagnosis.verdict) {}

  void run() {
    // Findings have no `bad_data` and no `numerical`: these end a diagnosis before anything is
    // searched.
    using Of = SceneFindings::Outcome;
    v_.outcome = found_.outcome == Of::adequate    ? Outcome::adequate
                 : found_.outcome == Of::named     ? Outcome::named
                 : found_.outcome == Of::ambiguous ? Outcome::ambiguous
                                                   : Outcome::unknown;
    // What follows these three only sorts what they have written, and adds words.
    set_errors();
    set_parameters();
    add_causes();
    // What explains most first; those that the data cannot tell apart, likeliest first.
    if (v_.outcome == Outcome::named)
      std::ranges::stable_sort(v_.causes, std::ranges::greater{},
                               [](const NamedCause& one) { return one.share.fit.value_or(0.0); });
    // A material's number alone is a finding, too.
    // The search counts causes only. A plant that is softer than its file says is no cause, but a
    // user has to change the file.
    if (v_.outcome == Outcome::adequate && !v_.causes.empty()) v_.outcome = Outcome::named;
    if (found_.explained() && !v_.causes.empty()) tell_decoys();
    if (v_.outcome == Outcome::unknown) tell_unknown();
    if (v_.outcome == Outcome::ambiguous) tell_next();
    // Behind what nobody knows anything may hide.
    if (v_.outcome != Outcome::unknown) tell_detectable_limits();
    tell_left();
  }

 private:
  Misfit misfit(const std::vector<SceneReadings>& readings, const std::vector<int>& trials) const {
    Misfit all;
    for (const int t : trials) {
      // A diagnosis that was stopped may lack predictions of some trials.
      if (static_cast<std::size_t>(t) >= readings.size()) continue;
      // By kind of reading. All count alike in noise units, which is the only unit that they have
      // in common.
      for (const Misfit& one : data_.sums(t, readings[static_cast<std::size_t>(t)])) {
        all.square += one.square;
        all.count += one.count;
      }
    }
    return all;
  }

  void set_errors() {
    const auto of = [&](const std::vector<int>& trials) {
      Errors errors;
      if (trials.empty()) return errors;
      errors.nominal = misfit(d_.nominal, trials).over_noise();
      errors.refitted = misfit(d_.refitted, trials).over_noise();
      errors.extended = misfit(d_.extended, trials).over_noise();
      return errors;
    };
    v_.fit = of(d_.fit_trials);
    v_.check = of(d_.check_trials);
    // Gains are told of held-out trials only: on fitted ones more numbers always gain.
    const Errors& judged = d_.check_trials.empty() ? v_.fit : v_.check;
    const auto gain = [&](double before) {
      // Within 5 % of the noise there is nothing to gain, and the quotient would be one of chances.
      return before > 1.05 ? std::optional((before - *judged.extended) / (before - 1.0))
                           : std::nullopt;
    };
    if (!judged.nominal || d_.check_trials.empty()) return;
    // Without a cause, refitted and extended are one model, and a gain of 0 would say that a cause
    // failed.
    if (found_.explained()) v_.gain = gain(*judged.refitted);
    v_.gain_over_nominal = gain(*judged.nominal);
  }

  // In the units of the file, where the scene has one material; else as factors.
  void set_parameters() {
    const FitSummary& model = found_.model();
    for (const effects::EffectDefinition* known : effects::material_factors()) {
      const std::string& name = known->name;
      const int p = model.hypothesis.factor_on(name);
      // A fit that was stopped before its first step has no errors yet.
      if (p < 0 || p >= model.standard_error.size()) continue;
      const Estimate factor = estimate_of(model, p);
      // A factor is on all plants of a scene. With two files there are two moduli, and no single
      // number to tell.
      const auto own =
          experiment_.plants.size() == 1
              ? plant::number_of(experiment_.plants.front().file.material, *known->material)
              : std::nullopt;
      if (!own) {
        v_.parameters[name + "_factor"] = factor;
        continue;
      }
      v_.parameters[name] = {*own * factor.value, *own * factor.low, *own * factor.high,
                             std::string(known->material->unit)};
    }
    set_baseline_effects(model);
  }

  // Where an unseen plant is attached.
  void set_baseline_effects(const FitSummary& model) {
    for (int p = 0; p < model.hypothesis.size(); ++p) {
      const effects::FreeParameter& free = model.hypothesis.free[static_cast<std::size_t>(p)];
      const plant::Effect& effect = model.hypothesis.effects[static_cast<std::size_t>(free.effect)];
      const SceneEffectDefinition* known = told_of_baseline(effect, free);
      if (!known) continue;
      const InBaseline::Told told = known->in_baseline->told(experiment_, effect, free.component);
      Estimate place = estimate_of(model, p);
      for (double* value : {&place.value, &place.low, &place.high}) *value += told.nominal;
      v_.parameters[told.name] = place;
    }
  }

  void add_causes() {
    const auto& all = found_.candidates;
    if (found_.explained()) {
      for (const std::string& name : all.front().names)
        v_.causes.push_back(cause_of(all.front(), name));
      // Under `ambiguous` all that may be it stand side by side. What is common to two of them
      // is named once, with the numbers of the better one.
      for (const std::size_t r : found_.competing) {
        const SceneCandidate& other = all[r];
        for (const std::string& name : other.names)
          if (std::ranges::none_of(v_.causes,
                                   [&](const NamedCause& one) { return one.name == name; }))
            v_.causes.push_back(cause_of(other, name));
      }
    } else if (found_.outcome == SceneFindings::Outcome::unknown) {
      // Three, since the list is read by people who look for an idea. `competing` has all.
      for (std::size_t i = 0; i < std::min(most_nearest, all.size()); ++i) {
        // By the cause that was added last: those before it stand in a candidate of their own.
        v_.nearest.push_back(cause_of(all[i], all[i].names.back()));
        v_.nearest.back().against =
            "it leaves " + io::format_number(all[i].excess, 3) + " noise units beyond the noise";
      }
    }
    // Behind the best, in nats. Where nothing explains the data there is no best to be behind.
    for (std::size_t i = found_.explained() ? 1 : 0; i < all.size(); ++i)
      v_.competing.push_back(
          {joined_names(all[i].names), found_.explained() ? all[i].cost - all.front().cost : 0.0});
    for (const std::string& name : found_.material) v_.causes.push_back(material_cause(name));
  }

  NamedCause cause_of(const SceneCandidate& candidate, const std::string& name) {
    const FitSummary& fit = candidate.fit;
    NamedCause cause;
    cause.name = name;
    // Both with the price of all their numbers: those of the baseline are in either.
    cause.evidence = found_.baseline_cost - candidate.cost;
    std::vector<plant::Effect> without;
    // The others keep their numbers: a change is what this cause makes in the model that is told,
    // and nothing else.
    for (const plant::Effect& effect : fit.hypothesis.effects)
      if (effect.name != name) without.push_back(effect);
    for (int p = 0; p < fit.hypothesis.size(); ++p) {
      const effects::FreeParameter& free = fit.hypothesis.free[static_cast<std::size_t>(p)];
      const plant::Effect& effect = fit.hypothesis.effects[static_cast<std::size_t>(free.effect)];
      if (effect.name != name || p >= fit.standard_error.size()) continue;
      // Which link, which camera: part of what was found, as much as its numbers.
      cause.words = effect.words;
      cause.where = effect.place;
      // A place is told as `where`.
      if (free.name != "at") cause.parameters[free.name].push_back(estimate_of(fit, p));
    }
    const SceneEffectDefinition* known = find_scene_effect(name);
    if (known) cause.plain = known->plain_name;
    const std::string before = io::format_number(found_.baseline_excess, 3),
                      left = io::format_number(candidate.excess, 3);
    cause.because = (known ? known->sentence : effects::plain_name(name)) +
                    ": with it the misfit beyond the noise falls from " + before + " to " + left +
                    " noise units";
    // What is left without it: the baseline, where it is the only one.
    // A share compares fits, since the others would take over a part of what is taken out. These
    // fits exist already, so no new one is made.
    const bool alone = candidate.names.size() == 1;
    const SceneCandidate* other = nullptr;
    for (const SceneCandidate& one : found_.candidates)
      if (!alone && one.names.size() == 1 && one.names.front() != name &&
          std::ranges::find(candidate.names, one.names.front()) != candidate.names.end())
        other = &one;
    // For the model that is told: predictions of the others were never made.
    if (&candidate == &found_.candidates.front()) {
      // No fit without it exists. Held numbers give the largest share that it can have.
      set_share(cause, alone   ? d_.refitted
                       : other ? predict(other->fit.hypothesis.effects)
                               : predict(without));
      set_change(cause, without);
    }
    return cause;
  }

  // A number of the material, beside the causes.
  // It stands in the model that is told as a free number of the baseline, and not as a candidate of
  // the search.
  NamedCause material_cause(const std::string& name) {
    const FitSummary& model = found_.model();
    NamedCause cause;
    cause.name = name;
    if (const int p = model.hypothesis.factor_on(name); p >= 0) {
      cause.parameters["factor"].push_back(estimate_of(model, p));
      // Not how much misfit it takes: a swing sees a ratio of numbers, and each of them takes all
      // of it.
      cause.because = "the fitted factor leaves what is known of the file's own number";
    } else {
      add_place(model, cause);
    }
    std::vector<plant::Effect> without;
    for (const plant::Effect& effect : d_.model)
      if (effect.name != name) without.push_back(effect);
    // Simulated once, for the share and for the change.
    const std::vector<SceneReadings> left = predict(without);
    set_share(cause, left);
    set_change(cause, without, &left);
    return cause;
  }

  // Of an unseen plant, whose place is part of the baseline.
  void add_place(const FitSummary& model, NamedCause& cause) const {
    for (int p = 0; p < model.hypothesis.size(); ++p) {
      const effects::FreeParameter& free = model.hypothesis.free[static_cast<std::size_t>(p)];
      const plant::Effect& effect = model.hypothesis.effects[static_cast<std::size_t>(free.effect)];
      if (effect.name != cause.name) continue;
      cause.parameters[free.name].push_back(estimate_of(model, p));
      cause.words = effect.words;
    }
    const SceneEffectDefinition* known = find_scene_effect(cause.name);
    if (!known || !known->in_baseline) return;
    cause.plain = known->plain_name;
    cause.because = known->in_baseline->because;
  }

  std::vector<SceneReadings> predict(const std::vector<plant::Effect>& effects) {
    // All trials side by side, as the simulator likes it.
    SceneVariant variant{effects};
    std::vector<SceneSimulator::Request> requests;
    requests.reserve(experiment_.trials.size());
    for (int t = 0; t < static_cast<int>(experiment_.trials.size()); ++t)
      requests.push_back({&variant, t});
    return simulator_.run(requests);
  }

  void set_share(NamedCause& cause, const std::vector<SceneReadings>& without) const {
    // The misfit of the files' own model is the whole of which a share is told, so that shares of
    // several causes can be compared.
    const auto share = [&](const std::vector<int>& trials) -> std::optional<double> {
      if (trials.empty()) return std::nullopt;
      const double nominal = misfit(d_.nominal, trials).beyond();
      // A share of nothing is no number.
      if (nominal <= 0.0) return std::nullopt;
      // A trial that fails without the cause has a misfit that says nothing but "far", and would
      // make a share of thousands.
      return std::clamp(
          (misfit(without, trials).square - misfit(d_.extended, trials).square) / nominal, -1.0,
          1.0);
    };
    cause.share = {share(d_.fit_trials), share(d_.check_trials)};
  }

  // In units of the instruments, beside shares: a reader has a ruler and a scale, and no noise
  // units.
  void set_change(NamedCause& cause, const std::vector<plant::Effect>& without,
                  const std::vector<SceneReadings>* known = nullptr) {
    const std::vector<SceneReadings> left = known ? *known : predict(without);
    double square[4] = {}, count[4] = {};
    const auto add = [&](int kind, double d) {
      // What a camera does not see is NaN in both models or in one of them.
      if (!std::isfinite(d)) return;
      square[kind] += d * d;
      count[kind] += 1.0;
    };
    for (std::size_t t = 0; t < left.size(); ++t) {
      const SceneReadings &a = d_.extended[t], &b = left[t];
      for (long i = 0; i < a.markers.size(); ++i) add(0, a.markers.data()[i] - b.markers.data()[i]);
      // A wrench has three forces and then three moments.
      for (std::size_t w = 0; w < a.wrenches.size(); ++w)
        for (long c = 0; c < a.wrenches[w].cols(); ++c)
          for (long r = 0; r < a.wrenches[w].rows(); ++r)
            add(c < 3 ? 1 : 2, a.wrenches[w](r, c) - b.wrenches[w](r, c));
      for (std::size_t p = 0; p < a.pixels.size(); ++p)
        for (long i = 0; i < a.pixels[p].size(); ++i)
          add(3, a.pixels[p].data()[i] - b.pixels[p].data()[i]);
    }
    const auto rms = [&](int kind, double per) -> std::optional<double> {
      if (count[kind] == 0.0) return std::nullopt;
      // Squares were summed by component. Times the components of a vector this is the RMS of its
      // length, which does not depend on the axes.
      return std::sqrt(per * square[kind] / count[kind]);
    };
    // Pixels have two components, all others three.
    cause.change.marker = rms(0, 3.0);
    cause.change.force = rms(1, 3.0);
    cause.change.moment = rms(2, 3.0);
    cause.change.pixel = rms(3, 2.0);
  }

  // A cause must gain by its shape, not by its size: a decoy has the same size.
  void tell_decoys() {
    const Decoys decoys =
        scene_decoys(experiment_, data_, d_.fit_trials, d_.refitted, d_.extended, how_.too_alike);
    const auto nats = [](double value) { return io::format_number(value, 3); };
    v_.causes.front().because += ". Decoys of it gain less: " + nats(decoys.reversed) +
                                 " nats backwards in time, " + nats(decoys.exchanged) +
                                 " at other markers, of " + nats(decoys.own);
    if (decoys.lose(how_.decoy_margin)) return;
    v_.outcome = Outcome::unknown;
    v_.remainder =
        "the same change backwards in time, or at other markers, explains the data as well";
  }

  void tell_left() {
    // By the instruments' noise alone: where predictions are unsure samples count in full.
    const SceneDataSet data(experiment_);
    const auto over = [&](const std::vector<int>& trials) {
      InstrumentSums sums;
      for (const int trial : trials) {
        const auto t = static_cast<std::size_t>(trial);
        // A diagnosis that was stopped may lack some.
        if (t >= d_.refitted.size() || t >= d_.extended.size()) continue;
        const auto refitted = data.sums(trial, d_.refitted[t]);
        const auto told = data.sums(trial, d_.extended[t]);
        for (std::size_t k = 0; k < told.size(); ++k)
          sums[channel_name(static_cast<SceneChannel>(k))] +=
              {refitted[k].square, told[k].square, told[k].square,
               static_cast<double>(told[k].count)};
      }
      return sums;
    };
    v_.left = left_misfit(over(d_.fit_trials), over(d_.check_trials));
  }

  void tell_detectable_limits() {
    for (const SeenFrom& one : found_.seen) {
      const bool named = std::ranges::any_of(
          v_.causes, [&](const NamedCause& cause) { return cause.name == one.name; });
      if (named) continue;
      DetectableLimit limit{one.name, one.parameter, one.size(found_.seen_units), one.unit,
                            one.vanishes};
      // Nothing shows it.
      if (!std::isfinite(one.a_unit)) limit.smallest = std::nan("");
      v_.detectable_limits.push_back(limit);
    }
  }

  void tell_unknown() {
    if (!v_.remainder.empty()) return;
    // What the refitted model leaves, since no other one is believed.
    const std::string left = io::format_number(found_.baseline_excess, 3);
    // No force at one place of a plant: then it may be something that acts on the arm, or in
    // several places.
    if (!found_.outside.found) {
      v_.remainder = left +
                     " noise units are left beyond the noise; no known cause and no force at one "
                     "place of a plant explains them";
      return;
    }
    const OutsideForce& force = found_.outside;
    OutsideAction action;
    action.position = force.position;
    // The sentence leaves out the name where there is one plant. It is filled in after the sentence
    // was made, so that the file has it in any case.
    if (experiment_.plants.size() > 1)
      action.plant = experiment_.plants[static_cast<std::size_t>(force.plant)].name;
    action.place = force.place;
    action.from = force.from;
    action.to = force.to;
    action.direction = force.direction;
    v_.remainder = outside_sentence(action) + " It shows most in " +
                   experiment_.trials[static_cast<std::size_t>(force.trial)].name +
                   ", where a force of " + io::format_number(force.size, 2) + " N at " +
                   io::format_number(force.place.at, 2) + " of " + force.place.curve +
                   " would explain " + io::format_number(100.0 * force.share, 2) +
                   " % of what is left";
    if (action.plant.empty() && !experiment_.plants.empty())
      action.plant = experiment_.plants.front().name;
    v_.unknown = action;
    // Something outside is seen by eye sooner than by any further fit.
    v_.next_experiment = "Look at " + force.place.curve + " there while the trial is repeated";
  }

  void tell_next() {
    for (const NamedCause& cause : v_.causes) {
      const SceneEffectDefinition* known = find_scene_effect(cause.name);
      const effects::EffectDefinition* of_plant = effects::find_effect(cause.name);
      const std::string says = known      ? known->tells_apart
                               : of_plant ? of_plant->tells_apart
                                          : std::string();
      if (says.empty()) continue;
      v_.next_experiment += (v_.next_experiment.empty() ? "" : "; or ") + says;
    }
    // Amplitude tells most look-alikes apart: contact, friction and soft joints grow with it in
    // different ways.
    if (v_.next_experiment.empty())
      v_.next_experiment = "repeat the trial with the largest residual at twice its size";
  }

  SceneSimulator& simulator_;
  const Experiment& experiment_;
  const SceneDataSet& data_;
  const SceneSearchSettings& how_;
  SceneDiagnosis& d_;
  const SceneFindings& found_;
  Verdict& v_;
};

}  // namespace

void tell_next_motion(const SceneNext& next, Verdict& verdict) {
  std::string& said = verdict.next_experiment;
  if (next.experiment)
    // A thing from outside is seen by eye sooner than by any motion.
    said = verdict.unknown ? said + ". " + next.sentence : next.sentence;
  else if (!next.sentence.empty() && verdict.outcome == Outcome::ambiguous)
    said = next.sentence + ". What can: " + said;
}

void conclude_scene(SceneSimulator& simulator, const SceneDataSet& data,
                    const SceneSearchSettings& settings, SceneDiagnosis& diagnosis) {
  Conclusion(simulator, data, settings, diagnosis).run();
}

}  // namespace pedicel::discrepancy
