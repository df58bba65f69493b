#include "plugins/effects/registry/model_change.h"

#include <algorithm>

#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::effects {

namespace {

const ModelChange* change_of(const plant::Effect& effect) {
  const EffectDefinition* definition = find_effect(effect.name);
  return definition ? std::get_if<ModelChange>(&definition->change) : nullptr;
}

// Sliders and dashpots take their shares from what is elastic: something has to be left.
void check_elastic(const ModelTarget& target) {
  bool empty = false;
  target.each_span([&](const plant::RodPlaces::Span& span) {
    const cosserat::JointLaw& law = target.model.laws[span.element];
    empty = empty || law.elastic < 1.0e-6 || law.elastic + law.deviation < -1.0e-12;
  });
  if (empty)
    target.error("effect \"" + target.effect.name +
                 "\" and others leave no elastic stiffness, expected the ratios and fractions on a "
                 "curve to be less than 1 together");
}

}  // namespace

double ModelTarget::joint_length(int e) const {
  const cosserat::Element& element = model.elements[e];
  return 0.5 * element.length +
         (element.parent < 0 ? 0.0 : 0.5 * model.elements[element.parent].length);
}

double ModelTarget::softer_bending(int e) const {
  const Vec3& k = model.elements[e].bend_stiffness;
  return std::min(k.x(), k.y());
}

double ModelTarget::along(const plant::RodPlaces::Span& span, double gradient) const {
  const double s = 0.5 * (span.arc_near + span.arc_far) / places.curve_lengths[span.curve];
  return 1.0 + gradient * (s - 0.5);
}

double ModelTarget::along_at_joint(const plant::RodPlaces::Span& span, double gradient) const {
  const bool clamped = model.elements[span.element].parent < 0;
  const double share = clamped ? 0.25 : 0.0;
  const double arc = (1.0 - share) * span.arc_near + share * span.arc_far;
  return 1.0 + gradient * (arc / places.curve_lengths[span.curve] - 0.5);
}

void ModelTarget::soften(int element, double stiffness) {
  for (int axis = 0; axis < 2; ++axis) {
    double& k = model.elements[element].bend_stiffness[axis];
    k = 1.0 / (1.0 / k + 1.0 / stiffness);
  }
}

void apply_effects(const plant::PlantFile& plant, const std::vector<plant::Effect>& effects,
                   cosserat::RodModel& model, const plant::RodPlaces& places,
                   Diagnostics& diagnostics) {
  for (const plant::Effect& effect : effects)
    if (!change_of(effect))
      diagnostics.error(effect.where, "effect \"" + effect.name +
                                          "\" is none of a plant's model, expected one that is");
  if (diagnostics.has_errors()) return;
  const auto run = [&](Stage stage) {
    for (const plant::Effect& effect : effects) {
      const ModelChange* change = change_of(effect);
      if (change->stage != stage) continue;
      ModelTarget target{plant, effect, model, places, diagnostics};
      change->apply(target);
    }
  };
  for (const Stage stage : {Stage::frames, Stage::constants, Stage::laws}) run(stage);
  if (!model.laws.empty())
    for (const plant::Effect& effect : effects)
      if (find_effect(effect.name)->home == Home::joint && change_of(effect)->stage >= Stage::laws)
        check_elastic({plant, effect, model, places, diagnostics});
  run(Stage::last);
}

}  // namespace pedicel::effects
