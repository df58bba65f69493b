#pragma once

#include <span>
#include <vector>

#include "plugins/discrepancy/scene_predict/scene_simulator.h"
#include "plugins/discrepancy/select/verdict.h"
#include "plugins/discrepancy/settings/scene_settings.h"

namespace pedicel::discrepancy {

/// What the robot's own sensors say of a plant, without any marker: in each trial with a wrench
/// where the tool holds when it pushes most, in the world and along the stem of the fitted model,
/// and when the force breaks off (something slips or comes off). One of each kind a trial.
/// `model`: effects of the fitted model. `force_std`, `moment_std`: N and N m. `standing_error`: m,
/// W, how well the model knows where plants stand that nothing else shows; 0 where all are seen.
std::vector<SymptomNumber> robot_alone(SceneSimulator& simulator,
                                       const std::vector<plant::Effect>& model, double force_std,
                                       double moment_std, const Vec3& standing_error,
                                       const RobotAloneSettings& settings);

/// m, W: where the tool pushes most by the measured wrenches, less where it does by a model's, mean
/// of the trials in which both push; 0 where none does. A model whose plant stands elsewhere along
/// the tool feels the same force, but not at the same place of the tool.
Vec3 push_shift(SceneSimulator& simulator, const std::vector<plant::Effect>& model,
                double force_std, const RobotAloneSettings& settings);

}  // namespace pedicel::discrepancy
