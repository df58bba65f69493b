#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pedicel/app/session/measured/diagnosis_job.h"
#include "pedicel/app/session/measured/path_runs.h"
#include "pedicel/app/session/measured/scene_paths.h"
#include "pedicel/discrepancy/scene_procedure/scene_diagnosis.h"
#include "pedicel/robot/kinematics.h"

namespace pedicel::app {

/// A measured run of a robot at plants beside the session's document, as MeasuredData is one of a
/// plant alone: what was measured, what the models say of it, and a diagnosis. Simulations and
/// diagnoses run on threads of their own. All calls from one thread.
class MeasuredScene {
 public:
  MeasuredScene();
  /// Asks what runs to stop, and waits for it.
  ~MeasuredScene();

  /// Takes an experiment in place of the one before, and begins to simulate it as its files say.
  void open(discrepancy::SceneExperiment experiment);
  void close();
  /// Null: none is open.
  const discrepancy::SceneExperiment* experiment() const { return experiment_.get(); }
  /// Grows when another experiment was opened or this one closed.
  int number() const { return number_; }
  const std::vector<ScenePlantShape>& shapes() const { return shapes_; }
  /// Poses of the robot's links at a time (s) of a trial, as its joints were measured, into `out`.
  void arm_at(int trial, double time, std::vector<Pose>& out) const;

  /// Null: not known, or not yet.
  const ScenePath* path(discrepancy::Model model, int trial) const;
  /// Whether a model has anything to show.
  bool has(discrepancy::Model model) const;
  /// Trials of models that are still being simulated.
  int still_simulated() const { return runs_.awaited(number_); }

  /// Throws UsageError without an experiment, or where a diagnosis runs already. `threads` 0: all
  /// cores but one, which the picture keeps.
  void start_diagnosis(int threads = 0);
  /// Asks it to stop; nothing where none runs.
  void cancel_diagnosis();
  bool is_diagnosing() const { return diagnosing_ != nullptr; }
  bool is_cancelling() const { return diagnosing_ && diagnosing_->is_cancelled(); }
  DiagnosisProgress progress() const;
  /// The last one that came to an end; null: none did.
  const discrepancy::SceneDiagnosis* diagnosis() const { return diagnosis_.get(); }
  /// What was found and a run of the scene can have: effects of contact, arm and plants, and of
  /// sensors that stand in the scene's file.
  std::vector<plant::Effect> found_effects() const;

  /// Takes over what the threads have made; once a frame. What they could not do, a line each.
  std::vector<std::string> update();
  /// Waits until nothing runs any more (scripts, tests).
  std::vector<std::string> wait();

 private:
  using Job = DiagnosisJob<discrepancy::SceneDiagnosis>;
  void simulate(const std::vector<discrepancy::Model>& models,
                const std::vector<discrepancy::SceneVariant>& variants);
  bool has_sensors() const;
  void take_diagnosis(std::vector<std::string>& faults);
  void retire();

  std::shared_ptr<const discrepancy::SceneExperiment> experiment_;
  int number_ = 0;
  std::vector<ScenePlantShape> shapes_;
  std::optional<robot::KinematicModel> robot_;
  std::vector<discrepancy::JointPath> arms_;  // by trial
  std::array<std::vector<std::optional<ScenePath>>, discrepancy::model_count> paths_;
  std::shared_ptr<const discrepancy::SceneDiagnosis> diagnosis_;
  PathRuns<ScenePath> runs_;
  std::unique_ptr<Job> diagnosing_;
  std::vector<std::unique_ptr<Job>> retired_;  // asked to stop, not yet ended
};

}  // namespace pedicel::app
