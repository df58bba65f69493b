#pragma once

#include "plugins/discrepancy/files/experiment_files.h"
#include "plugins/discrepancy/scene_predict/scene_observe.h"
#include "tests/unit/discrepancy_scene/arm_at_stem.h"

/// A run of an arm at a stem, as the program itself would see it.
namespace pedicel::testing {

struct MeasuredPush {
  std::vector<std::string> effects;  ///< that the files lack: "{name: contact_friction, ...}"
  discrepancy::ArmAtStem at{};

  discrepancy::Experiment experiment() const {
    at.write_all();
    const discrepancy::Experiment plain = at.read();
    discrepancy::SceneVariant variant;
    for (const std::string& text : effects)
      variant.effects.push_back(discrepancy::scene_effect(text, plain));
    return discrepancy::observed_scene(plain, variant, {});
  }

  /// As a folder; its path.
  std::filesystem::path write(const std::filesystem::path& folder) const {
    discrepancy::write_experiment(folder, experiment());
    return folder;
  }
};

}  // namespace pedicel::testing
