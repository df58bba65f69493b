#include "pedicel/discrepancy/scene_fit/plant_causes.h"

#include <algorithm>
#include <set>

#include "pedicel/discrepancy/simulate/scales.h"

namespace pedicel::discrepancy {

namespace {

constexpr std::size_t most_curves = 6;  // a start costs a simulation for each of its numbers

bool is_looked_for(const effects::EffectDefinition& one) {
  using effects::Family;
  const bool of_the_stem = one.family == Family::softness || one.family == Family::mass ||
                           one.family == Family::nonlinearity;
  return one.file == effects::EffectFile::plant && one.is_candidate && one.starts &&
         !one.has_threshold && one.home != effects::Home::material && of_the_stem;
}

double length_of(const plant::PlantCurve& curve) {
  double length = 0.0;
  for (std::size_t i = 1; i < curve.points.size(); ++i)
    length += (curve.points[i] - curve.points[i - 1]).norm();
  return length;
}

std::set<std::string> longest_curves(const plant::PlantFile& file) {
  std::vector<std::pair<double, std::string>> all;
  for (const plant::PlantCurve& curve : file.curves) all.emplace_back(length_of(curve), curve.name);
  std::ranges::stable_sort(all, std::ranges::greater{}, &std::pair<double, std::string>::first);
  std::set<std::string> names;
  for (std::size_t i = 0; i < std::min(most_curves, all.size()); ++i) names.insert(all[i].second);
  return names;
}

// One trial, whose markers are those of one plant: how far it moved is among the scales.
Experiment alone(const SceneExperiment& experiment, int plant) {
  Experiment own;
  own.plant = experiment.plants[static_cast<std::size_t>(plant)].file;
  for (const SceneTrial& scene : experiment.trials) {
    Trial trial;
    trial.clock = scene.clock;
    std::vector<long> columns;
    for (std::size_t m = 0; m < experiment.markers.size(); ++m)
      for (long c = 0; c < 3 && experiment.markers[m].plant == plant; ++c)
        columns.push_back(3 * static_cast<long>(m) + c);
    if (scene.markers.size() > 0 && !columns.empty()) {
      trial.markers.time = scene.markers.time;
      trial.markers.value.resize(scene.markers.size(), static_cast<long>(columns.size()));
      for (std::size_t c = 0; c < columns.size(); ++c)
        trial.markers.value.col(static_cast<long>(c)) = scene.markers.value.col(columns[c]);
    }
    own.trials.push_back(std::move(trial));
  }
  return own;
}

}  // namespace

std::vector<SceneFit> plant_causes(const SceneExperiment& experiment) {
  std::vector<SceneFit> out;
  for (std::size_t p = 0; p < experiment.plants.size(); ++p) {
    const Experiment own = alone(experiment, static_cast<int>(p));
    const std::set<std::string> curves = longest_curves(own.plant);
    effects::StartContext context{own.plant, scales_of(own), 0.0, {}, {}, false};
    double longest = 0.0;
    for (const SceneTrial& trial : experiment.trials) longest = std::max(longest, trial.duration());
    context.scales.duration = longest;
    for (const effects::EffectDefinition& one : effects::effect_definitions()) {
      if (!is_looked_for(one)) continue;
      for (const effects::Start& start : one.starts(context)) {
        SceneFit fit{start.effect(), start.free()};
        if (one.needs_place && fit.effect.place && !curves.contains(fit.effect.place->curve))
          continue;
        if (experiment.plants.size() > 1) fit.effect.words["plant"] = experiment.plants[p].name;
        out.push_back(std::move(fit));
      }
    }
  }
  return out;
}

}  // namespace pedicel::discrepancy
