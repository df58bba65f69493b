#include "plugins/discrepancy/log_import/log_experiment.h"

#include <algorithm>

#include "engine/io/atomic_file.h"
#include "engine/io/csv.h"
#include "plugins/discrepancy/data/experiment_tables.h"
#include "plugins/discrepancy/files/experiment_files.h"

namespace pedicel::discrepancy {

namespace {

namespace fs = std::filesystem;
using plant::yaml_word;

void write_tables(const fs::path& folder, const LogMap& map, const LogTrial& trial) {
  const auto write = [&](const std::string& file, const std::vector<std::string>& names,
                         const Samples& samples) {
    if (samples.size() > 0) io::write_file_atomically(folder / file, table_text(names, samples));
  };
  write("joints.csv", trial.joint_names, trial.joints);
  write("commands.csv", trial.command_names, trial.commands);
  write("torques.csv", trial.torque_names, trial.torques);
  std::vector<Marker> markers;
  for (const LogMap::Marker& marker : map.markers) markers.push_back({marker.name, {}});
  write("markers.csv", marker_columns(markers), trial.markers);
  for (std::size_t w = 0; w < trial.wrenches.size(); ++w)
    write("wrench_" + map.wrenches[w].name + ".csv", wrench_columns(), trial.wrenches[w]);
  if (!trial.events.empty())
    io::write_file_atomically(folder / "events.csv", events_text(trial.events));
}

std::string experiment_text(const LogMap& map, const fs::path& scene,
                            const std::vector<LogTrial>& trials) {
  std::string text = "format: pedicel-experiment\nversion: 1\n";
  if (std::ranges::all_of(trials, &LogTrial::is_run)) text += "source: run\n";
  if (!map.title.empty()) text += "title: " + yaml_word(map.title) + "\n";
  text += "scene: " + yaml_word(scene.string()) + "\n";
  if (!map.markers.empty()) text += "markers:\n";
  for (const LogMap::Marker& marker : map.markers)
    text += "  - {name: " + yaml_word(marker.name) + ", " + marker.text + "}\n";
  if (!map.wrenches.empty()) text += "wrenches:\n";
  for (const LogMap::Wrench& wrench : map.wrenches)
    text += "  - {name: " + yaml_word(wrench.name) + ", link: " + yaml_word(wrench.link) +
            ", tared: " + (wrench.tared ? "true" : "false") + "}\n";
  if (!map.noise.empty()) text += "noise: " + map.noise + "\n";
  text += "trials:\n";
  for (const LogTrial& trial : trials) {
    text += "  - name: " + yaml_word(trial.name) + "\n    folder: " + yaml_word(trial.name) + "\n";
    if (!trial.use.empty()) text += "    use: " + trial.use + "\n";
    if (trial.clock != 0.0) text += "    clock: " + io::exact_number(trial.clock) + "\n";
    text += std::string("    robot: {follows: ") + (map.follows_commands ? "commands" : "joints") +
            "}\n" + trial.text;
  }
  return text;
}

}  // namespace

void write_log_experiment(const fs::path& folder, const LogMap& map, const LogScene& scene,
                          const std::vector<LogTrial>& trials) {
  const fs::path own = fs::path("model") / copy_scene(scene, folder / "model");
  for (const LogTrial& trial : trials) write_tables(folder / trial.name, map, trial);
  io::write_file_atomically(folder / "map.yaml", map.text);
  // Last, so that a folder with an experiment.yaml is whole.
  io::write_file_atomically(folder / "experiment.yaml", experiment_text(map, own, trials));
}

}  // namespace pedicel::discrepancy
