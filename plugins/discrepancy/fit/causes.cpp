#include "pedicel/discrepancy/fit/causes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "pedicel/effects/registry/effect_definition.h"
#include "pedicel/plant/plant_builder.h"

namespace pedicel::discrepancy {

effects::StartContext start_context(const Experiment& experiment, const Scales& scales) {
  effects::StartContext context{experiment.plant, scales, 0.0, {}, {}, false};
  double first = 1e300, last = -1e300;
  for (const Trial& trial : experiment.trials) {
    first = std::min(first, trial.clock);
    last = std::max(last, trial.clock + trial.duration());
    context.force = context.force || trial.force.size() > 0;
    if (trial.holds.empty()) continue;
    double stiffness = 0.0;
    for (const Hold& hold : trial.holds)
      stiffness = std::max(stiffness, hold.stiffness.value_or(0.0));
    context.holds.push_back(
        {trial.name, std::min(trial.holds[0].release, trial.duration()), stiffness});
  }
  context.clock_span = last - first;
  for (const Marker& marker : experiment.markers) context.markers.push_back(marker.name);
  return context;
}

Hypothesis baseline() {
  Hypothesis all;
  const plant::PlantFile none;
  for (const effects::EffectDefinition& one : effects::effect_definitions())
    if (one.home == effects::Home::material)
      all.add(one.starts({none, {}, 0.0, {}, {}, false}).front());
  return all;
}

Hypothesis mesh_nuisance() {
  Hypothesis mesh =
      effects::Start(mesh_error).fixed("share", {0.3}).free_share(0.0, 2.0).prior(0.5, 0.3);
  mesh.name.clear();
  return mesh;
}

Hypothesis junction_nuisance(const Experiment& experiment, const Evidence& evidence) {
  Diagnostics diagnostics;
  const auto built = plant::build_plant(experiment.plant, {}, diagnostics);
  if (!built) throw InvalidFile(diagnostics);
  const auto& known = effects::effect_definitions();
  const auto spring = std::ranges::find_if(
      known, [](const effects::EffectDefinition& one) { return one.at_junction != nullptr; });
  Hypothesis all;
  if (spring == known.end()) return all;
  std::vector<char> seen(experiment.plant.curves.size(), 0);
  for (const plant::BuiltPlant::Span& span : built->spans) {
    const cosserat::Element& element = built->model.elements[span.element];
    if (std::exchange(seen[span.curve], 1) || element.parent < 0) continue;
    const cosserat::Section& section = element.section;
    const double softest =
        (section.bend1 + section.bend2) / (evidence.most_discretisation * element.length);
    all.add(spring->at_junction(experiment.plant.curves[span.curve].name, softest));
  }
  all.name.clear();
  return all;
}

// A solver that gives the joint the branch's whole segment, on a mesh of half the file's spacing,
// makes half of that compliance.
bool is_discretisation(const FitSummary& model, int count, const Evidence& evidence) {
  double weights = 0.0, sum = 0.0, squares = 0.0;
  for (int p = model.hypothesis.size() - count; p < model.hypothesis.size(); ++p) {
    const double share =
        evidence.most_discretisation * model.hypothesis.free[p].low / model.hypothesis.value(p);
    // The unknown is a logarithm.
    const double weight = std::pow(share * model.standard_error[p], -2);
    weights += weight;
    sum += weight * share;
    squares += weight * share * share;
  }
  const double mean = sum / weights, freedom = count - 1.0;
  return mean - 2.0 / std::sqrt(weights) <= evidence.discretisation &&
         (count < 2 || squares - sum * mean <= freedom + 3.0 * std::sqrt(2.0 * freedom));
}

std::vector<Cause> fitted_causes(const Experiment& experiment, const Scales& scales) {
  const effects::StartContext context = start_context(experiment, scales);
  std::vector<Cause> causes;
  for (const effects::EffectDefinition& one : effects::effect_definitions()) {
    if (!one.starts || one.home == effects::Home::material) continue;
    const std::vector<effects::Start> starts = one.starts(context);
    if (!starts.empty()) causes.push_back({one.name, {starts.begin(), starts.end()}});
  }
  return causes;
}

std::vector<Cause> candidate_causes(const Experiment& experiment, const Scales& scales) {
  std::vector<Cause> causes = fitted_causes(experiment, scales);
  std::erase_if(causes,
                [](const Cause& cause) { return !effects::find_effect(cause.name)->is_candidate; });
  return causes;
}

}  // namespace pedicel::discrepancy
