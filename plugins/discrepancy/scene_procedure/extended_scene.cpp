#include "plugins/discrepancy/scene_procedure/extended_scene.h"

#include <algorithm>
#include <cmath>

#include "engine/io/atomic_file.h"
#include "engine/io/csv.h"
#include "engine/io/csv_cell.h"
#include "engine/io/text_file.h"
#include "engine/robot/kinematics.h"
#include "engine/world/scene_writer.h"
#include "plugins/discrepancy/scene/scene_effects.h"
#include "plugins/discrepancy/scene_predict/scene_simulator.h"
#include "plugins/discrepancy/simulate/variant_plant.h"
#include "plugins/effects/registry/effect_definition.h"
#include "plugins/plant/plant_file.h"

namespace pedicel::discrepancy {

namespace {

namespace fs = std::filesystem;

constexpr double log_rate = 250.0;  // Hz

class Writer {
 public:
  Writer(const fs::path& folder, const Experiment& experiment,
         const std::vector<plant::Effect>& effects)
      : folder_(folder), experiment_(experiment), effects_(effects), scene_(experiment.scene) {}

  ExtendedScene run(int trial) {
    for (const auto* list : {&experiment_.effects, &effects_})
      for (const plant::Effect& effect : *list) take(effect);
    for (std::size_t p = 0; p < experiment_.plants.size(); ++p) set_plant(p);
    if (!differs_) return out_;
    follow(trial);
    keep_robot();
    scene_.name += ", extended";
    scene_.purpose += " Extended by what a diagnosis found.";
    out_.file = "extended.scene.yaml";
    io::write_file_atomically(folder_ / out_.file, world::scene_text(scene_, folder_));
    return out_;
  }

 private:
  void take(const plant::Effect& effect) {
    const SceneEffectDefinition* known = find_scene_effect(effect.name);
    if (!known) {
      // Of a plant's model: in its file (set_plant()). What is left is about measured data.
      if (is_of_experiment(effect)) out_.left.push_back(effect.name);
      return;
    }
    if (known->home == SceneHome::camera) {
      out_.left.push_back(effect.name);
      return;
    }
    scene_.effects.push_back({plant::effect_text(effect), {}});
    differs_ = true;
    if (known->home == SceneHome::wrench) add_sensors();
  }

  // Sensors whose effects the scene has write what the experiment's measured.
  void add_sensors() {
    const world::InstrumentKind& kind = world::instrument_kind("wrench");
    for (const WrenchSensor& sensor : experiment_.wrenches) {
      const bool known = std::ranges::any_of(
          of_kind(scene_, kind),
          [&](const world::SceneInstrument& one) { return one.name == sensor.name; });
      if (known) continue;
      world::SceneInstrument own(kind);
      own.name = sensor.name;
      own.link = experiment_.robot.links[static_cast<std::size_t>(sensor.link)].name;
      own.tared = sensor.tared;
      scene_.instruments.push_back(own);
    }
  }

  void set_plant(std::size_t p) {
    const ExperimentPlant& own = experiment_.plants[p];
    plant::PlantFile file = own.file;
    bool changed = false;
    for (const auto* list : {&experiment_.effects, &effects_})
      for (plant::Effect effect : *list) {
        const effects::EffectDefinition* known = effects::find_effect(effect.name);
        if (!known || known->file != effects::EffectFile::plant) continue;
        const auto named = effect.words.find("plant");
        if (named != effect.words.end() && named->second != own.name) continue;
        effect.words.erase("plant");
        file.effects.push_back(effect);
        changed = true;
      }
    world::ScenePlant* in_scene = nullptr;
    for (world::ScenePlant& plant : scene_.plants)
      if (plant.name == own.name) in_scene = &plant;
    if (!in_scene || !changed) return;
    const fs::path name = experiment_.plants.size() > 1 ? "extended." + own.name + ".plant.yaml"
                                                        : "extended.plant.yaml";
    plant::write_plant_file(folder_ / name, file);
    in_scene->file = folder_ / name;
    differs_ = true;
  }

  // The trial's own log, smoothed: what is off about it is among the effects.
  void follow(int trial) {
    if (trial < 0) return;
    const Trial& own = experiment_.trials[static_cast<std::size_t>(trial)];
    const Samples& log = own.follows_commands ? own.commands : own.joints;
    if (log.size() == 0) return;
    const std::vector<std::string> names = joint_names(experiment_.robot);
    std::string text = "time_s";
    for (const std::string& name : names) text += "," + io::csv_cell(name);
    text += "\n";
    const auto add = [&](double t, const Eigen::VectorXd& q) {
      text += io::exact_number(t);
      for (long j = 0; j < q.size(); ++j) text += "," + io::exact_number(q[j]);
      text += "\n";
    };
    Eigen::VectorXd first = start_of_arm();
    if (own.follows_commands) {
      Eigen::VectorXd q = first;
      for (int r = 0; r < log.size(); ++r) {
        for (std::size_t c = 0; c < own.command_columns.size(); ++c)
          if (const double value = log.value(r, static_cast<long>(c)); std::isfinite(value))
            q[own.command_columns[c]] = value;
        if (r == 0) first = q;
        add(log.time[static_cast<std::size_t>(r)], q);
      }
    } else {
      const JointPath path = path_of(experiment_, own);
      first = path.at(0.0).q;
      for (double t = 0.0; t <= log.time.back() + 0.5 / log_rate; t += 1.0 / log_rate)
        add(t, path.at(t).q);
    }
    io::write_file_atomically(folder_ / "extended.joints.csv", text);
    scene_.robot->trajectory = folder_ / "extended.joints.csv";
    scene_.robot->waypoints.clear();
    for (std::size_t j = 0; j < names.size(); ++j)
      scene_.robot->joints[names[j]] = first[static_cast<long>(j)];
    scene_.duration = own.duration();
  }

  Eigen::VectorXd start_of_arm() const {
    const robot::KinematicModel model(experiment_.robot);
    Eigen::VectorXd start = model.neutral();
    for (const auto& [joint, value] : scene_.robot->joints)
      if (const int dof = model.joint_index(joint); dof >= 0) start[dof] = value;
    return start;
  }

  // A robot without meshes lies beside the scene; one with meshes stays where it is.
  void keep_robot() {
    for (const robot::Link& link : experiment_.robot.links) {
      for (const robot::Collision& shape : link.collisions)
        if (!shape.geometry.mesh_file.empty()) return;
      for (const robot::Visual& shape : link.visuals)
        if (!shape.geometry.mesh_file.empty()) return;
    }
    const fs::path name = scene_.robot->file.filename();
    io::write_file_atomically(folder_ / name, io::read_text_file(scene_.robot->file));
    scene_.robot->file = folder_ / name;
  }

  const fs::path& folder_;
  const Experiment& experiment_;
  const std::vector<plant::Effect>& effects_;
  world::Scene scene_;
  bool differs_ = false;
  ExtendedScene out_;
};

}  // namespace

ExtendedScene write_extended_scene(const fs::path& folder, const Experiment& experiment,
                                   const std::vector<plant::Effect>& effects, int trial) {
  if (!experiment.scene.robot) return {};
  return Writer(folder, experiment, effects).run(trial);
}

}  // namespace pedicel::discrepancy
