#include "plugins/discrepancy/procedure/transfer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/core/check.h"
#include "plugins/discrepancy/admission/admission.h"
#include "plugins/discrepancy/data/sentence.h"
#include "plugins/discrepancy/procedure/diagnosis.h"
#include "plugins/discrepancy/select/findings.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {

namespace {

void check_places(const Hypothesis& effects, const Experiment& experiment) {
  for (const plant::Effect& effect : effects.effects)
    if (effect.place && std::ranges::none_of(experiment.plants, [&](const ExperimentPlant& plant) {
          return plant.file.curve_index(effect.place->curve) >= 0;
        }))
      throw UsageError(effect.name + " sits on curve \"" + effect.place->curve +
                       "\", which the other plant does not have, expected plants whose curves "
                       "have the same names");
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

std::vector<plant::Effect> carried_effects(const std::vector<plant::Effect>& effects) {
  std::vector<plant::Effect> carried;
  for (const plant::Effect& effect : effects) {
    const effects::EffectDefinition* known = effects::find_effect(effect.name);
    if (!known || known->home != effects::Home::material) carried.push_back(effect);
  }
  return carried;
}

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

Transfer transfer(FitGround& ground, const std::vector<plant::Effect>& carried,
                  const TransferOptions& options) {
  const auto say = [&](const char* what, double share) {
    if (options.progress) options.progress(what, share);
  };
  Transfer result;
  Hypothesis effects;
  effects.effects = carried;
  check_places(effects, ground.experiment());
  for (const plant::Effect& effect : carried) result.effects.push_back(effect.name);

  say("fitting modulus, density and damping", 0.0);
  const std::array horizons{ground.first_horizon(), 1.0};
  FitSummary base = fit_growing(ground.source(), ground.baseline(), ground.options(), horizons);
  if (!options.stopped()) {
    say("checking our own numerical error", 0.3);
    ground.refine(base, [](int) {});
    base.hypothesis.add(ground.nuisance());
    base = fit(ground.source(), base.hypothesis, ground.options());
  }
  // From the refitted numbers: the effects seldom move them far.
  Hypothesis with = base.hypothesis;
  with.add(effects);
  say("fitting them beside what was carried over", 0.6);
  const FitSummary both = fit_growing(ground.source(), with, ground.options(), horizons);
  // The better model shows the noise better.
  ground.renew_noise(both.cost < base.cost ? both.hypothesis : base.hypothesis);
  base = refit(ground.source(), base, ground.options());
  with = refit(ground.source(), both, ground.options()).hypothesis;
  result.stopped = options.stopped();
  if (result.stopped) return result;

  say("comparing", 0.9);
  const std::array models{Hypothesis{}, base.hypothesis, with};
  const auto misfits = ground.misfits(models);
  const auto sum_of = [&](Model model, const std::vector<int>& trials) {
    Misfit sum;
    for (const int t : trials) sum += misfits[model][static_cast<std::size_t>(t)];
    return sum;
  };
  const auto errors_of = [&](const std::vector<int>& trials) {
    Errors errors;
    if (trials.empty()) return errors;
    errors.nominal = sum_of(nominal, trials).rms();
    errors.refitted = sum_of(refitted, trials).rms();
    errors.extended = sum_of(Model::extended, trials).rms();
    return errors;
  };
  const std::vector<int> fitted = ground.options().trials, check = ground.check_trials();
  result.fit = errors_of(fitted);
  result.check = errors_of(check);
  const bool held_out = result.check.refitted.has_value();
  const Errors& errors = held_out ? result.check : result.fit;
  const int samples = sum_of(refitted, held_out ? check : fitted).count;
  const double scatter = interval95 / std::sqrt(2.0 * std::max(1, samples));
  if (errors.refitted && *errors.refitted - 1.0 > scatter)
    result.gain = (*errors.refitted - *errors.extended) / (*errors.refitted - 1.0);
  result.refitted = factors(base.hypothesis);
  result.extended = factors(with);
  result.simulations = ground.simulations();
  return result;
}

Transfer transfer(const plant::PlantFile& extended, const Experiment& experiment,
                  const TransferOptions& options) {
  Transfer refused;
  refused.refusal = admit(experiment).refusal;
  if (!refused.refusal.empty()) return refused;
  return transfer(*plant_ground(experiment, options.threads, options.stop),
                  carried_effects(extended.effects), options);
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
