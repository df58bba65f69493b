#include "app/session/document/document.h"

#include <algorithm>
#include <cmath>

#include "app/session/document/plant_import.h"
#include "engine/core/check.h"
#include "engine/core/state_hash.h"
#include "engine/io/asset_folder.h"
#include "engine/world/scene_reader.h"
#include "engine/world/scene_writer.h"
#include "engine/world/settings.h"
#include "plugins/simulation/scene_plants.h"
#include "plugins/skeleton/plant_source.h"

namespace pedicel::app {

namespace {

void add_text(StateHash& hash, const std::string& text) {
  hash.add(static_cast<std::uint64_t>(text.size()));
  for (const char c : text) hash.add(static_cast<std::uint64_t>(static_cast<unsigned char>(c)));
}

std::shared_ptr<const world::Scene> bare_scene() {
  auto scene = std::make_shared<world::Scene>();
  scene->name = "untitled";
  scene->purpose = "a plant that is being drawn";
  scene->see = "what was drawn";
  scene->duration = 10.0;
  scene->ground = world::GroundPlane{};
  return scene;
}

/// What commands change of it beside the plants; recorded waypoints are the document's own.
std::string scene_hash_text(const world::Scene& scene) {
  world::Scene things = scene;
  things.name = things.purpose = things.see = {};
  if (things.robot) things.robot->recorded.clear();
  return world::scene_text_without_plants(things, {});
}

/// A bar that lies at height 0 would be half in the ground: it lies on it. Stems that stand in it
/// do so, and what hangs below 0 is meant to.
double ground_under(const plant::PlantFile& plant) {
  constexpr double lies = 0.5;    // sine of the steepest that lies
  constexpr double level = 1e-6;  // m
  for (const plant::PlantCurve& curve : plant.curves)
    for (const Vec3& point : curve.points)
      if (point.z() < -level) return 0.0;
  double lowest = 0.0;
  for (const plant::PlantCurve& curve : plant.curves)
    for (std::size_t i = 1; i < curve.points.size(); ++i) {
      const Vec3 piece = curve.points[i] - curve.points[i - 1];
      if (std::abs(piece.z()) > lies * piece.norm()) continue;
      const double half =
          curve.section.kind == plant::SectionKind::rectangle
              ? 0.5 * (std::abs(curve.section.normal.z()) >= 0.7 * curve.section.normal.norm()
                           ? curve.section.height
                           : curve.section.width)
          : curve.radius.empty() ? 0.0
                                 : curve.radius[std::min(i, curve.radius.size() - 1)];
      lowest = std::min(lowest, std::min(curve.points[i].z(), curve.points[i - 1].z()) - half);
    }
  return lowest;
}

/// Reads the plant files that a scene names. One that is absent and optional is left to the scene's
/// own rules.
void read_plants(Document& document, Diagnostics& diagnostics) {
  for (const world::ScenePlant& entry : document.scene->plants) {
    DocumentPlant one{entry, nullptr};
    const bool is_file = entry.source != world::ScenePlant::Source::built_in;
    const std::filesystem::path path = simulation::source_of(entry);
    if (is_file && !path.empty())
      if (auto file = simulation::read_scene_plant(entry, diagnostics))
        one.file = std::make_shared<const plant::PlantFile>(std::move(*file));
    document.plants.push_back(std::move(one));
  }
}

}  // namespace

bool is_scene(const std::filesystem::path& path) {
  return path.filename().string().ends_with(".scene.yaml");
}

int Document::plant_index(const std::string& name) const {
  for (std::size_t i = 0; i < plants.size(); ++i)
    if (plants[i].entry.name == name) return static_cast<int>(i);
  return -1;
}

const plant::PlantFile& Document::plant(const std::string& name) const {
  const int index = plant_index(name);
  if (index >= 0 && plants[index].file) return *plants[index].file;
  std::string names;
  for (const DocumentPlant& one : plants)
    if (one.file) names += (names.empty() ? "" : ", ") + one.entry.name;
  throw UsageError("no plant \"" + name + "\" to edit, expected " +
                   (names.empty() ? "one (see: new plant)" : "one of: " + names));
}

plant::PlantFile& Document::edit_plant(const std::string& name) {
  auto copy = std::make_shared<plant::PlantFile>(plant(name));
  plant::PlantFile& edited = *copy;
  plants[plant_index(name)].file = std::move(copy);
  return edited;
}

world::Scene& Document::edit_scene() {
  auto copy = std::make_shared<world::Scene>(*scene);
  world::Scene& edited = *copy;
  scene = std::move(copy);
  return edited;
}

std::uint64_t Document::state_hash() const {
  StateHash hash;
  add_text(hash, scene_hash_text(*scene));
  for (const DocumentPlant& one : plants) {
    add_text(hash, one.entry.name);
    add_text(hash, one.file ? plant::plant_text(*one.file) : "");
    hash.add(one.entry.pose.position);
    hash.add(one.entry.pose.rotation);
  }
  for (const auto& [key, text] : settings) {
    add_text(hash, key);
    add_text(hash, text);
  }
  for (const RobotWaypoint& waypoint : waypoints) {
    hash.add(waypoint.time);
    for (const double q : waypoint.joints) hash.add(q);
  }
  return hash.value();
}

bool is_lone_plant(const std::filesystem::path& path) {
  const plant::SourceKind kind = plant::source_kind(path);
  return plant::is_skeleton(kind) || path.filename().string().ends_with(".plant.yaml");
}

void stand_on_ground(Document& document) {
  double lowest = 0.0;
  for (const DocumentPlant& one : document.plants)
    if (one.file) lowest = std::min(lowest, ground_under(*one.file));
  if (lowest >= 0.0 || !document.scene->ground) return;
  auto scene = std::make_shared<world::Scene>(*document.scene);
  scene->ground->height = lowest;
  document.scene = std::move(scene);
}

Document empty_document() {
  Document document;
  document.scene = bare_scene();
  return document;
}

Document document_of(world::Scene scene, Diagnostics& diagnostics) {
  Document document;
  document.scene = std::make_shared<const world::Scene>(std::move(scene));
  if (document.scene->robot) document.waypoints = document.scene->robot->recorded;
  read_plants(document, diagnostics);
  return document;
}

Document open_document(const std::filesystem::path& path, double unit, Diagnostics* remarks) {
  Diagnostics diagnostics;
  Document document = empty_document();
  if (is_scene(path)) {
    auto scene = world::read_scene(path, diagnostics);
    if (!scene) throw InvalidFile(diagnostics);
    document = document_of(std::move(*scene), diagnostics);
  } else if (auto file = read_plant(path, diagnostics, unit)) {
    DocumentPlant one;
    one.entry.name = file->name;
    if (is_plant_file(path)) one.entry.file = path;
    one.file = std::make_shared<const plant::PlantFile>(std::move(*file));
    document.plants.push_back(std::move(one));
    stand_on_ground(document);
  }
  if (diagnostics.has_errors()) throw InvalidFile(diagnostics);
  if (is_scene(path) && unit > 0.0)
    throw UsageError(
        "a scene says the unit of each of its plants itself (unit: cm), expected none "
        "beside it");
  if (remarks) *remarks = diagnostics;
  document.path = path;
  document.unit = unit;
  return document;
}

world::Scene scene_of(const Document& document) {
  world::Scene scene = *document.scene;
  scene.plants.clear();
  for (const DocumentPlant& one : document.plants) scene.plants.push_back(one.entry);
  if (scene.robot) scene.robot->recorded = document.waypoints;
  for (const auto& [key, text] : document.settings) world::apply_override(scene, key, text);
  return scene;
}

simulation::SimulationOptions options_of(const Document& document,
                                         const std::vector<std::string>& packages) {
  simulation::SimulationOptions options;
  options.packages = packages;
  options.leaf_folders = asset_leaf_folders();
  for (const DocumentPlant& one : document.plants)
    if (one.file) options.edited[one.entry.name] = *one.file;
  return options;
}

std::vector<std::filesystem::path> asset_leaf_folders() {
  const std::filesystem::path assets = io::asset_folder();
  if (assets.empty()) return {};
  return {assets / "leaves"};
}

}  // namespace pedicel::app
