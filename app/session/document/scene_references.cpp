#include "app/session/document/scene_references.h"

#include <algorithm>

namespace pedicel::app {

namespace {

using world::Anchor;

bool is_fruit_of(const std::string& fruit, const std::string& plant) {
  return fruit.size() > plant.size() && fruit.starts_with(plant) && fruit[plant.size()] == '/';
}

/// A plant's name stands for its fruits.
bool means(const std::string& said, const std::string& name) {
  return !said.empty() && (said == name || is_fruit_of(said, name));
}

bool means(const Anchor& anchor, const std::string& name) {
  return anchor.kind == Anchor::Kind::tool ? name == "robot" : means(anchor.name, name);
}

bool means(const world::Expectation& e, const std::string& name) {
  return means(e.fruit, name) || means(e.plant, name) || means(e.body, name) ||
         (name == "robot" && !e.link.empty());
}

/// "plants.truss.detach.stretch", "bodies.tray.position.x": what is swept or varied.
bool key_means(const std::string& key, const std::string& name) {
  for (const char* list : {"plants.", "bodies.", "cameras."})
    if (key.starts_with(list + name + ".")) return true;
  return name == "robot" && key.starts_with("robot.");
}

long keys_that_mean(const world::Scene& scene, const std::string& name) {
  return std::ranges::count_if(scene.vary,
                               [&](const auto& one) { return key_means(one.key, name); }) +
         (scene.sweep && key_means(scene.sweep->key, name) ? 1 : 0);
}

bool tie_means(const world::SceneTie& tie, const std::string& name) {
  return means(tie.organ, name) || means(tie.to_organ, name);
}

bool sits_on(const world::SceneInstrument& instrument, const std::string& name) {
  return means(instrument.organ, name) || (name == "robot" && !instrument.link.empty());
}

/// By its tool a robot cuts.
bool cut_means(const world::SceneCut& cut, const std::string& name) {
  return means(cut.organ, name) || (name == "robot" && !cut.time);
}

bool programme_means(const world::Scene& scene, const std::string& name) {
  return scene.robot && std::ranges::any_of(scene.robot->waypoints, [&](const auto& waypoint) {
           return means(waypoint.at, name);
         });
}

/// Plants that stand in a grid are called NAME_0, NAME_1, ...
const DocumentPlant* find_plant(const Document& document, const std::string& name) {
  if (const int index = document.plant_index(name); index >= 0)
    return &document.plants[static_cast<std::size_t>(index)];
  const std::size_t cut = name.rfind('_');
  const int index = cut == std::string::npos ? -1 : document.plant_index(name.substr(0, cut));
  return index < 0 ? nullptr : &document.plants[static_cast<std::size_t>(index)];
}

bool has_fruit(const Document& document, const std::string& fruit) {
  const std::size_t slash = fruit.find('/');
  const DocumentPlant* plant = find_plant(document, fruit.substr(0, slash));
  if (!plant || slash == std::string::npos) return false;
  const std::string name = fruit.substr(slash + 1);
  return !plant->file || std::ranges::any_of(plant->file->fruits,
                                             [&](const auto& one) { return one.name == name; });
}

bool has_body(const Document& document, const std::string& body) {
  return std::ranges::any_of(document.scene->bodies,
                             [&](const auto& one) { return one.name == body; });
}

bool has(const Document& document, const Anchor& anchor) {
  switch (anchor.kind) {
    case Anchor::Kind::none:
      return true;
    case Anchor::Kind::fruit:
      return has_fruit(document, anchor.name);
    case Anchor::Kind::body:
      return has_body(document, anchor.name);
    case Anchor::Kind::plant:
      return find_plant(document, anchor.name) != nullptr;
    case Anchor::Kind::tool:
      return document.scene->robot.has_value();
  }
  return true;
}

std::string counted(long count, const std::string& what) {
  return count == 1 ? "1 " + what : std::to_string(count) + " " + what + "s";
}

void rename(std::string& said, const std::string& name, const std::string& to) {
  if (means(said, name)) said = to + said.substr(name.size());
}

const char* list_of(ThingKind kind) {
  return kind == ThingKind::plant ? "plants." : kind == ThingKind::body ? "bodies." : "cameras.";
}

/// In keys: of settings, and of what is varied and swept.
void rename_keys(Document& document, world::Scene& scene, ThingKind kind, const std::string& name,
                 const std::string& to) {
  const std::string start = list_of(kind) + name + ".";
  const auto rename_in = [&](std::string& key) {
    if (key.starts_with(start)) key = list_of(kind) + to + "." + key.substr(start.size());
  };
  for (auto& [key, value] : document.settings) rename_in(key);
  for (auto& one : scene.vary) rename_in(one.key);
  if (scene.sweep) rename_in(scene.sweep->key);
}

}  // namespace

bool has_organ(const Document& document, const std::string& organ) {
  if (has_fruit(document, organ)) return true;
  const std::size_t slash = organ.find('/');
  const DocumentPlant* plant = find_plant(document, organ.substr(0, slash));
  return plant && slash != std::string::npos &&
         std::ranges::any_of(plant->file->curves,
                             [&](const auto& one) { return one.name == organ.substr(slash + 1); });
}

std::vector<std::string> broken_references(const Document& document) {
  std::vector<std::string> broken;
  const auto add = [&](const std::string& name) {
    if (std::ranges::find(broken, name) == broken.end()) broken.push_back(name);
  };
  const auto look = [&](const Anchor& anchor) {
    if (!has(document, anchor))
      add(anchor.kind == Anchor::Kind::tool ? std::string("robot") : anchor.name);
  };
  const world::Scene& scene = *document.scene;
  if (scene.robot)
    for (const auto& waypoint : scene.robot->waypoints) look(waypoint.at);
  for (const auto& camera : scene.cameras) look(camera.follow);
  for (const auto& load : scene.loads)
    if (!has_fruit(document, load.target)) add(load.target);
  for (const auto& tie : scene.ties)
    for (const std::string& organ : {tie.organ, tie.to_organ})
      if (!organ.empty() && !has_organ(document, organ)) add(organ);
  for (const auto& cut : scene.cuts) {
    if (!has_organ(document, cut.organ)) add(cut.organ);
    if (!cut.time && !scene.robot) add("robot");
  }
  for (const auto& one : scene.instruments) {
    if (!one.link.empty() && !scene.robot) add("robot");
    if (!one.organ.empty() && !has_organ(document, one.organ)) add(one.organ);
  }
  for (const auto& e : scene.expectations) {
    if (!e.fruit.empty() && !has_fruit(document, e.fruit)) add(e.fruit);
    if (!e.plant.empty() && !find_plant(document, e.plant)) add(e.plant);
    if (!e.body.empty() && !has_body(document, e.body)) add(e.body);
    if (!e.link.empty() && !scene.robot) add("robot");
  }
  return broken;
}

std::string references_to(const Document& document, const std::string& name) {
  const world::Scene& scene = *document.scene;
  std::string text;
  const auto add = [&](const std::string& what) { text += (text.empty() ? "" : ", ") + what; };
  if (programme_means(scene, name)) add("the robot's program");
  const auto loads = std::ranges::count_if(
      scene.loads, [&](const auto& load) { return means(load.target, name); });
  const auto expectations =
      std::ranges::count_if(scene.expectations, [&](const auto& e) { return means(e, name); });
  const auto cameras = std::ranges::count_if(
      scene.cameras, [&](const auto& camera) { return means(camera.follow, name); });
  const auto ties =
      std::ranges::count_if(scene.ties, [&](const auto& tie) { return tie_means(tie, name); });
  const auto cuts =
      std::ranges::count_if(scene.cuts, [&](const auto& cut) { return cut_means(cut, name); });
  if (loads) add(counted(loads, "load"));
  if (ties) add(counted(ties, "tie"));
  if (cuts) add(counted(cuts, "cut"));
  for (const world::InstrumentKind& kind : world::instrument_kinds())
    if (const auto count = std::ranges::count_if(
            of_kind(scene, kind), [&](const auto& one) { return sits_on(one, name); }))
      add(counted(count, kind.noun));
  if (const long keys = keys_that_mean(scene, name)) add(counted(keys, "varied key"));
  if (expectations) add(counted(expectations, "expectation"));
  if (cameras) add(counted(cameras, "camera") + " that follow" + (cameras == 1 ? "s" : "") + " it");
  return text;
}

void clear_references(Document& document, const std::string& name) {
  world::Scene& scene = document.edit_scene();
  if (programme_means(scene, name)) scene.robot->waypoints.clear();
  std::erase_if(scene.loads, [&](const auto& load) { return means(load.target, name); });
  std::erase_if(scene.ties, [&](const auto& tie) { return tie_means(tie, name); });
  std::erase_if(scene.cuts, [&](const auto& cut) { return cut_means(cut, name); });
  std::erase_if(scene.instruments, [&](const auto& one) { return sits_on(one, name); });
  std::erase_if(scene.expectations, [&](const auto& e) { return means(e, name); });
  std::erase_if(scene.vary, [&](const auto& one) { return key_means(one.key, name); });
  if (scene.sweep && key_means(scene.sweep->key, name)) {
    scene.sweep.reset();
    std::erase_if(scene.expectations, [](const auto& e) { return e.over_sweep(); });
  }
  for (auto& camera : scene.cameras)
    if (means(camera.follow, name)) camera.follow = {};
  std::erase_if(document.settings,
                [&](const auto& one) { return one.first.starts_with("plants." + name + "."); });
}

void rename_references(Document& document, ThingKind kind, const std::string& name,
                       const std::string& to) {
  world::Scene& scene = document.edit_scene();
  const auto anchor = [&](Anchor& a) {
    const bool of_plant = a.kind == Anchor::Kind::plant || a.kind == Anchor::Kind::fruit;
    if (kind == ThingKind::plant ? of_plant
                                 : kind == ThingKind::body && a.kind == Anchor::Kind::body)
      rename(a.name, name, to);
  };
  if (scene.robot)
    for (auto& waypoint : scene.robot->waypoints) anchor(waypoint.at);
  for (auto& camera : scene.cameras) anchor(camera.follow);
  rename_keys(document, scene, kind, name, to);
  if (kind == ThingKind::camera) {
    for (auto& picture : scene.pictures)
      if (picture.camera == name) picture.camera = to;
    if (scene.video.camera == name) scene.video.camera = to;
    return;
  }
  for (auto& e : scene.expectations) {
    if (kind == ThingKind::plant) rename(e.fruit, name, to), rename(e.plant, name, to);
    if (kind == ThingKind::body) rename(e.body, name, to);
  }
  if (kind == ThingKind::body) return;
  for (auto& load : scene.loads) rename(load.target, name, to);
  for (auto& tie : scene.ties) rename(tie.organ, name, to), rename(tie.to_organ, name, to);
  for (auto& cut : scene.cuts) rename(cut.organ, name, to);
  for (auto& one : scene.instruments) rename(one.organ, name, to);
}

void rename_organ_references(Document& document, const std::string& plant, const std::string& name,
                             const std::string& to) {
  const auto renamed = [&](std::string& said) {
    const std::size_t slash = said.find('/');
    if (slash == std::string::npos || said.substr(slash + 1) != name) return false;
    const DocumentPlant* of = find_plant(document, said.substr(0, slash));
    if (!of || of->entry.name != plant) return false;
    said = said.substr(0, slash + 1) + to;
    return true;
  };
  world::Scene scene = *document.scene;
  bool any = false;
  const auto anchor = [&](Anchor& a) {
    if (a.kind == Anchor::Kind::fruit) any |= renamed(a.name);
  };
  if (scene.robot)
    for (auto& waypoint : scene.robot->waypoints) anchor(waypoint.at);
  for (auto& camera : scene.cameras) anchor(camera.follow);
  for (auto& e : scene.expectations) any |= renamed(e.fruit);
  for (auto& load : scene.loads) any |= renamed(load.target);
  for (auto& tie : scene.ties) any |= renamed(tie.organ), any |= renamed(tie.to_organ);
  for (auto& cut : scene.cuts) any |= renamed(cut.organ);
  for (auto& one : scene.instruments) any |= renamed(one.organ);
  if (any) document.edit_scene() = std::move(scene);
}

}  // namespace pedicel::app
