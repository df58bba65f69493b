#include <algorithm>
#include <cmath>

#include "engine/core/check.h"
#include "engine/io/atomic_file.h"
#include "engine/io/common_folder.h"
#include "engine/io/csv.h"
#include "engine/io/text_file.h"
#include "plugins/discrepancy/data/experiment_tables.h"
#include "plugins/discrepancy/files/experiment_files.h"
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

std::string place_text(const Experiment& experiment, int plant, const plant::CurvePlace& place) {
  std::string text = "curve: " + yaml_word(place.curve) + ", at: " + exact_number(place.at);
  if (!experiment.has_robot()) return text;
  return "plant: " + yaml_word(experiment.plants[static_cast<std::size_t>(plant)].name) + ", " +
         text;
}

std::string marker_text(const Experiment& experiment, const Marker& marker) {
  std::string text = "  - {name: " + yaml_word(marker.name) + ", ";
  if (marker.plant < 0)
    return text + "link: " +
           yaml_word(experiment.robot.links[static_cast<std::size_t>(marker.link)].name) +
           ", offset: " + list_text(marker.offset_L) + "}\n";
  if (marker.fruit < 0) return text + place_text(experiment, marker.plant, marker.place) + "}\n";
  const ExperimentPlant& plant = experiment.plants[static_cast<std::size_t>(marker.plant)];
  return text + "plant: " + yaml_word(plant.name) +
         ", fruit: " + yaml_word(plant.file.fruits[static_cast<std::size_t>(marker.fruit)].name) +
         "}\n";
}

