#include "plugins/discrepancy/fit/causes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "plugins/effects/registry/effect_definition.h"
#include "plugins/plant/plant_builder.h"

namespace pedicel::discrepancy {

effects::StartContext start_context(const Experiment& experiment, const Scales& scales) {
  effects::StartContext context{experiment.plant(), scales, 0.0, {}, {}, false};
  // By the experiment's own clock: what drifts from trial to trial can be told only where that says
  // when each of them was.
  double first = 1e300, last = -1e300;
  for (const Trial& trial : experiment.trials) {
    first = std::min(first, trial.clock);
    last = std::max(last, trial.clock + trial.duration());
    // Effects of a force sensor are no candidates where there is none.
    context.force = context.force || trial.force.size() > 0;
    if (trial.holds.empty()) continue;
    double stiffness = 0.0;
    for (const Hold& hold : trial.holds)
      stiffness = std::max(stiffness, hold.stiffness.value_or(0.0));
    context.holds.push_back(
        // A hold that never lets go ends with its trial. Of several the first one counts, as it
        // does for the force that is measured.
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
    // Whatever a definition calls a number of the material is in every baseline, with its own
    // bounds and prior. They depend on no experiment, so an empty one does.
    if (one.home == effects::Home::material)
      all.add(one.starts({none, {}, 0.0, {}, {}, false}).front());
  return all;
}

Hypothesis mesh_nuisance() {
  // As a share of the file's spacing: 0 where the data know no mesh, 1 where they or the modulus
  // were made with this one, and at most 2.
  Hypothesis mesh =
      effects::Start(mesh_error).fixed("share", {0.3}).free_share(0.0, 2.0).prior(0.5, 0.3);
  // Without a name it is no cause, and a model with it is still the baseline.
  mesh.name.clear();
  return mesh;
}

Hypothesis junction_nuisance(const Experiment& experiment, const Evidence& evidence) {
  Diagnostics diagnostics;
  const auto built = plant::build_plant(experiment.plant(), {}, diagnostics);
  if (!built) throw InvalidFile(diagnostics);
  const auto& known = effects::effect_definitions();
  const auto spring = std::ranges::find_if(
      known, [](const effects::EffectDefinition& one) { return one.at_junction != nullptr; });
  Hypothesis all;
  if (spring == known.end()) return all;
  std::vector<char> seen(experiment.plant().curves.size(), 0);
  for (const plant::BuiltPlant::Span& span : built->spans) {
    const cosserat::Element& element = built->model.elements[span.element];
    // The first segment of a curve is the one at its junction; the root's has none.
    if (std::exchange(seen[span.curve], 1) || element.parent < 0) continue;
    const cosserat::Section& section = element.section;
    // Half a segment l gives l/2 over the mean of both bending stiffnesses, that is l/(bend1 +
    // bend2). The softest joint that is allowed gives `most_discretisation` times that.
    const double softest =
        (section.bend1 + section.bend2) / (evidence.most_discretisation * element.length);
    // The start is far stiffer than the softest, and its prior wide: junctions that no data see
    // stay out of the way.
    all.add(spring->at_junction(experiment.plant().curves[span.curve].name, softest));
  }
  // As above: a nuisance is no finding.
  all.name.clear();
  return all;
}

// A solver that gives the joint the branch's whole segment, on a mesh of half the file's spacing,
// makes half of that compliance.
bool is_discretisation(const FitSummary& model, int count, const Evidence& evidence) {
  double weights = 0.0, sum = 0.0, squares = 0.0;
  for (int p = model.hypothesis.size() - count; p < model.hypothesis.size(); ++p) {
    // In the compliance of half a segment. That is what meshes have in common, while stiffnesses of
    // thick and thin branches differ by orders of magnitude.
    const double share =
        evidence.most_discretisation * model.hypothesis.free[p].low / model.hypothesis.value(p);
    // The unknown is a logarithm.
    const double weight = std::pow(share * model.standard_error[p], -2);
    weights += weight;
    sum += weight * share;
    squares += weight * share * share;
  }
  const double mean = sum / weights, freedom = count - 1.0;
  // Two questions. Is their mean, less two deviations, no more than such a mesh makes? And are they
  // alike: their scatter is a chi-square of `freedom` degrees, with a mean of that and a variance
  // of twice that. One soft junction among stiff ones fails by the second.
  return mean - 2.0 / std::sqrt(weights) <= evidence.discretisation &&
         (count < 2 || squares - sum * mean <= freedom + 3.0 * std::sqrt(2.0 * freedom));
}

std::vector<Cause> fitted_causes(const Experiment& experiment, const Scales& scales) {
  const effects::StartContext context = start_context(experiment, scales);
  std::vector<Cause> causes;
  for (const effects::EffectDefinition& one : effects::effect_definitions()) {
    // What is in every baseline is no cause of its own; the verdict names its factor where that is
    // off.
    if (!one.starts || one.home == effects::Home::material) continue;
    const std::vector<effects::Start> starts = one.starts(context);
    // An effect without a start is one that this experiment cannot show.
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
