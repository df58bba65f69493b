#pragma once

#include <string>
#include <vector>

#include "pedicel/discrepancy/scene/scene_state.h"
#include "pedicel/effects/registry/effect_definition.h"
#include "pedicel/io/yaml.h"

/// Effects of a robot at a plant: its contact, its arm, its instruments. Those of plants alone are
/// in plugins/effects; either may stand under `effects:` of a scene's experiment.
namespace pedicel::discrepancy {

/// What a scene effect acts on.
struct SceneEffectTarget {
  const plant::Effect& effect;
  const SceneExperiment& experiment;
  SceneState& state;

  double number(const char* parameter) const { return effect.number(parameter); }
  bool has(const char* parameter) const { return effect.numbers.contains(parameter); }
  Vec3 vector(const char* parameter) const { return Vec3(effect.numbers.at(parameter).data()); }
  /// Empty where the effect does not say it.
  std::string word(const char* parameter) const {
    const auto found = effect.words.find(parameter);
    return found == effect.words.end() ? std::string() : found->second;
  }
  /// Plants, sensors, cameras that an effect names, or all where it names none.
  template <class Task>
  void each_plant(const Task& task) const {
    const std::string name = word("plant");
    for (std::size_t p = 0; p < experiment.plants.size(); ++p)
      if (name.empty() || experiment.plants[p].name == name) task(state.plants[p]);
  }
  template <class Task>
  void each_gauge(const Task& task) const {
    const std::string name = word("wrench");
    for (std::size_t w = 0; w < experiment.wrenches.size(); ++w)
      if (name.empty() || experiment.wrenches[w].name == name) task(state.gauges[w]);
  }
  template <class Task>
  void each_camera(const Task& task) const {
    const std::string name = word("camera");
    for (Camera& camera : state.cameras)
      if (name.empty() || camera.name == name) task(camera);
  }
  /// Degree of freedom that the effect's `joint` names; -1: all.
  int joint() const;
  int link() const;  ///< that its `link` names; -1: all
};

/// Where fits of a scene effect may begin.
struct SceneStartContext {
  const SceneExperiment& experiment;
};

/// Everything that is known of a scene effect, in one place.
struct SceneEffectDefinition {
  std::string name;        ///< as files say it
  std::string plain_name;  ///< for sentences
  std::string sentence;    ///< what it does
  std::vector<effects::EffectParameter> parameters;
  void (*apply)(const SceneEffectTarget&) = nullptr;
  /// It changes what instruments say of a motion, and not the motion (where the arm follows its
  /// joints).
  bool is_only_seen = false;
  /// From where fits of it start; none where the experiment cannot show it.
  std::vector<effects::Start> (*starts)(const SceneStartContext&) = nullptr;
  std::string tells_apart;  ///< an experiment that parts it from its look-alikes

  const effects::EffectParameter* find(const std::string& parameter) const;
};

/// In the order of the list in CMakeLists.txt.
const std::vector<SceneEffectDefinition>& scene_effect_definitions();
/// Null where there is none of that name.
const SceneEffectDefinition* find_scene_effect(const std::string& name);

/// An effect with the numbers that a fit may change.
struct SceneFit {
  plant::Effect effect;
  std::vector<effects::FreeParameter> free;
};

/// Starts of a scene effect, with units and vanishing values of its definition.
std::vector<SceneFit> starts_of(const SceneEffectDefinition& definition,
                                const SceneStartContext& context);

/// Changes the state. False where it is no scene effect.
bool apply_scene_effect(const plant::Effect& effect, const SceneExperiment& experiment,
                        SceneState& state);

/// Whether an effect leaves the motion of a trial as it is.
bool is_only_seen(const plant::Effect& effect);

/// Reads one entry of `effects:`, of a scene or of a plant. What it names (a plant, a link, a
/// camera) must be there. Faults go to the node's diagnostics.
plant::Effect read_scene_effect(const io::YamlNode& node, const SceneExperiment& experiment);

std::vector<SceneEffectDefinition> make_scene_effect_definitions();

}  // namespace pedicel::discrepancy
