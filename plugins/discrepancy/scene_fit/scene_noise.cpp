#include "plugins/discrepancy/scene_fit/scene_noise.h"

#include <map>

#include "plugins/discrepancy/scene/scene_effects.h"

namespace pedicel::discrepancy {

namespace {

constexpr int draws = 7;  // with the model itself they fill the solver's eight lanes

// Predictions of the trials in which something comes off, sooner and later: a stalk parts at one
// moment, and a sample beside it is off by hundreds of noise units where two solvers differ by a
// few milliseconds.
std::map<int, std::vector<SceneReadings>> sooner_and_later(
    SceneSimulator& simulator, const SceneVariant& model,
    const std::vector<const SceneReadings*>& own) {
  std::vector<SceneVariant> variants;
  for (const SceneEffectDefinition& one : scene_effect_definitions())
    for (const double share : {-one.factor_known_to, one.factor_known_to}) {
      if (share == 0.0) continue;
      plant::Effect effect;
      effect.name = one.name;
      effect.numbers["factor"] = {1.0 + share};
      variants.push_back(model);
      variants.back().effects.push_back(effect);
    }
  std::vector<SceneSimulator::Request> requests;
  for (int t = 0; t < static_cast<int>(own.size()); ++t)
    if (!own[static_cast<std::size_t>(t)]->events.empty())
      for (const SceneVariant& variant : variants) requests.push_back({&variant, t});
  std::map<int, std::vector<SceneReadings>> all;
  std::vector<SceneReadings> readings = simulator.run(requests);
  for (std::size_t i = 0; i < requests.size(); ++i)
    all[requests[i].trial].push_back(std::move(readings[i]));
  return all;
}

}  // namespace

std::vector<SceneReadings> predictions_of(SceneSimulator& simulator, const SceneVariant& model) {
  std::vector<SceneSimulator::Request> requests;
  for (int t = 0; t < static_cast<int>(simulator.experiment().trials.size()); ++t)
    // Of the held-out trials, too: they are judged under the same noise.
    requests.push_back({&model, t});
  return simulator.run(requests);
}

void widen_noise(SceneSimulator& simulator, SceneDataSet& data, const SceneVariant& model,
                 std::span<const SceneReadings> finer) {
  const int trials = static_cast<int>(simulator.experiment().trials.size());
  // The first one, of draw 0, is the model as it is told everywhere.
  std::vector<SceneVariant> variants(draws + 1, model);
  for (int d = 0; d <= draws; ++d) variants[static_cast<std::size_t>(d)].draw = d;
  std::vector<SceneSimulator::Request> requests;
  for (int t = 0; t < trials; ++t)
    // A contact that sticks feels a micrometre, and noise of the encoders, smoothed, leaves one or
    // two. What that does to a force no model can foretell.
    for (const SceneVariant& variant : variants) requests.push_back({&variant, t});
  // All trials at once, each with its eight ways of the arm.
  const std::vector<SceneReadings> readings = simulator.run(requests);
  std::vector<const SceneReadings*> own;
  for (int t = 0; t < trials; ++t)
    own.push_back(&readings[static_cast<std::size_t>(t) * variants.size()]);
  std::map<int, std::vector<SceneReadings>> doubts = sooner_and_later(simulator, model, own);
  for (int t = 0; t < trials; ++t) {
    const auto first = static_cast<std::size_t>(t) * variants.size();
    std::vector<SceneReadings> others(readings.begin() + static_cast<long>(first) + 1,
                                      readings.begin() + static_cast<long>(first + draws) + 1);
    // The mesh counts as much as all draws together, and so does the model itself, from which there
    // is no difference: a third of each square is what counts.
    if (!finer.empty()) {
      for (int d = 0; d < draws; ++d) others.push_back(finer[static_cast<std::size_t>(t)]);
      for (int d = 0; d < draws; ++d) others.push_back(readings[first]);
    }
    // A model that cannot be simulated says nothing of how sure it is. The noise stays what it was.
    if (readings[first].healthy) data.widen(t, readings[first], others, doubts[t]);
  }
}

}  // namespace pedicel::discrepancy
