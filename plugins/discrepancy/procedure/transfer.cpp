#include "plugins/discrepancy/procedure/transfer.h"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/core/check.h"
#include "plugins/discrepancy/admission/admission.h"
#include "plugins/discrepancy/data/sentence.h"
#include "plugins/discrepancy/fit/baseline_start.h"
#include "plugins/discrepancy/fit/fit_setup.h"
#include "plugins/discrepancy/procedure/diagnosis.h"
#include "plugins/discrepancy/select/findings.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {

namespace {

void check_places(const Hypothesis& effects, const Experiment& experiment) {
  for (const plant::Effect& effect : effects.effects)
    if (effect.place && experiment.plant().curve_index(effect.place->curve) < 0)
      throw UsageError(effect.name + " sits on curve \"" + effect.place->curve +
                       "\", which the other plant does not have, expected plants whose curves "
                       "have the same names");
}

// Of what makes the first plant another one than its file says, nothing belongs to the second.
Hypothesis carried(const plant::PlantFile& extended) {
  Hypothesis effects;
  for (const plant::Effect& effect : extended.effects) {
    const effects::EffectDefinition* known = effects::find_effect(effect.name);
    if (known && known->home != effects::Home::material) effects.effects.push_back(effect);
  }
  return effects;
}

std::vector<std::pair<std::string, double>> factors(const Hypothesis& model) {
  std::vector<std::pair<std::string, double>> found;
  for (const std::string& name : Shift::names())
    if (const int p = model.factor_on(name); p >= 0) found.emplace_back(name, model.value(p));
  return found;
}

nlohmann::ordered_json number(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? nlohmann::ordered_json(*value) : nullptr;
}

}  // namespace

std::string Transfer::sentence() const {
  if (!refusal.empty()) return "The data cannot be used: " + refusal;
  const Errors& errors = check.refitted ? check : fit;
  const std::string where = check.refitted ? " on the trials held out" : " on the fitted trials";
  if (!errors.refitted || !errors.extended) return "Nothing was measured.";
  const std::string sizes =
      text(" (%.3g times the noise without it, %.3g with it)", *errors.refitted, *errors.extended) +
      where + ".";
  if (!gain)
    return "The refitted model explains these data down to their noise; they do not ask for what "
           "was carried over" +
           sizes;
  if (*gain > 0.0)
    return "It carries over: it removes " + share_removed(*gain) +
           " of the error above the noise that refitting leaves" + sizes;
  return "It does not carry over: the error does not fall" + sizes;
}

Transfer transfer(const plant::PlantFile& extended, const Experiment& given,
                  const TransferOptions& options) {
  const auto say = [&](const char* what, double share) {
    if (options.progress) options.progress(what, share);
  };
  const auto stopped = [&] { return options.stop && *options.stop; };
  Transfer result;
  Admission admission = admit(given);
  if (!admission.refusal.empty()) {
    result.refusal = admission.refusal;
    return result;
  }
  const Experiment& experiment = admission.experiment;
  const Hypothesis effects = carried(extended);
  check_places(effects, experiment);
  for (const plant::Effect& effect : effects.effects) result.effects.push_back(effect.name);

  say("fitting modulus, density and damping", 0.0);
  FitSetup setup(experiment, options.threads, NoiseRule{}, options.stop, options.settings);
  std::vector<std::string> unseen;
  Evaluator evaluator = setup.evaluator();
  const std::array horizons{options.settings.budget.baseline_horizon, 1.0};
  FitSummary base = fit_growing(evaluator, baseline_start(evaluator, setup.options(), unseen),
                                setup.options(), horizons);
  if (!stopped()) {
    say("checking our own numerical error", 0.3);
    setup.refine(base, {[](int) {}, [](const NumericsCheck&) {}});
    setup.renew();
    base.hypothesis.add(mesh_nuisance());
    Evaluator fine = setup.evaluator();
    base = fit(fine, base.hypothesis, setup.options());
  }
  // From the refitted numbers: the effects seldom move them far.
  Hypothesis with = base.hypothesis;
  with.add(effects);
  Evaluator fine = setup.evaluator();
  say("fitting them beside what was carried over", 0.6);
  const FitSummary both = fit_growing(fine, with, setup.options(), horizons);
  // The better model shows the noise better.
  setup.renew_noise(both.cost < base.cost ? both.hypothesis : base.hypothesis);
  Evaluator again = setup.evaluator();
  base = refit(again, base, setup.options());
  with = refit(again, both, setup.options()).hypothesis;
  result.stopped = stopped();
  if (result.stopped) return result;

  say("comparing", 0.9);
  const std::array models{Hypothesis{}, base.hypothesis, with};
  const auto predictions = setup.predictions(models);
  const auto errors_of = [&](const std::vector<int>& trials) {
    Errors errors;
    if (trials.empty()) return errors;
    errors.nominal = setup.data().rms(trials, predictions[nominal]);
    errors.refitted = setup.data().rms(trials, predictions[refitted]);
    errors.extended = setup.data().rms(trials, predictions[Model::extended]);
    return errors;
  };
  result.fit = errors_of(setup.options().trials);
  result.check = errors_of(setup.check_trials());
  const bool held_out = result.check.refitted.has_value();
  const Errors& errors = held_out ? result.check : result.fit;
  const int samples =
      setup.data().samples(held_out ? setup.check_trials() : setup.options().trials);
  const double scatter = interval95 / std::sqrt(2.0 * std::max(1, samples));
  if (errors.refitted && *errors.refitted - 1.0 > scatter)
    result.gain = (*errors.refitted - *errors.extended) / (*errors.refitted - 1.0);
  result.refitted = factors(base.hypothesis);
  result.extended = factors(with);
  result.simulations = setup.simulations();
  return result;
}

std::string to_json(const Transfer& transfer) {
  using Json = nlohmann::ordered_json;
  const auto errors = [](const Errors& e) -> Json {
    return {{"nominal", number(e.nominal)},
            {"refitted", number(e.refitted)},
            {"extended", number(e.extended)}};
  };
  const auto factors = [](const std::vector<std::pair<std::string, double>>& all) {
    Json map = Json::object();
    for (const auto& [name, value] : all) map[name] = value;
    return map;
  };
  const Json json = {
      {"format", "pedicel-transfer"},
      {"version", 1},
      {"effects", transfer.effects},
      {"error",
       {{"fit", errors(transfer.fit)},
        {"check", errors(transfer.check)},
        {"unit", "rms residual over the noise floor"}}},
      {"gain", number(transfer.gain)},
      {"factors",
       {{"refitted", factors(transfer.refitted)}, {"extended", factors(transfer.extended)}}},
      {"refusal", transfer.refusal},
      {"sentence", transfer.sentence()},
      {"simulations", transfer.simulations}};
  return json.dump(2);
}

}  // namespace pedicel::discrepancy