std::string instruments_text(const Experiment& experiment) {
  std::string text = experiment.markers.empty() ? "" : "markers:\n";
  for (const Marker& marker : experiment.markers) text += marker_text(experiment, marker);
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

std::string noise_text(const StatedNoise& noise) {
  const std::pair<const char*, const std::optional<double>&> all[] = {
      {"position_std", noise.position_std}, {"pixel_std", noise.pixel_std},
      {"force_std", noise.force_std},       {"moment_std", noise.moment_std},
      {"joint_std", noise.joint_std},       {"torque_std", noise.torque_std},
      {"path_std", noise.path_std}};
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

// hold.csv, hold2.csv, ...
std::string hold_file(std::size_t index) {
  return "hold" + (index == 0 ? std::string() : std::to_string(index + 1)) + ".csv";
}

// Along which axes a hold leads, and what of an orientation.
std::string leads(const Hold& hold) {
  std::string text, world;
  for (const Vec3& axis : hold.axes)
    for (int i = 0; i < 3; ++i)
      if (axis == Vec3(Vec3::Unit(i)))
        world += (world.empty() ? "" : ", ") + std::string(1, "xyz"[i]);
  if (!world.empty())
    text += ", axes: [" + world + "]";
  else if (hold.slides())
    text += ", axis: " + list_text(hold.axes.front());
  if (hold.one_sided) text += ", one_sided: true";
  if (hold.direction) text += ", direction: true";
  return text;
}

std::string base(const Trial& trial) {
  if (!trial.base && trial.wrench.size() == 0) return {};
  std::string text = "      - {kind: base";
  if (trial.base) text += ", path: base.csv";
  if (trial.wrench.size() > 0) text += ", wrench: base_wrench.csv";
  return text + "}\n";
}

std::string drives(const Experiment& experiment, const Trial& trial) {
  std::string text;
  for (std::size_t i = 0; i < trial.holds.size(); ++i) {
    const Hold& hold = trial.holds[i];
    text +=
        "      - {kind: hold, " + place_text(experiment, 0, hold.place) + ", path: " + hold_file(i);
    if (hold.stiffness) text += ", stiffness: " + exact_number(*hold.stiffness);
    if (std::isfinite(hold.release)) text += ", release: " + exact_number(hold.release);
    text += leads(hold) + "}\n";
  }
  for (const TimedLoad& load : trial.loads) {
    text += "      - {kind: load, " + place_text(experiment, 0, load.place) +
            ", force: " + list_text(load.force);
    if (std::isfinite(load.from)) text += ", from: " + exact_number(load.from);
    if (std::isfinite(load.to)) text += ", to: " + exact_number(load.to);
    text += "}\n";
  }
  text += base(trial);
  if (text.empty()) text = "      - {kind: none}\n";
  return "    drive:\n" + text;
}

// How a single plant began, and what was done to it.
std::string plant_trial_text(const Experiment& experiment, const Trial& trial) {
  std::string text;
  if (trial.window) text += "    begins: moving\n    window: " + exact_number(*trial.window) + "\n";
  if (trial.is_static) text += "    static: true\n";
  return text + "    gravity: " + list_text(trial.gravity) + "\n" + drives(experiment, trial);
}

// What led the robot, and which plants stood elsewhere.
std::string scene_trial_text(const Experiment& experiment, const Trial& trial) {
  std::string text = std::string("    robot: {follows: ") +
                     (trial.follows_commands ? "commands" : "joints") + "}\n";
  if (!trial.poses.empty()) text += "    plants:\n";
  for (const auto& [plant, pose] : trial.poses)
    text += "      " + yaml_word(experiment.plants[static_cast<std::size_t>(plant)].name) +
            ": {position: " + list_text(pose.position) +
            ", orientation: " + list_text(pose.rotation.coeffs()) + "}\n";
  return text;
}

std::string trial_text(const Experiment& experiment, const Trial& trial) {
  std::string text = "  - name: " + yaml_word(trial.name) + "\n";
  text += "    folder: " + yaml_word(trial.name) + "\n";
  if (trial.use != Trial::Use::unset)
    text += std::string("    use: ") + (trial.use == Trial::Use::fit ? "fit" : "check") + "\n";
  if (trial.clock != 0.0) text += "    clock: " + exact_number(trial.clock) + "\n";
  if (!trial.masses.empty()) text += "    masses:\n";
  for (const Trial::Mass& mass : trial.masses)
    text += "      - {" + place_text(experiment, mass.plant, mass.place) +
            ", mass: " + exact_number(mass.mass) + "}\n";
  text += experiment.has_robot() ? scene_trial_text(experiment, trial)
                                 : plant_trial_text(experiment, trial);
  return text + effects_text(trial.effects, "    ");
}

/// `model`: what stands under `plant` or `scene`.
std::string experiment_text(const Experiment& experiment, const fs::path& model) {
  std::string text = "format: pedicel-experiment\nversion: 1\n";
  if (experiment.is_run) text += "source: run\n";
  if (!experiment.title.empty()) text += "title: " + yaml_word(experiment.title) + "\n";
  text += (experiment.has_robot() ? "scene: " : "plant: ") + yaml_word(model.string()) + "\n";
  text += instruments_text(experiment) + noise_text(experiment.noise) +
          effects_text(experiment.effects, "") + "trials:\n";
  for (const Trial& trial : experiment.trials) text += trial_text(experiment, trial);
  return text;
}

std::vector<std::string> columns_of(const Experiment& experiment, const std::vector<int>& columns) {
  const std::vector<std::string> all = joint_names(experiment.robot);
  std::vector<std::string> names;
  names.reserve(columns.size());
  for (const int column : columns) names.push_back(all[static_cast<std::size_t>(column)]);
  return names;
}

/// All files that a scene names, its own first; each once, absolute.
std::vector<fs::path> files_of(const Experiment& experiment) {
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
  for (const ExperimentPlant& plant : experiment.plants) {
    add(plant.path);
    // What is shipped with the program is found without being carried along.
    for (const plant::PlantLeaf& leaf : plant.file.leaves)
      if (const auto file = plant::find_leaf_template(leaf.leaf_template,
                                                      {fs::absolute(plant.path).parent_path()}))
        add(*file);
  }
  return files;
}

// The scene with all that it names; where it lies in the folder.
fs::path write_scene(const fs::path& folder, const Experiment& experiment) {
  const std::vector<fs::path> files = files_of(experiment);
  const fs::path home = files.front().parent_path(), common = io::common_folder(files);
  // A scene that lies beside or above what it names keeps its place in the folder. Around any other
  // one the folders are made as they are where it comes from.
  fs::path scene = common == home ? experiment.scene_path
                                  : fs::path("model") / files.front().lexically_relative(common);
  if (scene.is_absolute() || *scene.lexically_normal().begin() == "..")
    throw UsageError("the scene " + scene.string() +
                     " is outside of its experiment, expected it in the folder");
  for (const fs::path& file : files)
    io::write_file_atomically(folder / scene.parent_path() / file.lexically_relative(home),
                              io::read_text_file(file));
  return scene;
}

// Beside the plant, so that the folder can be carried elsewhere.
void copy_leaf_templates(const std::filesystem::path& folder, const plant::PlantFile& plant) {
  for (const plant::PlantLeaf& leaf : plant.leaves)
    if (const auto file = plant::find_leaf_template(leaf.leaf_template, plant.leaf_folders))
      if (const auto copy = folder / file->filename(); !std::filesystem::exists(copy))
        io::write_file_atomically(copy, io::read_text_file(*file));
}

fs::path write_plant(const fs::path& folder, const plant::PlantFile& plant) {
  plant::write_plant_file(folder / "plant.yaml", plant);
  copy_leaf_templates(folder, plant);
  return "plant.yaml";
}

}  // namespace

void write_tables(const fs::path& folder, const Experiment& experiment, const Trial& trial) {
  const Rows rows = trial.is_static ? Rows::rest : Rows::time;
  const auto write = [&](const std::string& file, const std::string& text) {
    io::write_file_atomically(folder / file, text);
  };
  const auto write_table = [&](const std::string& file, const std::vector<std::string>& names,
                               const Samples& samples) {
    if (samples.size() > 0) write(file, table_text(names, samples));
  };
  const auto write_points = [&](const std::string& file, const std::vector<std::string>& names,
                                const Samples& samples) {
    if (samples.size() > 0) write(file, points_text(names, samples, rows));
  };
  if (experiment.has_robot())
    write_table("markers.csv", marker_columns(experiment.markers), trial.markers);
  else  // needed, also without a row
    write("markers.csv", points_text(marker_columns(experiment.markers), trial.markers, rows));
  for (std::size_t i = 0; i < trial.holds.size(); ++i)
    write(hold_file(i), path_text(trial.holds[i].path, rows));
  if (trial.base) write("base.csv", path_text(*trial.base, rows));
  write_points("force.csv", {"fx", "fy", "fz"}, trial.force);
  write_points("base_wrench.csv", wrench_columns(), trial.wrench);
  if (experiment.has_robot()) {
    write_table("joints.csv", columns_of(experiment, trial.joint_columns), trial.joints);
    write_table("commands.csv", columns_of(experiment, trial.command_columns), trial.commands);
    write_table("torques.csv", columns_of(experiment, trial.torque_columns), trial.torques);
  }
  for (std::size_t c = 0; c < trial.pixels.size(); ++c)
    write_table("pixels_" + experiment.cameras[c].name + ".csv", pixel_columns(experiment.markers),
                trial.pixels[c]);
  for (std::size_t w = 0; w < trial.wrenches.size(); ++w)
    write_table("wrench_" + experiment.wrenches[w].name + ".csv", wrench_columns(),
                trial.wrenches[w]);
  if (!trial.events.empty()) write("events.csv", events_text(trial.events));
}

void write_experiment(const fs::path& folder, const Experiment& experiment) {
  const fs::path model = experiment.has_robot() ? write_scene(folder, experiment)
                                                : write_plant(folder, experiment.plant());
  for (const Trial& trial : experiment.trials) write_tables(folder / trial.name, experiment, trial);
  // Last, so that a folder with an experiment.yaml is whole.
  io::write_file_atomically(folder / "experiment.yaml", experiment_text(experiment, model));
}

}  // namespace pedicel::discrepancy
