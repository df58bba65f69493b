#pragma once

#include <string>
#include <vector>

#include "plugins/discrepancy/scene/scene_state.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {

/// What the `effects:` of a scene file change where the scene runs.
struct RunEffects {
  SceneState state;
  std::vector<plant::Effect> of_plants;  ///< of the plants' models, beside those of their files
  std::vector<std::string> notes;        ///< effects that change nothing of a run, and why
  bool any = false;                      ///< the scene has some

  /// Those of one plant of the scene; "plant" is no longer among their words.
  std::vector<plant::Effect> of_plant(const std::string& name) const;
};

/// Reads the effects of a scene. `robot`: null where it has none. `coupling`: its own numbers.
/// Faults go to `diagnostics` with their places in the file.
RunEffects read_run_effects(const world::Scene& scene, const robot::RobotDescription* robot,
                            const coupling::CouplingSettings& coupling, Diagnostics& diagnostics);

/// The same effects as those of an experiment, which knows more that they may name.
std::vector<plant::Effect> scene_file_effects(const Experiment& experiment,
                                              Diagnostics& diagnostics);

}  // namespace pedicel::discrepancy
