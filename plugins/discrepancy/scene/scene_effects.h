#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/io/yaml.h"
#include "plugins/discrepancy/scene/scene_state.h"
#include "plugins/discrepancy/settings/scene_settings.h"
#include "plugins/effects/registry/effect_definition.h"

/// Effects of a robot at a plant: its contact, its arm, its instruments. Those of plants alone are
/// in plugins/effects; either may stand under `effects:` of a scene's experiment.
namespace pedicel::discrepancy {

/// What a scene effect acts on.
struct SceneEffectTarget {
  const plant::Effect& effect;
  const Experiment& experiment;
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
  const Experiment& experiment;
  const SceneSettings& settings = default_scene_settings();
};

/// An effect with the numbers that a fit may change.
struct SceneFit {
  plant::Effect effect;
  std::vector<effects::FreeParameter> free;
};

/// What a scene effect is of. What a run needs for it, and whether a run has it, follow from that.
enum class SceneHome {
  unset,
  contact,  ///< of robot and plant
  plant,
  arm,     ///< a run needs a robot
  wrench,  ///< a force sensor: a run needs a robot, and writes what the sensor says
  camera,  ///< measured images alone: a run draws its cameras as the scene has them
};

/// What makes an effect part of every baseline, where nothing that was measured shows directly what
/// it changes.
struct InBaseline {
  /// Its numbers, with priors; none: the data show it.
  std::vector<SceneFit> (*fits)(const SceneStartContext&) = nullptr;
  std::string parameter;  ///< a finding where it leaves 0
  /// Components of it, from the first on, that have no slope where the robot touches nothing: they
  /// are put to several values before the first fit.
  int without_slope = 0;
  std::string because;  ///< why it is named, for the verdict
  /// A component as the verdict tells it among the parameters: its name, and the files' own value.
  struct Told {
    std::string name;
    double nominal = 0.0;
  };
  Told (*told)(const Experiment&, const plant::Effect&, int component) = nullptr;
};

/// Everything that is known of a scene effect, in one place.
struct SceneEffectDefinition {
  std::string name;        ///< as files say it
  std::string plain_name;  ///< for sentences
  std::string sentence;    ///< what it does
  SceneHome home = SceneHome::unset;
  std::vector<effects::EffectParameter> parameters;
  void (*apply)(const SceneEffectTarget&) = nullptr;
  /// It changes what instruments say of a motion, and not the motion (where the arm follows its
  /// joints).
  bool is_only_seen = false;
  /// From where fits of it start; none where the experiment cannot show it.
  std::vector<effects::Start> (*starts)(const SceneStartContext&) = nullptr;
  std::optional<InBaseline> in_baseline;
  std::vector<effects::Sign> speaks_for;  ///< symptoms of scenes, by name and rank
  std::string tells_apart;                ///< an experiment that parts it from its look-alikes
  /// 1, relative: two honest solvers know its `factor` to this; 0: no part of the predictions'
  /// noise. Counted in trials in which something comes off.
  double factor_known_to = 0.0;

  const effects::EffectParameter* find(const std::string& parameter) const;
};

/// In the order of the list in CMakeLists.txt.
const std::vector<SceneEffectDefinition>& scene_effect_definitions();
/// Null where there is none of that name.
const SceneEffectDefinition* find_scene_effect(const std::string& name);

/// Names of the effects, of scenes and of plants, that a symptom of a scene speaks for: the
/// strongest first.
std::vector<std::string> scene_spoken_for(const std::string& symptom);

/// Starts of a scene effect, with units and vanishing values of its definition.
std::vector<SceneFit> starts_of(const SceneEffectDefinition& definition,
                                const SceneStartContext& context);

/// Whether a marker or an image point of a plant was measured.
bool is_seen(const Experiment& experiment, int plant);

/// Effects of the baseline: see InBaseline. With units and vanishing values of their definitions.
std::vector<SceneFit> baseline_effects(const SceneStartContext& context);

/// The definition that makes a fitted number part of the baseline and tells of it; null: another
/// number, or one of a cause.
const SceneEffectDefinition* told_of_baseline(const plant::Effect& effect,
                                              const effects::FreeParameter& free);

/// Changes the state. False where it is no scene effect.
bool apply_scene_effect(const plant::Effect& effect, const Experiment& experiment,
                        SceneState& state);

/// Whether an effect leaves the motion of a trial as it is.
bool is_only_seen(const plant::Effect& effect);

/// Reads one entry of `effects:`, of a scene or of a plant. What it names (a plant, a link, a
/// camera) must be there. Faults go to the node's diagnostics.
plant::Effect read_scene_effect(const io::YamlNode& node, const Experiment& experiment);

std::vector<SceneEffectDefinition> make_scene_effect_definitions();

}  // namespace pedicel::discrepancy
