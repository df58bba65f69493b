#include <cmath>

#include "engine/io/atomic_file.h"
#include "engine/io/csv.h"
#include "engine/io/text_file.h"
#include "plugins/discrepancy/data/experiment.h"
#include "plugins/discrepancy/data/experiment_tables.h"
#include "plugins/plant/leaf_template.h"

namespace pedicel::discrepancy {

namespace {

using io::exact_number;
using plant::yaml_word;

std::string vector(const Vec3& v) {
  return "[" + exact_number(v.x()) + ", " + exact_number(v.y()) + ", " + exact_number(v.z()) + "]";
}

std::string place(const plant::CurvePlace& place) {
  return "curve: " + yaml_word(place.curve) + ", at: " + exact_number(place.at);
}

std::string effects(const std::vector<plant::Effect>& list, const std::string& indent) {
  if (list.empty()) return {};
  std::string text = indent + "effects:\n";
  for (const plant::Effect& effect : list)
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
    text += ", axis: " + vector(hold.axes.front());
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

std::string drives(const Trial& trial) {
  std::string text;
  for (std::size_t i = 0; i < trial.holds.size(); ++i) {
    const Hold& hold = trial.holds[i];
    text += "      - {kind: hold, " + place(hold.place) + ", path: " + hold_file(i);
    if (hold.stiffness) text += ", stiffness: " + exact_number(*hold.stiffness);
    if (std::isfinite(hold.release)) text += ", release: " + exact_number(hold.release);
    text += leads(hold) + "}\n";
  }
  for (const TimedLoad& load : trial.loads) {
    text += "      - {kind: load, " + place(load.place) + ", force: " + vector(load.force);
    if (std::isfinite(load.from)) text += ", from: " + exact_number(load.from);
    if (std::isfinite(load.to)) text += ", to: " + exact_number(load.to);
    text += "}\n";
  }
  text += base(trial);
  if (text.empty()) text = "      - {kind: none}\n";
  return "    drive:\n" + text;
}

std::string trial_text(const Trial& trial) {
  std::string text = "  - name: " + yaml_word(trial.name) + "\n";
  text += "    folder: " + yaml_word(trial.name) + "\n";
  if (trial.use != Trial::Use::unset)
    text += std::string("    use: ") + (trial.use == Trial::Use::fit ? "fit" : "check") + "\n";
  if (trial.clock != 0.0) text += "    clock: " + exact_number(trial.clock) + "\n";
  if (trial.window) text += "    begins: moving\n    window: " + exact_number(*trial.window) + "\n";
  if (trial.is_static) text += "    static: true\n";
  text += "    gravity: " + vector(trial.gravity) + "\n";
  if (!trial.masses.empty()) text += "    masses:\n";
  for (const plant::PlantMass& mass : trial.masses)
    text += "      - {" + place(mass.place) + ", mass: " + exact_number(mass.mass) + "}\n";
  return text + effects(trial.effects, "    ") + drives(trial);
}

std::string experiment_text(const Experiment& experiment) {
  std::string text = "format: pedicel-experiment\nversion: 1\n";
  if (!experiment.title.empty()) text += "title: " + yaml_word(experiment.title) + "\n";
  text += "plant: plant.yaml\nmarkers:\n";
  for (const Marker& marker : experiment.markers)
    text += "  - {name: " + yaml_word(marker.name) + ", " + place(marker.place) + "}\n";
  const StatedNoise& noise = experiment.noise;
  std::string stated;
  const auto state = [&](const char* key, const std::optional<double>& std) {
    if (std) stated += std::string("  ") + key + ": " + exact_number(*std) + "\n";
  };
  state("position_std", noise.position_std);
  state("force_std", noise.force_std);
  state("moment_std", noise.moment_std);
  state("path_std", noise.path_std);
  if (!stated.empty()) text += "noise:\n" + stated;
  text += effects(experiment.effects, "") + "trials:\n";
  for (const Trial& trial : experiment.trials) text += trial_text(trial);
  return text;
}

void write_tables(const std::filesystem::path& folder, const Trial& trial,
                  const std::vector<Marker>& markers) {
  const auto write = [&](const std::string& file, const std::string& text) {
    io::write_file_atomically(folder / file, text);
  };
  const Rows rows = trial.is_static ? Rows::rest : Rows::time;
  write("markers.csv", points_text(marker_columns(markers), trial.markers, rows));
  for (std::size_t i = 0; i < trial.holds.size(); ++i)
    write(hold_file(i), path_text(trial.holds[i].path, rows));
  if (trial.base) write("base.csv", path_text(*trial.base, rows));
  if (trial.force.size() > 0)
    write("force.csv", points_text({"fx", "fy", "fz"}, trial.force, rows));
  if (trial.wrench.size() > 0)
    write("base_wrench.csv", points_text(wrench_columns(), trial.wrench, rows));
  if (!trial.events.empty()) write("events.csv", events_text(trial.events));
}

// Beside the plant, so that the folder can be carried elsewhere.
void copy_leaf_templates(const std::filesystem::path& folder, const plant::PlantFile& plant) {
  for (const plant::PlantLeaf& leaf : plant.leaves)
    if (const auto file = plant::find_leaf_template(leaf.leaf_template, plant.leaf_folders))
      if (const auto copy = folder / file->filename(); !std::filesystem::exists(copy))
        io::write_file_atomically(copy, io::read_text_file(*file));
}

}  // namespace

void write_experiment(const std::filesystem::path& folder, const Experiment& experiment) {
  for (const Trial& trial : experiment.trials)
    write_tables(folder / trial.name, trial, experiment.markers);
  plant::write_plant_file(folder / "plant.yaml", experiment.plant);
  copy_leaf_templates(folder, experiment.plant);
  // Last, so that a folder with an experiment.yaml is whole.
  io::write_file_atomically(folder / "experiment.yaml", experiment_text(experiment));
}

}  // namespace pedicel::discrepancy
