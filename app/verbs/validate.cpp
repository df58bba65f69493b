#include "app/verbs/validate.h"

#include <array>
#include <cctype>
#include <filesystem>
#include <functional>
#include <optional>

#include "app/session/document/document.h"
#include "app/verbs/scene_experiment.h"
#include "app/verbs/validate_tables.h"
#include "engine/core/joined.h"
#include "engine/geometry/mesh.h"
#include "engine/io/text_file.h"
#include "engine/io/yaml.h"
#include "engine/robot/read/read_robot.h"
#include "engine/world/scene_reader.h"
#include "engine/world/variation.h"
#include "plugins/discrepancy/admission/admission.h"
#include "plugins/discrepancy/data/experiment.h"
#include "plugins/discrepancy/files/experiment_files.h"
#include "plugins/discrepancy/log_import/log_map.h"
#include "plugins/plant/leaf_template.h"
#include "plugins/plant/plant_builder.h"
#include "plugins/simulation/large_plant.h"
#include "plugins/simulation/mesh_fields.h"
#include "plugins/simulation/simulation.h"
#include "plugins/skeleton/helios_reader.h"
#include "plugins/skeleton/plant_source.h"

namespace pedicel::app {

namespace {

struct Options {
  const std::vector<std::string>& packages;
  double unit = 0.0;  ///< m, of the lengths in tables and MTGs; 0: as they say
};

using Check =
    std::function<std::string(const std::filesystem::path&, const Options&, Diagnostics&)>;

/// Reads one kind of file; faults go to the diagnostics, or come as InvalidFile. What is worth
/// knowing of a good one comes back.
struct Kind {
  const char* format;     ///< of `format:`; empty: none
  const char* extension;  ///< empty: none of its own
  const char* name;
  Check check;
};

// Built, as a scene would.
std::string check_built(const std::optional<plant::PlantFile>& file,
                        const std::filesystem::path& path, Diagnostics& diagnostics) {
  if (!file) return {};
  plant::BuildOptions options;
  options.leaf_folders = {path.parent_path(), path.parent_path() / "../assets/leaves"};
  for (const std::filesystem::path& folder : asset_leaf_folders())
    options.leaf_folders.push_back(folder);
  simulation::say_if_large(*file);
  const auto built = plant::build_plant(*file, options, diagnostics);
  return built ? plant::residual_text(*built) : "";
}

std::string check_plant(const std::filesystem::path& path, const Options&,
                        Diagnostics& diagnostics) {
  return check_built(plant::read_plant_file(path, diagnostics), path, diagnostics);
}

Check check_source(plant::SourceKind kind) {
  return
      [kind](const std::filesystem::path& path, const Options& options, Diagnostics& diagnostics) {
        return check_built(plant::read_plant_source(path, options.unit, diagnostics, kind), path,
                           diagnostics);
      };
}

std::string check_leaf(const std::filesystem::path& path, const Options&,
                       Diagnostics& diagnostics) {
  plant::read_leaf_template(path, diagnostics);
  return {};
}

/// What a run would say ("FILE:LINE: warning: ...") as a warning.
void warn(const std::string& note, Diagnostics& diagnostics) {
  static const std::string mark = ": warning: ";
  const std::size_t at = note.find(mark);
  if (at == std::string::npos)
    diagnostics.warning({}, note);
  else
    diagnostics.warning({note.substr(0, at)}, note.substr(at + mark.size()));
}

std::string check_scene(const std::filesystem::path& path, const Options& given,
                        Diagnostics& diagnostics) {
  const std::optional<world::Scene> scene = world::read_scene(path, diagnostics);
  if (!scene) return {};
  simulation::SimulationOptions options;
  options.packages = given.packages;
  options.leaf_folders = asset_leaf_folders();
  // Builds everything that the scene names, and runs none of it.
  const simulation::Simulation simulation(*scene, options);
  for (const std::string& note : simulation.notes()) warn(note, diagnostics);
  return simulation::worst_residual(simulation.plants());
}

// The plant is built, too.
std::string check_experiment(const std::filesystem::path& path, const Options& given,
                             Diagnostics& diagnostics) {
  const auto experiment = discrepancy::read_experiment(path, diagnostics);
  if (!experiment) return {};
  if (experiment->has_robot()) return check_scene_experiment(*experiment, diagnostics);
  check_plant(experiment->plants.front().path, given, diagnostics);
  // What a diagnosis would refuse.
  discrepancy::add_refusal(diagnostics, discrepancy::admit(*experiment));
  int samples = 0;
  for (const discrepancy::Trial& trial : experiment->trials) samples += trial.markers.size();
  return std::to_string(experiment->trials.size()) + " trials, " +
         std::to_string(experiment->markers.size()) + " markers, " + std::to_string(samples) +
         " samples";
}

std::string check_robot(const std::filesystem::path& path, const Options& given,
                        Diagnostics& diagnostics) {
  robot::PackagePaths paths = robot::PackagePaths::from_environment();
  for (const std::string& package : given.packages) paths.add(package);
  const auto robot = robot::read_robot(path, paths, diagnostics);
  if (!robot) return {};
  for (std::string& warning : simulation::large_mesh_warnings(*robot))
    diagnostics.warning({path.string()}, std::move(warning));
  return {};
}

std::string check_mesh(const std::filesystem::path& path, const Options&, Diagnostics&) {
  return std::to_string(geometry::load_mesh(path).triangles.size()) + " triangles";
}

std::string check_commands(const std::filesystem::path& path, const Options&,
                           Diagnostics& diagnostics) {
  return check_script(path, diagnostics);
}

std::string check_variation(const std::filesystem::path& path, const Options&, Diagnostics&) {
  const std::size_t count = world::Variation::read(path).numbers().size();
  return std::to_string(count) + (count == 1 ? " number varies" : " numbers vary");
}

std::string check_log_map(const std::filesystem::path& path, const Options&,
                          Diagnostics& diagnostics) {
  const auto map = discrepancy::read_log_map(path, diagnostics);
  return map ? std::to_string(map->markers.size()) + " markers, " +
                   std::to_string(map->wrenches.size()) + " wrench sensors"
             : "";
}

const Kind robot_kind{"", "", "robot", check_robot};
const Kind mtg_kind{"", ".mtg", "digitised plant", check_source(plant::SourceKind::mtg)};
const std::array kinds = {
    Kind{"pedicel-plant", "", "plant", check_plant},
    Kind{"pedicel-experiment", "", "experiment", check_experiment},
    Kind{"pedicel-scene", "", "scene", check_scene},
    Kind{"pedicel-leaf", "", "leaf template", check_leaf},
    Kind{"pedicel-variation", "", "variation", check_variation},
    Kind{"pedicel-log-map", "", "map of a log", check_log_map},
    mtg_kind,
    Kind{"", ".ply", "skeleton", check_source(plant::SourceKind::ply_skeleton)},
    Kind{"", ".stl", "mesh", check_mesh},
    Kind{"", ".obj", "mesh", check_mesh},
    Kind{"", ".dae", "mesh", check_mesh},
    Kind{"", ".gltf", "mesh", check_mesh},
    Kind{"", ".glb", "mesh", check_mesh}};

Kind kind_of_table(const TableKind& table) {
  if (table.check == nullptr)
    return {"", "", table.name, check_source(plant::SourceKind::skeleton_table)};
  return {"", "", table.name,
          [&table](const std::filesystem::path& path, const Options&, Diagnostics& diagnostics) {
            return table.check(path, diagnostics);
          }};
}

std::string expected_kinds() {
  const std::string list =
      joined(kinds, [&](const Kind& kind) { return *kind.format ? kind.format : kind.extension; });
  return list + ", " + robot::robot_formats() + ", a table (.csv) or a script of commands";
}

std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

/// By what the text begins with, where the name does not tell.
std::optional<Kind> kind_of_text(const std::filesystem::path& path, const std::string& extension) {
  const std::string text = io::read_text_file(path);
  if (plant::is_helios_xml(text))
    return Kind{"", "", "plant structure of Helios", check_source(plant::SourceKind::helios_xml)};
  if (robot::is_robot_text(text)) return robot_kind;
  if (text.find("\nMTG") != std::string::npos && text.find("CODE") != std::string::npos)
    return mtg_kind;
  if (const TableKind* table = table_kind(path)) return kind_of_table(*table);
  if (extension == ".csv") return kind_of_table(unknown_table);
  if (is_script(path)) return Kind{"", "", "script", check_commands};
  return std::nullopt;
}

Kind kind_of(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) return kind_of(path / "experiment.yaml");
  if (robot::is_robot_name(path)) return robot_kind;
  const std::string extension = lower_extension(path);
  for (const Kind& kind : kinds)
    if (*kind.extension && extension == kind.extension) return kind;
  if (extension == ".yaml" || extension == ".yml") {
    const std::string format = format_of(path);
    for (const Kind& kind : kinds)
      if (*kind.format && format == kind.format) return kind;
  } else if (const auto kind = kind_of_text(path, extension)) {
    return *kind;
  }
  throw InvalidFile({path.string()},
                    "kind of file is unknown, expected one of: " + expected_kinds());
}

void write_lines(const std::string& lines, std::ostream& out) {
  if (!lines.empty()) out << lines << "\n";
}

/// True where the file is good.
bool validate(const std::filesystem::path& path, const Options& options, std::ostream& out) {
  Diagnostics diagnostics;
  try {
    const Kind kind = kind_of(path);
    const std::string known = kind.check(path, options, diagnostics);
    write_lines(diagnostics.text(), out);
    if (!diagnostics.has_errors())
      out << path.string() << ": " << kind.name << ", good" << (known.empty() ? "" : "; ") << known
          << "\n";
  } catch (const InvalidFile& error) {
    write_lines(diagnostics.text(), out);
    write_lines(error.what(), out);
    return false;
  }
  return !diagnostics.has_errors();
}

}  // namespace

int validate_files(const std::vector<std::string>& files, const std::vector<std::string>& packages,
                   std::ostream& out, double unit) {
  bool good = true;
  for (const std::string& file : files) good = validate(file, {packages, unit}, out) && good;
  return good ? 0 : 3;
}

}  // namespace pedicel::app
