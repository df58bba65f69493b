#pragma once

#include "plugins/discrepancy/scene_procedure/scene_diagnosis.h"

namespace pedicel::discrepancy {

/// Fills `diagnosis.verdict` from its findings and predictions. `data`: as they are judged.
void conclude_scene(SceneSimulator& simulator, const SceneDataSet& data,
                    const SceneSearchSettings& settings, SceneDiagnosis& diagnosis);

/// Puts the motion that decides into the verdict's sentence, before what instruments alone tell;
/// behind it, where no motion does.
void tell_next_motion(const SceneNext& next, Verdict& verdict);

}  // namespace pedicel::discrepancy
