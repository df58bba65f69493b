#include "pedicel/discrepancy/scene_procedure/extended_scene.h"

#include <algorithm>
#include <cmath>

#include "pedicel/discrepancy/scene/scene_effects.h"
#include "pedicel/discrepancy/scene/scene_simulator.h"
#include "pedicel/effects/registry/effect_definition.h"
#include "pedicel/io/atomic_file.h"
#include "pedicel/io/csv.h"
#include "pedicel/io/text_file.h"
#include "pedicel/plant/plant_file.h"
#include "pedicel/world/scene_writer.h"

namespace pedicel::discrepancy {

namespace {

namespace fs = std::filesystem;

constexpr double log_rate = 250.0;  // Hz

void set(std::vector<world::Setting>& settings, const std::string& key, const std::string& text) {
  for (world::Setting& one : settings)
    if (one.key == key) {
      one.text = text;
      return;
    }
  settings.push_back({key, text, {}});
}

Pose moved(const Pose& pose, const Vec3& root, const SceneState::Plant& state) {
  const Quat turn(Eigen::AngleAxisd(state.yaw, Vec3::UnitZ()));
  const Vec3 root_W = pose * root;
  return {root_W + state.offset + turn * (pose.position - root_W),
          (turn * pose.rotation).normalized()};
}

void multiply(std::optional<double>& limit, double factor) {
  if (limit) *limit *= factor;
}

class Writer {
 public:
  Writer(const fs::path& folder, const SceneExperiment& experiment,
         const std::vector<plant::Effect>& effects)
      : folder_(folder),
        experiment_(experiment),
        effects_(effects),
        scene_(experiment.scene),
        nominal_(nominal_state(experiment)),
        state_(nominal_) {
    for (const plant::Effect& effect : effects_) apply_scene_effect(effect, experiment, state_);
  }

  ExtendedScene run(int trial) {
    set_contact();
    for (std::size_t p = 0; p < experiment_.plants.size(); ++p) set_plant(p);
    set_arm();
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
  void set_contact() {
    const auto number = [&](const std::string& key, double value, double before) {
      if (value == before) return;
      set(scene_.coupling, key, io::exact_number(value));
      differs_ = true;
    };
    number("friction", state_.coupling.friction, nominal_.coupling.friction);
    number("contact_stiffness", state_.coupling.contact_stiffness,
           nominal_.coupling.contact_stiffness);
    number("fruit_stiffness", state_.coupling.fruit_stiffness, nominal_.coupling.fruit_stiffness);
    if (state_.joint_stiffness > 0.0) {
      set(scene_.coupling, "direction", "two_way");
      differs_ = true;
    }
    if (!state_.friction_of_link.empty()) out_.left.push_back("contact_friction of one link");
  }

  void set_plant(std::size_t p) {
    const ScenePlantFile& own = experiment_.plants[p];
    const SceneState::Plant& state = state_.plants[p];
    plant::PlantFile file = own.file;
    bool changed = state.fruit_mass != 1.0 || state.threshold != 1.0;
    for (plant::PlantFruit& fruit : file.fruits) {
      fruit.density *= state.fruit_mass;
      for (std::optional<double>* limit :
           {&fruit.detach.stretch, &fruit.detach.bend, &fruit.detach.force, &fruit.detach.moment,
            &fruit.detach.torsion})
        multiply(*limit, state.threshold);
    }
    for (plant::Effect effect : effects_) {
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
    if (!in_scene) return;
    if (state.yaw != 0.0 || !state.offset.isZero(0.0)) {
      in_scene->pose = moved(in_scene->pose, file.root, state);
      differs_ = true;
    }
    if (!changed) return;
    const fs::path name = experiment_.plants.size() > 1 ? "extended." + own.name + ".plant.yaml"
                                                        : "extended.plant.yaml";
    plant::write_plant_file(folder_ / name, file);
    in_scene->file = folder_ / name;
    differs_ = true;
  }

  // Where the links are is the joints' business; what hangs on them is the URDF's.
  void set_arm() {
    if (!state_.tool_offset.isZero(0.0) || !state_.tool_rotation.isZero(0.0))
      out_.left.push_back("tool_pose");
    if (state_.payload > 0.0) out_.left.push_back("payload");
    if (!state_.coulomb.isZero(0.0) || !state_.viscous.isZero(0.0))
      out_.left.push_back("joint_friction");
    if (state_.tracking_lag > 0.0) out_.left.push_back("tracking_lag");
    differs_ = differs_ || !state_.joint_offset.isZero(0.0) || state_.robot_delay != 0.0;
  }

  // The trial's own readings, with the encoders' zeros and the log's delay put right.
  void follow(int trial) {
    if (trial < 0) return;
    const SceneTrial& own = experiment_.trials[static_cast<std::size_t>(trial)];
    if (own.joints.size() == 0) return;
    const JointPath path = path_of(experiment_, own);
    std::vector<std::string> names;
    for (const std::string& joint : joint_names(experiment_.robot)) names.push_back(joint);
    std::string text = "time_s";
    for (const std::string& name : names) text += "," + name;
    text += "\n";
    for (double t = 0.0; t <= own.joints.time.back() + 0.5 / log_rate; t += 1.0 / log_rate) {
      const Eigen::VectorXd q = path.at(t + state_.robot_delay).q + state_.joint_offset;
      text += io::exact_number(t);
      for (long j = 0; j < q.size(); ++j) text += "," + io::exact_number(q[j]);
      text += "\n";
    }
    io::write_file_atomically(folder_ / "extended.joints.csv", text);
    scene_.robot->trajectory = folder_ / "extended.joints.csv";
    const Eigen::VectorXd first = path.at(state_.robot_delay).q + state_.joint_offset;
    for (std::size_t j = 0; j < names.size(); ++j)
      if (scene_.robot->joints.contains(names[j]))
        scene_.robot->joints[names[j]] = first[static_cast<long>(j)];
    scene_.duration = own.duration();
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
  const SceneExperiment& experiment_;
  const std::vector<plant::Effect>& effects_;
  world::Scene scene_;
  SceneState nominal_, state_;
  bool differs_ = false;
  ExtendedScene out_;
};

}  // namespace

ExtendedScene write_extended_scene(const fs::path& folder, const SceneExperiment& experiment,
                                   const std::vector<plant::Effect>& effects, int trial) {
  if (!experiment.scene.robot) return {};
  return Writer(folder, experiment, effects).run(trial);
}

}  // namespace pedicel::discrepancy
