#include "plugins/discrepancy/scene_files/scene_experiment_writer.h"

#include <algorithm>

#include "engine/core/check.h"
#include "engine/io/atomic_file.h"
#include "engine/io/common_folder.h"
#include "engine/io/csv.h"
#include "engine/io/text_file.h"
#include "plugins/discrepancy/scene_files/scene_tables.h"
#include "plugins/plant/leaf_template.h"

namespace pedicel::discrepancy {

namespace {

using io::exact_number;
using plant::yaml_word;
namespace fs = std::filesystem;

template <class Values>
std::string list_text(const Values& values) {
  std::string text;
  for (const auto& value : values)
    text += (text.empty() ? "" : ", ") + exact_number(static_cast<double>(value));
  return "[" + text + "]";
}

std::string place_text(const SceneExperiment& experiment, int plant,
                       const plant::CurvePlace& place) {
  return "plant: " + yaml_word(experiment.plants[static_cast<std::size_t>(plant)].name) +
         ", curve: " + yaml_word(place.curve) + ", at: " + exact_number(place.at);
}

std::string marker_text(const SceneExperiment& experiment, const SceneMarker& marker) {
  std::string text = "  - {name: " + yaml_word(marker.name) + ", ";
  if (marker.plant < 0)
    return text + "link: " +
           yaml_word(experiment.robot.links[static_cast<std::size_t>(marker.link)].name) +
           ", offset: " + list_text(marker.offset_L) + "}\n";
  const ScenePlantFile& plant = experiment.plants[static_cast<std::size_t>(marker.plant)];
  if (marker.fruit < 0) return text + place_text(experiment, marker.plant, marker.place) + "}\n";
  return text + "plant: " + yaml_word(plant.name) +
         ", fruit: " + yaml_word(plant.file.fruits[static_cast<std::size_t>(marker.fruit)].name) +
         "}\n";
}

std::string instruments_text(const SceneExperiment& experiment) {
  std::string text = experiment.markers.empty() ? "" : "markers:\n";
  for (const SceneMarker& marker : experiment.markers) text += marker_text(experiment, marker);
  if (!experiment.cameras.empty()) text += "cameras:\n";
  for (const Camera& camera : experiment.cameras)
    text += "  - {name: " + yaml_word(camera.name) +
            ", position: " + list_text(camera.X_WC.position) +
            ", orientation: " + list_text(camera.X_WC.rotation.coeffs()) +
            ", focal: " + list_text(camera.focal) + ", centre: " + list_text(camera.centre) +
            ", size: " + list_text(camera.size) + ", distortion: " + list_text(camera.distortion) +
            "}\n";
  if (!experiment.wrenches.empty()) text += "wrenches:\n";
  for (const WrenchSensor& sensor : experiment.wrenches)
    text += "  - {name: " + yaml_word(sensor.name) + ", link: " +
            yaml_word(experiment.robot.links[static_cast<std::size_t>(sensor.link)].name) +
            ", tared: " + (sensor.tared ? "true" : "false") + "}\n";
  return text;
}

std::string noise_text(const SceneNoise& noise) {
  const std::pair<const char*, const std::optional<double>&> all[] = {
      {"position_std", noise.position_std}, {"pixel_std", noise.pixel_std},
      {"force_std", noise.force_std},       {"moment_std", noise.moment_std},
      {"joint_std", noise.joint_std},       {"torque_std", noise.torque_std}};
  std::string text;
  for (const auto& [key, value] : all)
    if (value) text += (text.empty() ? "" : ", ") + std::string(key) + ": " + exact_number(*value);
  return text.empty() ? text : "noise: {" + text + "}\n";
}

std::string effects_text(const std::vector<plant::Effect>& effects, const std::string& indent) {
  std::string text = effects.empty() ? "" : indent + "effects:\n";
  for (const plant::Effect& effect : effects)
    text += indent + "  - " + plant::effect_text(effect) + "\n";
  return text;
}

std::string trial_text(const SceneExperiment& experiment, const SceneTrial& trial) {
  std::string text = "  - name: " + yaml_word(trial.name) + "\n";
  text += "    folder: " + yaml_word(trial.name) + "\n";
  if (trial.use != Trial::Use::unset)
    text += std::string("    use: ") + (trial.use == Trial::Use::fit ? "fit" : "check") + "\n";
  if (trial.clock != 0.0) text += "    clock: " + exact_number(trial.clock) + "\n";
  if (!trial.masses.empty()) text += "    masses:\n";
  for (const SceneTrial::Mass& mass : trial.masses)
    text += "      - {" + place_text(experiment, mass.plant, mass.mass.place) +
            ", mass: " + exact_number(mass.mass.mass) + "}\n";
  text += std::string("    robot: {follows: ") + (trial.follows_commands ? "commands" : "joints") +
          "}\n";
  if (!trial.poses.empty()) text += "    plants:\n";
  for (const auto& [plant, pose] : trial.poses)
    text += "      " + yaml_word(experiment.plants[static_cast<std::size_t>(plant)].name) +
            ": {position: " + list_text(pose.position) +
            ", orientation: " + list_text(pose.rotation.coeffs()) + "}\n";
  return text + effects_text(trial.effects, "    ");
}

std::string experiment_text(const SceneExperiment& experiment, const fs::path& scene) {
  std::string text = "format: pedicel-experiment\nversion: 1\n";
  if (experiment.is_run) text += "source: run\n";
  if (!experiment.title.empty()) text += "title: " + yaml_word(experiment.title) + "\n";
  text += "scene: " + yaml_word(scene.string()) + "\n";
  text += instruments_text(experiment) + noise_text(experiment.noise) +
          effects_text(experiment.effects, "") + "trials:\n";
  for (const SceneTrial& trial : experiment.trials) text += trial_text(experiment, trial);
  return text;
}

std::vector<std::string> columns_of(const SceneExperiment& experiment,
                                    const std::vector<int>& columns) {
  const std::vector<std::string> all = joint_names(experiment.robot);
  std::vector<std::string> names;
  for (const int column : columns) names.push_back(all[static_cast<std::size_t>(column)]);
  return names;
}

/// All files that a scene names, its own first; each once, absolute.
std::vector<fs::path> files_of(const SceneExperiment& experiment) {
  std::vector<fs::path> files;
  const auto add = [&](const fs::path& file) {
    if (file.empty()) return;
    const fs::path plain = fs::weakly_canonical(file);
    if (std::ranges::find(files, plain) == files.end()) files.push_back(plain);
  };
  add(experiment.scene.file);
  add(experiment.scene.robot->file);
  add(experiment.scene.robot->trajectory);
  for (const robot::Link& link : experiment.robot.links) {
    for (const robot::Collision& shape : link.collisions) add(shape.geometry.mesh_file);
    for (const robot::Visual& shape : link.visuals) add(shape.geometry.mesh_file);
  }
  for (const ScenePlantFile& plant : experiment.plants) {
    add(plant.path);
    // What is shipped with the program is found without being carried along.
    for (const plant::PlantLeaf& leaf : plant.file.leaves)
      if (const auto file = plant::find_leaf_template(leaf.leaf_template,
                                                      {fs::absolute(plant.path).parent_path()}))
        add(*file);
  }
  return files;
}

}  // namespace

void write_scene_tables(const fs::path& folder, const SceneExperiment& experiment,
                        const SceneTrial& trial) {
  const auto write = [&](const std::string& file, const std::vector<std::string>& names,
                         const Samples& samples) {
    if (samples.size() > 0) io::write_file_atomically(folder / file, table_text(names, samples));
  };
  write("joints.csv", columns_of(experiment, trial.joint_columns), trial.joints);
  write("commands.csv", columns_of(experiment, trial.command_columns), trial.commands);
  write("torques.csv", columns_of(experiment, trial.torque_columns), trial.torques);
  write("markers.csv", marker_columns(experiment.markers), trial.markers);
  for (std::size_t c = 0; c < trial.pixels.size(); ++c)
    write("pixels_" + experiment.cameras[c].name + ".csv", pixel_columns(experiment.markers),
          trial.pixels[c]);
  for (std::size_t w = 0; w < trial.wrenches.size(); ++w)
    write("wrench_" + experiment.wrenches[w].name + ".csv", wrench_columns(), trial.wrenches[w]);
  if (!trial.events.empty())
    io::write_file_atomically(folder / "events.csv", events_text(trial.events));
}

void write_scene_experiment(const fs::path& folder, const SceneExperiment& experiment) {
  const std::vector<fs::path> files = files_of(experiment);
  const fs::path home = files.front().parent_path(), common = io::common_folder(files);
  // A scene that lies beside or above what it names keeps its place in the folder. Around any other
  // one the folders are made as they are where it comes from.
  const fs::path scene = common == home
                             ? experiment.scene_path
                             : fs::path("model") / files.front().lexically_relative(common);
  if (scene.is_absolute() || *scene.lexically_normal().begin() == "..")
    throw UsageError("the scene " + scene.string() +
                     " is outside of its experiment, expected it in the folder");
  for (const fs::path& file : files)
    io::write_file_atomically(folder / scene.parent_path() / file.lexically_relative(home),
                              io::read_text_file(file));
  for (const SceneTrial& trial : experiment.trials)
    write_scene_tables(folder / trial.name, experiment, trial);
  // Last, so that a folder with an experiment.yaml is whole.
  io::write_file_atomically(folder / "experiment.yaml", experiment_text(experiment, scene));
}

}  // namespace pedicel::discrepancy
