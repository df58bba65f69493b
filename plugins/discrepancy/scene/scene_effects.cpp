#include "plugins/discrepancy/scene/scene_effects.h"

#include <algorithm>

#include "engine/robot/kinematics.h"
#include "plugins/discrepancy/simulate/variant_plant.h"
#include "plugins/plant/effect_reader.h"

namespace pedicel::discrepancy {

namespace {

template <class Items>
std::vector<std::string> name_list(const Items& items) {
  std::vector<std::string> names;
  for (const auto& item : items) names.push_back(item.name);
  return names;
}

// What an effect may name by a word, and what there is of it.
std::vector<std::string> known_of(const std::string& parameter, const Experiment& experiment) {
  if (parameter == "plant") return name_list(experiment.plants);
  if (parameter == "wrench") return name_list(experiment.wrenches);
  if (parameter == "camera") return name_list(experiment.cameras);
  if (parameter == "link") return name_list(experiment.robot.links);
  if (parameter == "marker") return name_list(experiment.markers);
  if (parameter == "joint" && !experiment.robot.links.empty()) return joint_names(experiment.robot);
  if (parameter == "trial") return name_list(experiment.trials);
  return {};
}

void check_words(const io::YamlNode& node, const plant::Effect& effect,
                 const Experiment& experiment) {
  for (const auto& [parameter, word] : effect.words) {
    const std::vector<std::string> known = known_of(parameter, experiment);
    if (known.empty() || std::ranges::find(known, word) != known.end()) continue;
    std::string list;
    for (const std::string& name : known) list += (list.empty() ? "" : ", ") + name;
    node.error(parameter + " \"" + word + "\" is unknown, expected one of: " + list);
  }
}

bool has_column(const Samples& samples, long first, long count) {
  if (samples.size() == 0 || first + count > samples.value.cols()) return false;
  return samples.value.middleCols(first, count).array().isFinite().any();
}

// A start says names and sizes; what the numbers are measured in stands once, in the definition.
void describe(const SceneEffectDefinition& definition, SceneFit& fit) {
  for (effects::FreeParameter& free : fit.free)
    if (const effects::EffectParameter* described = definition.find(free.name)) {
      free.unit = described->unit;
      free.vanishes = described->vanishes;
    }
}

}  // namespace

const effects::EffectParameter* SceneEffectDefinition::find(const std::string& parameter) const {
  for (const effects::EffectParameter& one : parameters)
    if (one.name == parameter) return &one;
  return nullptr;
}

const std::vector<SceneEffectDefinition>& scene_effect_definitions() {
  static const std::vector<SceneEffectDefinition> all = make_scene_effect_definitions();
  return all;
}

const SceneEffectDefinition* find_scene_effect(const std::string& name) {
  for (const SceneEffectDefinition& one : scene_effect_definitions())
    if (one.name == name) return &one;
  return nullptr;
}

int SceneEffectTarget::joint() const {
  const std::string name = word("joint");
  return name.empty() ? -1 : robot::KinematicModel(experiment.robot).joint_index(name);
}

int SceneEffectTarget::link() const {
  const std::string name = word("link");
  return name.empty() ? -1 : experiment.robot.link(name);
}

std::vector<SceneFit> starts_of(const SceneEffectDefinition& definition,
                                const SceneStartContext& context) {
  std::vector<SceneFit> out;
  if (!definition.starts) return out;
  for (const effects::Start& start : definition.starts(context)) {
    SceneFit fit{start.effect(), start.free()};
    describe(definition, fit);
    out.push_back(std::move(fit));
  }
  return out;
}

std::vector<std::string> scene_spoken_for(const std::string& symptom) {
  std::vector<std::pair<int, std::string>> ranked;
  const auto add = [&](const auto& definitions) {
    for (const auto& one : definitions)
      for (const effects::Sign& sign : one.speaks_for)
        if (sign.symptom == symptom) ranked.emplace_back(sign.rank, one.name);
  };
  add(scene_effect_definitions());
  add(effects::effect_definitions());
  std::ranges::stable_sort(ranked, {}, [](const auto& entry) { return entry.first; });
  std::vector<std::string> names;
  for (auto& [rank, name] : ranked) names.push_back(std::move(name));
  return names;
}

bool is_seen(const Experiment& experiment, int plant) {
  for (std::size_t m = 0; m < experiment.markers.size(); ++m) {
    if (experiment.markers[m].plant != plant) continue;
    const auto at = static_cast<long>(m);
    for (const Trial& trial : experiment.trials) {
      if (has_column(trial.markers, 3 * at, 3)) return true;
      for (const Samples& pixels : trial.pixels)
        if (has_column(pixels, 2 * at, 2)) return true;
    }
  }
  return false;
}

std::vector<SceneFit> baseline_effects(const SceneStartContext& context) {
  std::vector<SceneFit> out;
  for (const SceneEffectDefinition& one : scene_effect_definitions()) {
    if (!one.in_baseline) continue;
    for (SceneFit& fit : one.in_baseline->fits(context)) {
      describe(one, fit);
      out.push_back(std::move(fit));
    }
  }
  return out;
}

const SceneEffectDefinition* told_of_baseline(const plant::Effect& effect,
                                              const effects::FreeParameter& free) {
  const SceneEffectDefinition* known = find_scene_effect(effect.name);
  // As a cause, an effect has no prior on that number.
  const bool told = known && known->in_baseline && free.prior != 0.0 &&
                    free.name == known->in_baseline->parameter;
  return told ? known : nullptr;
}

bool apply_scene_effect(const plant::Effect& effect, const Experiment& experiment,
                        SceneState& state) {
  const SceneEffectDefinition* definition = find_scene_effect(effect.name);
  if (!definition) return false;
  definition->apply({effect, experiment, state});
  return true;
}

bool is_only_seen(const plant::Effect& effect) {
  const SceneEffectDefinition* definition = find_scene_effect(effect.name);
  return definition ? definition->is_only_seen : is_of_sensor(effect);
}

plant::Effect read_scene_effect(const io::YamlNode& node, const Experiment& experiment) {
  const bool named = node.is_map() && node.raw()["name"] && node.raw()["name"].IsScalar();
  const std::string name = named ? node.raw()["name"].Scalar() : "";
  plant::Effect effect;
  if (const SceneEffectDefinition* definition = find_scene_effect(name)) {
    effect.where = node.position();
    io::YamlMap map(node, "an effect");
    effect.name = map.text("name");
    plant::read_effect_parameters(map, definition->parameters, effect);
    map.finish();
  } else {
    const effects::EffectDefinition* known = effects::find_effect(name);
    effect = plant::read_effect(node, known ? known->file : effects::EffectFile::experiment);
  }
  check_words(node, effect, experiment);
  return effect;
}

}  // namespace pedicel::discrepancy
