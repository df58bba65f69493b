#include "plugins/discrepancy/scene_fit/scene_parameters.h"

#include <algorithm>

#include "plugins/discrepancy/scene_fit/plant_causes.h"
#include "plugins/discrepancy/scene_fit/scene_fit.h"
#include "plugins/discrepancy/scene_fit/scene_noise.h"

namespace pedicel::discrepancy {

namespace {

/// A robot at plants.
class SceneGround : public FitGround {
 public:
  SceneGround(const Experiment& experiment, int threads, const std::atomic<bool>* stop,
              const SceneNumerics& numerics)
      : simulator_(experiment, numerics, threads, stop),
        data_(experiment),
        evaluator_(simulator_, data_) {
    for (int t = 0; t < static_cast<int>(experiment.trials.size()); ++t)
      if (experiment.trials[static_cast<std::size_t>(t)].use != Trial::Use::check)
        trials_.push_back(t);
    // Contacts begin a step earlier or later with other noise of the encoders. Without that
    // uncertainty a few samples about each touch would weigh more than all others.
    widen_noise(simulator_, data_, {});
  }

  const Experiment& experiment() const override { return simulator_.experiment(); }
  ResidualSource& source() override { return evaluator_; }
  FitOptions options() const override { return evaluator_.options(trials_); }
  void renew_noise(const Hypothesis& model) override {
    widen_noise(simulator_, data_, {model.effects});
  }
  std::vector<int> check_trials() const override {
    std::vector<int> check;
    for (int t = 0; t < static_cast<int>(experiment().trials.size()); ++t)
      if (std::ranges::find(trials_, t) == trials_.end()) check.push_back(t);
    return check;
  }
  Hypothesis baseline() override { return scene_baseline(experiment()); }
  std::vector<std::vector<Misfit>> misfits(std::span<const Hypothesis> models) override {
    std::vector<std::vector<Misfit>> all(models.size());
    for (std::size_t m = 0; m < models.size(); ++m) {
      const std::vector<SceneReadings> predicted = predictions_of(simulator_, {models[m].effects});
      for (std::size_t t = 0; t < predicted.size(); ++t) {
        Misfit& sum = all[m].emplace_back();
        for (const Misfit& one : data_.sums(static_cast<int>(t), predicted[t])) sum += one;
      }
    }
    return all;
  }
  void describe(ParameterFit& fit) override {
    const SceneReadings nothing = predictions_of(simulator_, {}).front();
    const auto sums = data_.sums(0, nothing);
    for (std::size_t c = 0; c < sums.size(); ++c) {
      const auto channel = static_cast<SceneChannel>(c);
      if (sums[c].count > 0)
        fit.noise.emplace_back(std::string(channel_name(channel)) + "_std",
                               data_.deviation(channel));
    }
    fit.distance = simulator_.numerics().distance;
    fit.dt = simulator_.numerics().dt;
  }
  long simulations() const override { return simulator_.simulations(); }

 private:
  SceneSimulator simulator_;
  SceneDataSet data_;
  SceneEvaluator evaluator_;
  std::vector<int> trials_;  // to be fitted
};

}  // namespace

FitVocabulary scene_vocabulary(const Experiment& experiment) {
  FitVocabulary known;
  const auto add = [&](const std::string& name, const SceneFit& fit) {
    Hypothesis start;
    start.name = name;
    start.effects = {fit.effect};
    start.free = fit.free;
    const auto cause = std::ranges::find(known.causes, name, &Cause::name);
    if (cause == known.causes.end())
      known.causes.push_back({name, {start}});
    else
      cause->starts.push_back(start);
  };
  for (const SceneEffectDefinition& definition : scene_effect_definitions())
    for (const SceneFit& start : starts_of(definition, {experiment})) add(definition.name, start);
  for (const SceneFit& start : plant_starts(experiment, {})) add(start.effect.name, start);
  known.kind = [](const std::string& name) -> std::optional<EffectKind> {
    if (const SceneEffectDefinition* own = find_scene_effect(name))
      return EffectKind{&own->parameters, false};
    if (const effects::EffectDefinition* own = effects::find_effect(name))
      return EffectKind{&own->parameters, own->needs_place};
    return {};
  };
  return known;
}

std::unique_ptr<FitGround> scene_ground(const Experiment& experiment, int threads,
                                        const std::atomic<bool>* stop,
                                        const SceneNumerics& numerics) {
  return std::make_unique<SceneGround>(experiment, threads, stop, numerics);
}

}  // namespace pedicel::discrepancy
