#include "plugins/effects/registry/effect_definition.h"

#include <algorithm>

#include "engine/core/check.h"

namespace pedicel::effects {

const EffectParameter* EffectDefinition::find(const std::string& parameter) const {
  for (const EffectParameter& one : parameters)
    if (one.name == parameter) return &one;
  return nullptr;
}

const std::vector<EffectDefinition>& effect_definitions() {
  static const std::vector<EffectDefinition> all = make_effect_definitions();
  return all;
}

const EffectDefinition* find_effect(const std::string& name) {
  for (const EffectDefinition& one : effect_definitions())
    if (one.name == name) return &one;
  return nullptr;
}

const EffectParameter* find_parameter(const std::string& effect, const std::string& parameter) {
  const EffectDefinition* definition = find_effect(effect);
  return definition ? definition->find(parameter) : nullptr;
}

std::string plain_name(const std::string& effect) {
  const EffectDefinition* definition = find_effect(effect);
  return definition ? definition->plain_name : effect;
}

std::string unit_of(const std::string& effect, const std::string& parameter) {
  const EffectParameter* described = find_parameter(effect, parameter);
  if (described) return described->unit;
  return parameter == "heading" ? "rad" : "1";
}

bool is_time(const std::string& effect, const std::string& parameter) {
  const EffectParameter* described = find_parameter(effect, parameter);
  return described && described->role == Role::time;
}

const std::vector<const EffectDefinition*>& material_factors() {
  static const std::vector<const EffectDefinition*> all = [] {
    std::vector<const EffectDefinition*> found;
    for (const EffectDefinition& one : effect_definitions())
      if (one.home == Home::material) found.push_back(&one);
    return found;
  }();
  return all;
}

const EffectDefinition& material_factor(plant::MaterialRole role) {
  const auto& all = material_factors();
  const auto found = std::ranges::find_if(
      all, [&](const EffectDefinition* one) { return one->material->role == role; });
  PEDICEL_ASSERT(found != all.end());
  return **found;
}

bool same_family(const std::string& a, const std::string& b) {
  if (a == b) return true;
  const EffectDefinition *of_a = find_effect(a), *of_b = find_effect(b);
  return of_a && of_b && of_a->family != Family::alone && of_a->family == of_b->family;
}

std::vector<std::pair<std::string, std::string>> special_cases() {
  std::vector<std::pair<std::string, std::string>> pairs;
  for (const EffectDefinition& one : effect_definitions())
    for (const std::string& special : one.special_cases) pairs.emplace_back(special, one.name);
  return pairs;
}

bool is_special_case(const std::string& special, const std::string& general) {
  const EffectDefinition* definition = find_effect(general);
  return definition &&
         std::ranges::find(definition->special_cases, special) != definition->special_cases.end();
}

std::vector<std::string> spoken_for(const std::string& symptom) {
  std::vector<std::pair<int, std::string>> ranked;
  for (const EffectDefinition& one : effect_definitions())
    for (const Sign& sign : one.speaks_for)
      if (sign.symptom == symptom) ranked.emplace_back(sign.rank, one.name);
  std::ranges::stable_sort(ranked, {}, [](const auto& entry) { return entry.first; });
  std::vector<std::string> names;
  for (auto& [rank, name] : ranked) names.push_back(std::move(name));
  return names;
}

void apply_to_grip(const plant::Effect& effect, GripState& grip) {
  const EffectDefinition* definition = find_effect(effect.name);
  if (!definition) return;
  if (const auto* change = std::get_if<GripChange>(&definition->change))
    change->apply(effect, grip);
}

void apply_to_sensor(const plant::Effect& effect, SensorState& sensor) {
  const EffectDefinition* definition = find_effect(effect.name);
  if (!definition) return;
  if (const auto* change = std::get_if<SensorChange>(&definition->change))
    change->apply(effect, sensor);
}

}  // namespace pedicel::effects
