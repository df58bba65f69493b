#include "app/session/document/scene_save.h"

#include <algorithm>

#include "engine/core/check.h"
#include "engine/io/yaml_merge.h"
#include "engine/io/yaml_text.h"
#include "engine/io/yaml_words.h"
#include "engine/world/scene_fields.h"
#include "engine/world/scene_reader.h"
#include "engine/world/scene_writer.h"

namespace pedicel::app {

namespace {

using world::Scene;
using world::ScenePlant;

/// Whole: a path is seen from it.
std::filesystem::path folder_of(const std::filesystem::path& file) {
  return std::filesystem::absolute(file).parent_path();
}

bool has_plant(const Scene& scene, const std::string& name) {
  return std::ranges::any_of(scene.plants, [&](const ScenePlant& one) { return one.name == name; });
}

/// A line a place: such lists are long.
void write_recorded(io::YamlText& text, const Scene& before, const Scene& now) {
  if (!before.robot || !now.robot || before.robot->recorded == now.robot->recorded) return;
  const io::YamlText::Path place = {"robot", "recorded"};
  text.remove(place);
  std::string list;
  for (const world::RecordedPose& pose : now.robot->recorded)
    list += std::string(list.empty() ? "[" : ",") + "\n    {time: " + io::yaml_number(pose.time) +
            ", joints: " + world::fields::number_list(pose.joints) + "}";
  if (!list.empty()) text.set(place, list + "]");
}

/// Without new plants that have no stems yet: there is nothing of them to save.
Scene drawn_scene(const Document& document, const Scene& before) {
  Scene scene = scene_of(document);
  std::erase_if(scene.plants, [&](const ScenePlant& plant) {
    const auto& one = document.plants[static_cast<std::size_t>(document.plant_index(plant.name))];
    return one.file && one.file->curves.empty() && !has_plant(before, plant.name);
  });
  for (const ScenePlant& plant : scene.plants)
    if (plant.name.find_first_of("/.") != std::string::npos)
      throw UsageError("plant \"" + plant.name +
                       "\" has a name with a point, which a scene cannot hold, expected \"rename "
                       "plant\" before");
  for (const ScenePlant& plant : scene.plants)
    if (plant.file.empty() && plant.source != ScenePlant::Source::built_in)
      throw UsageError("plant \"" + plant.name +
                       "\" has no file yet, expected one before the scene");
  return scene;
}

/// With those that another program added to the text since it was `known`, in their places. The
/// others that are missing now were deleted or renamed.
void keep_unknown_plants(const Scene& known, const Scene& before, Scene& now) {
  for (std::size_t i = 0; i < before.plants.size(); ++i) {
    const ScenePlant& plant = before.plants[i];
    if (has_plant(now, plant.name) || has_plant(known, plant.name)) continue;
    now.plants.insert(now.plants.begin() + static_cast<long>(std::min(i, now.plants.size())),
                      plant);
  }
}

void check_sources(const Scene& before, const Scene& now) {
  for (const ScenePlant& was : before.plants)
    for (const ScenePlant& is : now.plants)
      if (was.name == is.name && was.source == ScenePlant::Source::built_in &&
          is.source != ScenePlant::Source::built_in)
        throw UsageError("plant \"" + is.name + "\" is built in, expected it to stay so");
}

Scene parsed(const std::string& text, const std::filesystem::path& path) {
  Diagnostics diagnostics;
  auto scene = world::parse_scene(text, path, diagnostics);
  if (!scene) throw InvalidFile(diagnostics);
  return std::move(*scene);
}

/// The name and what it is for are the file's own.
Scene with_head_of(Scene scene, const Scene& other) {
  scene.name = other.name, scene.purpose = other.purpose, scene.see = other.see;
  return scene;
}

std::string without_recorded(Scene scene, const std::filesystem::path& folder) {
  if (scene.robot) scene.robot->recorded.clear();
  return world::scene_text(scene, folder);
}

}  // namespace

std::string changed_scene_text(const Document& document, const std::string& text,
                               const std::string& known, const std::filesystem::path& of,
                               const std::filesystem::path& to) {
  const Scene before = parsed(text, of);
  Scene now = with_head_of(drawn_scene(document, before), before);
  if (known != text) keep_unknown_plants(parsed(known, of), before, now);
  check_sources(before, now);
  io::YamlText changed(io::merge_yaml(text, without_recorded(before, folder_of(of)),
                                      without_recorded(now, folder_of(to))));
  write_recorded(changed, before, now);
  const std::string result = changed.text();
  if (result != text && world::scene_text(with_head_of(parsed(result, to), now), folder_of(to)) !=
                            world::scene_text(now, folder_of(to)))
    throw UsageError(to.string() +
                     ": the changes cannot be written into it, expected a scene in plain YAML");
  return result;
}

std::string new_scene_text(const Document& document, const std::filesystem::path& to) {
  Scene scene = drawn_scene(document, Scene{});
  std::string name = to.filename().string();
  scene.name = name.substr(0, name.find(".scene.yaml"));
  return world::scene_text(scene, folder_of(to));
}

bool is_same_scene(const std::string& a, const std::string& b, const std::filesystem::path& path) {
  if (a == b) return true;
  try {
    return world::scene_text(parsed(a, path), folder_of(path)) ==
           world::scene_text(parsed(b, path), folder_of(path));
  } catch (const InvalidFile&) {
    return false;
  }
}

}  // namespace pedicel::app
