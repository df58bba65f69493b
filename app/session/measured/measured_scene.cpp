#include "pedicel/app/session/measured/measured_scene.h"

#include <algorithm>
#include <thread>

#include "pedicel/core/check.h"
#include "pedicel/discrepancy/scene/scene_effects.h"
#include "pedicel/effects/registry/effect_definition.h"

namespace pedicel::app {

using discrepancy::Model;

MeasuredScene::MeasuredScene() = default;
MeasuredScene::~MeasuredScene() = default;

void MeasuredScene::open(discrepancy::SceneExperiment experiment) {
  close();
  experiment_ = std::make_shared<const discrepancy::SceneExperiment>(std::move(experiment));
  shapes_ = shapes_of(*experiment_);
  const auto& robot = experiment_->scene.robot;
  robot_.emplace(experiment_->robot, robot ? robot->base : Pose{});
  const int trials = static_cast<int>(experiment_->trials.size());
  for (int t = 0; t < trials; ++t) arms_.push_back(measured_arm(*experiment_, t));
  for (auto& paths : paths_) paths.resize(experiment_->trials.size());
  simulate({discrepancy::nominal}, {{}});
}

void MeasuredScene::close() {
  retire();
  experiment_.reset();
  diagnosis_.reset();
  shapes_.clear();
  arms_.clear();
  robot_.reset();
  for (auto& paths : paths_) paths.clear();
  ++number_;
}

// What runs for another experiment is asked to stop, and waited for by nobody.
void MeasuredScene::retire() {
  runs_.stop();
  if (!diagnosing_) return;
  diagnosing_->cancel();
  retired_.push_back(std::move(diagnosing_));
}

void MeasuredScene::arm_at(int trial, double time, std::vector<Pose>& out) const {
  out.clear();
  if (trial < 0 || trial >= static_cast<int>(arms_.size())) return;
  const discrepancy::JointPath& arm = arms_[static_cast<std::size_t>(trial)];
  if (arm.dofs() == robot_->dofs()) robot_->link_poses(arm.at(time).q, out);
}

void MeasuredScene::simulate(const std::vector<Model>& models,
                             const std::vector<discrepancy::SceneVariant>& variants) {
  runs_.start(number_, static_cast<int>(models.size() * experiment_->trials.size()),
              [experiment = experiment_, models, variants](const std::atomic<bool>& stop,
                                                           const PathRuns<ScenePath>::Done& done) {
                simulate_scene_paths(
                    *experiment, variants, stop, [&](int trial, int variant, ScenePath path) {
                      done({models[static_cast<std::size_t>(variant)], trial, std::move(path)});
                    });
              });
}

const ScenePath* MeasuredScene::path(Model model, int trial) const {
  const auto& paths = paths_[static_cast<std::size_t>(model)];
  if (trial < 0 || trial >= static_cast<int>(paths.size())) return nullptr;
  const auto& one = paths[static_cast<std::size_t>(trial)];
  return one ? &*one : nullptr;
}

bool MeasuredScene::has(Model model) const {
  return std::ranges::any_of(paths_[static_cast<std::size_t>(model)],
                             [](const auto& one) { return one.has_value(); });
}

void MeasuredScene::start_diagnosis(int threads) {
  if (!experiment_) throw UsageError("no experiment is open, expected one (open experiment PATH)");
  if (diagnosing_) throw UsageError("a diagnosis runs already, expected it to end or be cancelled");
  diagnosing_ = std::make_unique<Job>([experiment = experiment_,
                                       threads = threads_for_diagnosis(threads)](
                                          ProgressBoard& board, const std::atomic<bool>& stop) {
    discrepancy::SceneDiagnosisOptions options;
    options.threads = threads;
    options.stop = &stop;
    options.progress = [&](const std::string& doing, double share) { board.tell(doing, share); };
    discrepancy::SceneDiagnosis found = discrepancy::diagnose_scene(*experiment, options);
    return stop ? std::nullopt : std::optional(std::move(found));
  });
}

void MeasuredScene::cancel_diagnosis() {
  if (diagnosing_) diagnosing_->cancel();
}

DiagnosisProgress MeasuredScene::progress() const {
  return diagnosing_ ? diagnosing_->progress() : DiagnosisProgress{};
}

// Whether the scene itself has the sensors that measured.
bool MeasuredScene::has_sensors() const {
  return std::ranges::all_of(experiment_->wrenches, [&](const discrepancy::WrenchSensor& sensor) {
    return std::ranges::any_of(experiment_->scene.wrenches, [&](const world::SceneWrench& own) {
      return own.name == sensor.name;
    });
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

std::vector<std::string> MeasuredScene::update() {
  std::vector<std::string> faults;
  std::erase_if(retired_, [](const auto& job) { return job->has_ended(); });
  take_diagnosis(faults);
  for (PathRuns<ScenePath>::Made& made : runs_.take(number_, faults))
    paths_[static_cast<std::size_t>(made.model)][static_cast<std::size_t>(made.trial)] =
        std::move(made.path);
  return faults;
}

void MeasuredScene::take_diagnosis(std::vector<std::string>& faults) {
  if (!diagnosing_ || !diagnosing_->has_ended()) return;
  if (!diagnosing_->fault().empty()) faults.push_back(diagnosing_->fault());
  const auto found = diagnosing_->result();
  diagnosing_.reset();
  if (!found) return;
  diagnosis_ = found;
  if (found->extended.empty()) return;
  simulate({discrepancy::refitted, discrepancy::extended},
           {{found->findings.baseline.model.effects}, {found->model}});
}

std::vector<std::string> MeasuredScene::wait() {
  std::vector<std::string> faults;
  do {
    for (std::string& fault : update()) faults.push_back(std::move(fault));
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  } while (diagnosing_ || !runs_.none() || !retired_.empty());
  return faults;
}

}  // namespace pedicel::app
