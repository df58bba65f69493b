#include "app/session/measured/measured_scene.h"

#include <algorithm>

#include "plugins/discrepancy/scene/scene_effects.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::app {

using discrepancy::Model;

void MeasuredScene::open(discrepancy::Experiment experiment) {
  close();
  take(std::move(experiment));
  shapes_ = shapes_of(*experiment_);
  const auto& robot = experiment_->scene.robot;
  robot_.emplace(experiment_->robot, robot ? robot->base : Pose{});
  const int trials = static_cast<int>(experiment_->trials.size());
  for (int t = 0; t < trials; ++t) arms_.push_back(measured_arm(*experiment_, t));
  run({discrepancy::nominal}, {{}});
}

void MeasuredScene::close() {
  drop();
  shapes_.clear();
  arms_.clear();
  robot_.reset();
}

void MeasuredScene::arm_at(int trial, double time, std::vector<Pose>& out) const {
  out.clear();
  if (trial < 0 || trial >= static_cast<int>(arms_.size())) return;
  const discrepancy::JointPath& arm = arms_[static_cast<std::size_t>(trial)];
  if (arm.dofs() == robot_->dofs()) robot_->link_poses(arm.at(time).q, out);
}

void MeasuredScene::run(const std::vector<Model>& models,
                        const std::vector<discrepancy::SceneVariant>& variants) {
  simulate(models,
           [experiment = experiment_, variants](const std::atomic<bool>& stop, const auto& done) {
             simulate_scene_paths(*experiment, variants, stop, done);
           });
}

void MeasuredScene::start_diagnosis(int threads) {
  begin_diagnosis([experiment = experiment_, threads = threads_for_diagnosis(threads)](
                      ProgressBoard& board, const std::atomic<bool>& stop) {
    discrepancy::SceneDiagnosisOptions options;
    options.threads = threads;
    options.stop = &stop;
    options.progress = [&](const std::string& doing, double share) { board.tell(doing, share); };
    discrepancy::SceneDiagnosis found = discrepancy::diagnose_scene(*experiment, options);
    return stop ? std::nullopt : std::optional(std::move(found));
  });
}

// Whether the scene itself has the sensors that measured.
bool MeasuredScene::has_sensors() const {
  return std::ranges::all_of(experiment_->wrenches, [&](const discrepancy::WrenchSensor& sensor) {
    return std::ranges::any_of(
        of_kind(experiment_->scene, world::instrument_kind("wrench")),
        [&](const world::SceneInstrument& own) { return own.name == sensor.name; });
  });
}

std::vector<plant::Effect> MeasuredScene::found_effects() const {
  std::vector<plant::Effect> found;
  if (!diagnosis_ || !diagnosis_->findings.explained()) return found;
  for (const plant::Effect& effect : diagnosis_->model) {
    const discrepancy::SceneEffectDefinition* known = discrepancy::find_scene_effect(effect.name);
    const effects::EffectDefinition* of_plant = effects::find_effect(effect.name);
    bool runs = of_plant && of_plant->file == effects::EffectFile::plant;
    if (known)
      runs = known->home != discrepancy::SceneHome::camera &&
             (known->home != discrepancy::SceneHome::wrench || has_sensors());
    if (runs) found.push_back(effect);
  }
  return found;
}

void MeasuredScene::adopt_diagnosis() {
  if (diagnosis_->extended.empty()) return;
  run({discrepancy::refitted, discrepancy::extended},
      {{diagnosis_->findings.baseline.hypothesis.effects}, {diagnosis_->model}});
}

}  // namespace pedicel::app
