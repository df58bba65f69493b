#include "plugins/discrepancy/scene/run_effects.h"

#include "engine/robot/kinematics.h"
#include "plugins/discrepancy/scene/scene_effects.h"
#include "plugins/discrepancy/simulate/variant_plant.h"

namespace pedicel::discrepancy {

namespace {

/// The scene as an experiment without trials, as far as effects name things of it.
Experiment without_trials(const world::Scene& scene, const robot::RobotDescription* robot) {
  Experiment experiment;
  experiment.scene = scene;
  if (robot) experiment.robot = *robot;
  experiment.plants.clear();
  for (const world::ScenePlant& plant : scene.plants) {
    ExperimentPlant named;
    named.name = plant.name;
    experiment.plants.push_back(std::move(named));
  }
  for (const world::SceneInstrument& wrench : of_kind(scene, world::instrument_kind("wrench")))
    experiment.wrenches.push_back({wrench.name, -1, wrench.tared});
  for (const world::SceneCamera& camera : scene.cameras) {
    Camera named;
    named.name = camera.name;
    experiment.cameras.push_back(std::move(named));
  }
  return experiment;
}

SceneState plain_state(const Experiment& experiment) {
  SceneState state;
  state.plants.resize(experiment.plants.size());
  const long dofs =
      experiment.robot.links.empty() ? 0 : robot::KinematicModel(experiment.robot).dofs();
  state.joint_offset = state.coulomb = state.viscous = Eigen::VectorXd::Zero(dofs);
  state.gauges.resize(experiment.wrenches.size());
  state.cameras = experiment.cameras;
  return state;
}

std::vector<plant::Effect> read_all(const Experiment& experiment, Diagnostics& diagnostics) {
  std::vector<plant::Effect> effects;
  for (const io::YamlPiece& piece : experiment.scene.effects)
    effects.push_back(read_scene_effect(io::read_piece(piece, diagnostics), experiment));
  return effects;
}

}  // namespace

std::vector<plant::Effect> RunEffects::of_plant(const std::string& name) const {
  std::vector<plant::Effect> own;
  for (plant::Effect effect : of_plants) {
    const auto named = effect.words.find("plant");
    if (named != effect.words.end() && named->second != name) continue;
    effect.words.erase("plant");
    own.push_back(std::move(effect));
  }
  return own;
}

RunEffects read_run_effects(const world::Scene& scene, const robot::RobotDescription* robot,
                            const coupling::CouplingSettings& coupling, Diagnostics& diagnostics) {
  RunEffects out;
  const Experiment experiment = without_trials(scene, robot);
  out.state = plain_state(experiment);
  out.state.coupling = coupling;
  const int before = diagnostics.error_count();
  const std::vector<plant::Effect> all = read_all(experiment, diagnostics);
  out.any = !all.empty();
  if (diagnostics.error_count() > before) return out;
  for (const plant::Effect& effect : all) {
    const SceneEffectDefinition* known = find_scene_effect(effect.name);
    const SceneHome home = known ? known->home : SceneHome::unset;
    if (!robot && (home == SceneHome::arm || home == SceneHome::wrench)) {
      diagnostics.error(effect.where, "effect " + effect.name +
                                          ": the scene has no robot, expected one that it is of");
    } else if (effect.words.contains("trial")) {
      out.notes.push_back("effect " + effect.name + " is of trial " + effect.words.at("trial") +
                          " alone: it changes nothing of a run");
    } else if (home == SceneHome::camera) {
      out.notes.push_back("effect " + effect.name +
                          " is about measured images: it changes nothing of a run");
    } else if (apply_scene_effect(effect, experiment, out.state)) {
      continue;
    } else if (is_of_experiment(effect)) {
      out.notes.push_back("effect " + effect.name +
                          " is about measured data: it changes nothing of a run");
    } else {
      out.of_plants.push_back(effect);
    }
  }
  return out;
}

std::vector<plant::Effect> scene_file_effects(const Experiment& experiment,
                                              Diagnostics& diagnostics) {
  return read_all(experiment, diagnostics);
}

}  // namespace pedicel::discrepancy
