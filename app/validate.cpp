#include "app/validate.h"

#include <array>
#include <filesystem>
#include <optional>

#include "app/simulation.h"
#include "discrepancy/admission.h"
#include "io/csv.h"
#include "io/yaml.h"
#include "plant/leaf_template.h"
#include "plant/mtg_reader.h"
#include "plant/plant_builder.h"
#include "robot/urdf_reader.h"
#include "session/document.h"
#include "world/scene_reader.h"

namespace pedicel::app {

namespace {

using Packages = std::vector<std::string>;

/// Reads one kind of file; faults go to the diagnostics, or come as InvalidFile. What is worth
/// knowing of a good one comes back.
struct Kind {
  const char* format;     ///< of `format:`; empty: none
  const char* extension;  ///< empty: none of its own
  const char* name;
  std::string (*check)(const std::filesystem::path&, const Packages&, Diagnostics&);
};

std::string check_plant(const std::filesystem::path& path, const Packages&,
                        Diagnostics& diagnostics) {
  const std::optional<plant::PlantFile> file = plant::read_plant_file(path, diagnostics);
  if (!file) return {};
  plant::BuildOptions options;
  options.leaf_folders = {path.parent_path(), path.parent_path() / "../assets/leaves"};
  for (const std::filesystem::path& folder : asset_leaf_folders())
    options.leaf_folders.push_back(folder);
  const auto built = plant::build_plant(*file, options, diagnostics);
  return built ? plant::residual_text(*built) : "";
}

std::string check_mtg(const std::filesystem::path& path, const Packages&,
                      Diagnostics& diagnostics) {
  plant::read_mtg(path, {}, diagnostics);
  return {};
}

std::string check_leaf(const std::filesystem::path& path, const Packages&,
                       Diagnostics& diagnostics) {
  plant::read_leaf_template(path, diagnostics);
  return {};
}

std::string check_scene(const std::filesystem::path& path, const Packages& packages,
                        Diagnostics& diagnostics) {
  const std::optional<world::Scene> scene = world::read_scene(path, diagnostics);
  if (!scene) return {};
  SimulationOptions options;
  options.packages = packages;
  options.leaf_folders = asset_leaf_folders();
  // Builds everything that the scene names, and runs none of it.
  return Simulation(*scene, options).worst_residual();
}

// The plant is built, too.
std::string check_experiment(const std::filesystem::path& path, const Packages& packages,
                             Diagnostics& diagnostics) {
  const auto experiment = discrepancy::read_experiment(path, diagnostics);
  if (!experiment) return {};
  check_plant(experiment->plant_path, packages, diagnostics);
  // What a diagnosis would refuse.
  discrepancy::add_refusal(diagnostics, discrepancy::admit(*experiment));
  int samples = 0;
  for (const discrepancy::Trial& trial : experiment->trials) samples += trial.markers.size();
  return std::to_string(experiment->trials.size()) + " trials, " +
         std::to_string(experiment->markers.size()) + " markers, " + std::to_string(samples) +
         " samples";
}

std::string check_urdf(const std::filesystem::path& path, const Packages& packages,
                       Diagnostics& diagnostics) {
  robot::PackagePaths paths = robot::PackagePaths::from_environment();
  for (const std::string& package : packages) paths.add(package);
  robot::read_urdf(path, paths, diagnostics);
  return {};
}

std::string check_csv(const std::filesystem::path& path, const Packages&,
                      Diagnostics& diagnostics) {
  io::CsvRules rules;
  rules.empty_cells = true;
  io::read_csv(path, rules, diagnostics);
  return {};
}

constexpr std::array kinds = {Kind{"pedicel-plant", "", "plant", check_plant},
                              Kind{"pedicel-experiment", "", "experiment", check_experiment},
                              Kind{"pedicel-scene", "", "scene", check_scene},
                              Kind{"pedicel-leaf", "", "leaf template", check_leaf},
                              Kind{"", ".urdf", "robot", check_urdf},
                              Kind{"", ".mtg", "digitised plant", check_mtg},
                              Kind{"", ".csv", "table", check_csv}};

std::string expected_kinds() {
  std::string list;
  for (const Kind& kind : kinds)
    list += std::string(list.empty() ? "" : ", ") + (*kind.format ? kind.format : kind.extension);
  return list;
}

/// What `format:` says; empty where the file is no YAML map that has it.
std::string format_of(const std::filesystem::path& path) {
  Diagnostics unused;
  const io::YamlNode root = io::load_yaml(path, unused);
  if (!root.is_map()) return {};
  const YAML::Node format = root.raw()["format"];
  return format.IsDefined() && format.IsScalar() ? format.Scalar() : std::string{};
}

const Kind& kind_of(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) return kind_of(path / "experiment.yaml");
  const std::string extension = path.extension().string();
  for (const Kind& kind : kinds)
    if (*kind.extension && extension == kind.extension) return kind;
  const std::string format =
      extension == ".yaml" || extension == ".yml" ? format_of(path) : std::string{};
  for (const Kind& kind : kinds)
    if (*kind.format && format == kind.format) return kind;
  throw InvalidFile({path.string()},
                    "kind of file is unknown, expected one of: " + expected_kinds());
}

void write_lines(const std::string& lines, std::ostream& out) {
  if (!lines.empty()) out << lines << "\n";
}

/// True where the file is good.
bool validate(const std::filesystem::path& path, const Packages& packages, std::ostream& out) {
  Diagnostics diagnostics;
  try {
    const Kind& kind = kind_of(path);
    const std::string known = kind.check(path, packages, diagnostics);
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
                   std::ostream& out) {
  bool good = true;
  for (const std::string& file : files) good = validate(file, packages, out) && good;
  return good ? 0 : 3;
}

}  // namespace pedicel::app
