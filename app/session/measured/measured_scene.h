#pragma once

#include <optional>
#include <vector>

#include "app/session/measured/measured_models.h"
#include "app/session/measured/scene_paths.h"
#include "engine/robot/kinematics.h"
#include "plugins/discrepancy/scene_procedure/scene_diagnosis.h"

namespace pedicel::app {

/// A measured run of a robot at plants: what the models say of it, and a diagnosis.
class MeasuredScene final
    : public MeasuredModels<discrepancy::Experiment, ScenePath, discrepancy::SceneDiagnosis> {
 public:
  /// Takes an experiment in place of the one before, and begins to simulate it as its files say.
  void open(discrepancy::Experiment experiment);
  void close();
  const std::vector<ScenePlantShape>& shapes() const { return shapes_; }
  /// Poses of the robot's links at a time (s) of a trial, as its joints were measured, into `out`.
  void arm_at(int trial, double time, std::vector<Pose>& out) const;

  /// Throws UsageError without an experiment, or where a diagnosis runs already. `threads` 0: all
  /// cores but one, which the picture keeps.
  void start_diagnosis(int threads = 0);
  /// What was found and a run of the scene can have: effects of contact, arm and plants, and of
  /// sensors that stand in the scene's file.
  std::vector<plant::Effect> found_effects() const;

 private:
  void run(const std::vector<discrepancy::Model>& models,
           const std::vector<discrepancy::SceneVariant>& variants);
  bool has_sensors() const;
  void adopt_diagnosis() override;

  std::vector<ScenePlantShape> shapes_;
  std::optional<robot::KinematicModel> robot_;
  std::vector<discrepancy::JointPath> arms_;  // by trial
};

}  // namespace pedicel::app
