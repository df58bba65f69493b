#pragma once

#include "pedicel/discrepancy/scene_procedure/scene_diagnosis.h"

namespace pedicel::discrepancy {

/// Fills `diagnosis.verdict` from its findings and predictions. `data`: as they are judged.
void conclude_scene(SceneSimulator& simulator, const SceneDataSet& data,
                    const SceneSearchSettings& settings, SceneDiagnosis& diagnosis);

}  // namespace pedicel::discrepancy
