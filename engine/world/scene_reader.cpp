#include "engine/world/scene_reader.h"

#include <algorithm>
#include <set>

#include "engine/core/check.h"
#include "engine/world/scene_sections.h"
#include "engine/world/settings.h"

namespace pedicel::world {

namespace {

using io::KeyType;
using io::Told;

/// Plants, bodies and the like of a scene. The world compares the names of bodies with each other:
/// 10,000 of them take 1.3 s of processor time and 93 MB, 60,000 took above 15 s and 0.5 GB.
constexpr std::size_t most_named = 10'000;
constexpr std::size_t most_effects = 1000;

/// A number that scene_numbers() describes; its default is that of `Scene`.
io::Key number_key(std::string_view name) {
  static const Scene usual;
  const auto all = scene_numbers();
  const SceneNumber& one = *std::ranges::find(all, name, &SceneNumber::key);
  return {.name = std::string(name),
          .type = one.whole() ? KeyType::whole : KeyType::number,
          .unit = std::string(one.unit),
          .otherwise = one.whole() ? double(usual.*std::get<int Scene::*>(one.member))
                                   : usual.*std::get<double Scene::*>(one.member),
          .bounds = scene_bounds(name),
          .sentence = std::string(one.sentence)};
}

io::Key needed_number_key(std::string_view name) {
  io::Key key = number_key(name);
  key.otherwise = io::Needed{};
  return key;
}

/// A list or a map that has keys of its own, described elsewhere.
io::Key part_key(const char* name, KeyType type, const std::string& sentence,
                 const std::string& form = "", const char* otherwise = "none") {
  return {
      .name = name, .type = type, .otherwise = Told{otherwise}, .form = form, .sentence = sentence};
}

io::KeyList make_scene_list() {
  const std::string at_most_named = "at most " + std::to_string(most_named);
  io::KeyList keys{
      "scene",
      "a scene",
      {io::format_key("pedicel-scene"),
       io::version_key(),
       {.name = "name",
        .type = KeyType::text,
        .otherwise = Told{"the file's name"},
        .sentence = "name of the scene"},
       {.name = "purpose",
        .type = KeyType::text,
        .sentence = "one sentence: what the scene is for"},
       {.name = "see", .type = KeyType::text, .sentence = "what to look for"},
       needed_number_key("duration"),
       number_key("dt"),
       number_key("seed"),
       number_key("threads"),
       number_key("log_rate"),
       {.name = "gravity",
        .type = KeyType::vector,
        .unit = "m/s2",
        .otherwise = Scene{}.gravity,
        .bounds = {-most_gravity, most_gravity},
        .sentence = "gravity"},
       part_key("rods", KeyType::map, "settings of the rods: [Settings](settings.md#rods)"),
       part_key("coupling", KeyType::map, "settings of contact: [Settings](settings.md#coupling)"),
       part_key("plants", KeyType::list, "plants, below", at_most_named),
       part_key("robot", KeyType::map, "one robot, below"),
       part_key("bodies", KeyType::list, "rigid things, below", at_most_named),
       part_key("ground", KeyType::map, "a level plane, below"),
       part_key("loads", KeyType::list, "forces on fruits, below"),
       part_key("ties", KeyType::list, "strings that hold plants, below"),
       part_key("cuts", KeyType::list, "cuts through stems, below"),
       part_key("wind", KeyType::map, "wind over the scene, below"),
       part_key("effects", KeyType::list,
                "what robot, contact, plants and sensors do beyond the plain model, below",
                "at most " + std::to_string(most_effects)),
       part_key("cameras", KeyType::list, "views, below", at_most_named),
       part_key("look", KeyType::map, "light and colours: [Settings](settings.md#looks)", "",
                "defaults"),
       part_key("vary", KeyType::map, "what differs from seed to seed, below"),
       part_key("pictures", KeyType::list, "pictures of a run, below"),
       part_key("video", KeyType::map, "film of a run, below", "", "defaults"),
       part_key("sweep", KeyType::map, "a setting with several values, below"),
       part_key("expect", KeyType::list, "what must come out, below")}};
  auto after = std::ranges::find(keys.keys, "cameras", &io::Key::name) + 1;
  for (const InstrumentKind& kind : instrument_kinds())
    after = 1 + keys.keys.insert(after, part_key(kind.section.c_str(), KeyType::list,
                                                 kind.noun + "s, below", at_most_named));
  return keys;
}

const io::KeyList& scene_list() {
  static const io::KeyList keys = make_scene_list();
  return keys;
}

void read_head(io::DescribedMap& map, Scene& scene) {
  std::string stem = scene.file.stem().string();  // without .yaml
  if (stem.ends_with(".scene")) stem.resize(stem.size() - 6);
  scene.name = map.text("name");
  if (!map.has("name")) scene.name = stem;
  scene.purpose = map.text("purpose");
  scene.see = map.text("see");
  scene.duration = map.number("duration");
  scene.dt = map.number("dt");
  scene.log_rate = map.number("log_rate");
  scene.seed = map.integer("seed");
  scene.threads = map.integer("threads");
  scene.gravity = map.vector("gravity");
  if (scene.gravity.cwiseAbs().maxCoeff() > map.key("gravity").bounds.maximum)
    map.optional("gravity")->error("gravity: expected three numbers between -100 and 100 m/s2");
  if (const auto rods = map.optional("rods")) scene.rods = sections::read_settings(*rods, "rods");
  if (const auto coupling = map.optional("coupling"))
    scene.coupling = sections::read_settings(*coupling, "coupling");
}

template <class Item, class Read>
void read_list(io::DescribedMap& map, const char* key, std::vector<Item>& items, const Read& read) {
  for (const io::YamlNode& node : map.list(key)) items.push_back(read(node));
}

/// As read_list(), and names must be unique.
template <class Item, class Read>
void read_named(io::DescribedMap& map, const char* key, std::vector<Item>& items,
                const Read& read) {
  std::set<std::string> names;
  for (const io::YamlNode& node : map.list(key)) {
    if (items.size() == most_named)
      return node.error(std::string(key) + ": the list goes on, expected at most " +
                        std::to_string(most_named));
    items.push_back(read(node));
    const std::string& name = items.back().name;
    if (printable(name, name.size()) != name)
      node.error("name " + in_quotes(name) + " in " + key +
                 " has a line end or another control character, expected one without");
    if (!name.empty() && !names.insert(name).second)
      node.error("name \"" + name + "\" is used twice in " + key + ", expected once");
  }
}

void read_things(io::DescribedMap& map, const std::filesystem::path& folder, Scene& scene) {
  read_named(map, "plants", scene.plants,
             [&](const io::YamlNode& node) { return sections::read_plant(node, folder); });
  if (const auto robot = map.optional("robot")) scene.robot = sections::read_robot(*robot, folder);
  read_named(map, "bodies", scene.bodies, sections::read_body);
  if (const auto ground = map.optional("ground")) scene.ground = sections::read_ground(*ground);
  read_list(map, "loads", scene.loads, sections::read_load);
  if (const auto wind = map.optional("wind")) scene.wind = sections::read_wind(*wind);
  read_list(map, "ties", scene.ties, sections::read_tie);
  read_list(map, "cuts", scene.cuts, sections::read_cut);
  for (const io::YamlNode& node : map.list("effects")) {
    if (scene.effects.size() == most_effects)
      return node.error("effects: the list goes on, expected at most " +
                        std::to_string(most_effects));
    scene.effects.push_back(io::piece_of(node));
  }
}

void read_views(io::DescribedMap& map, Scene& scene) {
  read_named(map, "cameras", scene.cameras, sections::read_camera);
  for (const InstrumentKind& kind : instrument_kinds()) {
    std::vector<SceneInstrument> own;
    read_named(map, kind.section.c_str(), own,
               [&](const io::YamlNode& node) { return sections::read_instrument(node, kind); });
    std::ranges::move(own, std::back_inserter(scene.instruments));
  }
  if (const auto look = map.optional("look")) scene.look = sections::read_look(*look);
  read_list(map, "pictures", scene.pictures, sections::read_picture);
  if (const auto video = map.optional("video")) scene.video = sections::read_video(*video);
}

template <class Items>
bool has_name(const Items& items, const std::string& name) {
  for (const auto& item : items)
    if (item.name == name) return true;
  return false;
}

/// Plants that stand in a grid are called NAME_0, NAME_1, ...
bool is_plant(const Scene& scene, const std::string& name) {
  if (has_name(scene.plants, name)) return true;
  const std::size_t cut = name.rfind('_');
  return cut != std::string::npos && has_name(scene.plants, name.substr(0, cut));
}

void check_fruit(const Scene& scene, const std::string& fruit, const SourcePosition& where,
                 Diagnostics& diagnostics) {
  if (fruit.empty()) return;
  const std::size_t slash = fruit.find('/');
  if (slash == std::string::npos || !is_plant(scene, fruit.substr(0, slash)))
    diagnostics.error(where,
                      "fruit \"" + fruit + "\": expected PLANT/FRUIT, a plant of this scene");
}

void check_organ(const Scene& scene, const std::string& organ, const SourcePosition& where,
                 Diagnostics& diagnostics) {
  if (organ.empty()) return;  // that was told when it was read
  const std::size_t slash = organ.find('/');
  if (slash == std::string::npos || !is_plant(scene, organ.substr(0, slash)))
    diagnostics.error(where,
                      "organ \"" + organ + "\": expected PLANT/CURVE or PLANT/FRUIT of this scene");
}

void check_anchor(const Scene& scene, const Anchor& anchor, Diagnostics& diagnostics) {
  if (anchor.kind == Anchor::Kind::fruit)
    check_fruit(scene, anchor.name, anchor.where, diagnostics);
  if (anchor.kind == Anchor::Kind::body && !has_name(scene.bodies, anchor.name))
    diagnostics.error(anchor.where, "body \"" + anchor.name + "\": there is none of that name");
  if (anchor.kind == Anchor::Kind::plant && !is_plant(scene, anchor.name))
    diagnostics.error(anchor.where, "plant \"" + anchor.name + "\": there is none of that name");
  if (anchor.kind == Anchor::Kind::tool && !scene.robot)
    diagnostics.error(anchor.where, "tool: the scene has no robot");
}

void check_expectation(const Scene& scene, const Expectation& e, Diagnostics& diagnostics) {
  check_fruit(scene, e.fruit, e.where, diagnostics);
  if (!e.body.empty() && !has_name(scene.bodies, e.body))
    diagnostics.error(e.where, "body \"" + e.body + "\": there is none of that name");
  if (!e.plant.empty() && !is_plant(scene, e.plant))
    diagnostics.error(e.where, "plant \"" + e.plant + "\": there is none of that name");
  if (e.over_sweep() && !scene.sweep)
    diagnostics.error(e.where, "with_sweep: the scene has no sweep");
}

/// Keys that no scene has are found before a run; those of plants when its plants are built.
void check_vary(const Scene& scene, Diagnostics& diagnostics) {
  if (diagnostics.has_errors()) return;  // what could not be read is not drawn from
  try {
    drawn_scene(scene);
  } catch (const InvalidFile& fault) {
    diagnostics.add(fault);
  }
}

void check_references(io::DescribedMap& map, const Scene& scene, Diagnostics& diagnostics) {
  for (const SceneLoad& load : scene.loads)
    check_fruit(scene, load.target, load.where, diagnostics);
  for (const SceneTie& tie : scene.ties) {
    check_organ(scene, tie.organ, tie.where, diagnostics);
    check_organ(scene, tie.to_organ, tie.where, diagnostics);
  }
  for (const SceneCut& cut : scene.cuts) {
    check_organ(scene, cut.organ, cut.where, diagnostics);
    if (!cut.time && !scene.robot)
      diagnostics.error(cut.where, "by_tool: the scene has no robot, expected a time");
  }
  if (scene.robot)
    for (const SceneWaypoint& waypoint : scene.robot->waypoints)
      check_anchor(scene, waypoint.at, diagnostics);
  for (const SceneCamera& camera : scene.cameras) check_anchor(scene, camera.follow, diagnostics);
  for (const SceneInstrument& one : scene.instruments) {
    check_organ(scene, one.organ, one.where, diagnostics);
    if (!scene.robot && !one.link.empty())
      diagnostics.error(one.where, one.kind().what + ": the scene has no robot");
  }
  check_vary(scene, diagnostics);
  for (const Expectation& e : scene.expectations) check_expectation(scene, e, diagnostics);
  std::vector<std::string> wanted = {scene.video.camera};
  for (const ScenePicture& picture : scene.pictures) wanted.push_back(picture.camera);
  for (const std::string& camera : wanted)
    if (!camera.empty() && !has_name(scene.cameras, camera))
      map.error("camera \"" + camera + "\": there is none of that name");
}

std::optional<Scene> read(const io::YamlNode& root, const std::filesystem::path& path,
                          Diagnostics& diagnostics) {
  Scene scene;
  scene.file = path;
  io::DescribedMap map(root, scene_list());
  if (!map.has_format()) return std::nullopt;
  read_head(map, scene);
  read_things(map, path.parent_path(), scene);
  read_views(map, scene);
  if (const auto sweep = map.optional("sweep")) scene.sweep = sections::read_sweep(*sweep);
  if (const auto vary = map.optional("vary")) scene.vary = read_vary(*vary);
  read_list(map, "expect", scene.expectations, sections::read_expectation);
  map.finish();
  check_references(map, scene, diagnostics);
  return scene;
}

// A scene, or an error: what the text is as YAML (a key twice) counts, too.
template <class Parse>
std::optional<Scene> read_from(Parse parse, const std::filesystem::path& path,
                               Diagnostics& diagnostics) {
  const int errors_before = diagnostics.error_count();
  try {
    auto scene = read(parse(), path, diagnostics);
    if (diagnostics.error_count() == errors_before) return scene;
  } catch (const InvalidFile& fault) {
    diagnostics.add(fault);
  }
  return std::nullopt;
}

}  // namespace

std::vector<const io::KeyList*> scene_keys() {
  std::vector<const io::KeyList*> all = {&scene_list(), &sections::pose_keys(),
                                         &sections::thing_keys()};
  for (const auto& some : {sections::plant_keys(), sections::robot_keys(), sections::body_keys(),
                           sections::sensor_keys(), sections::view_keys(),
                           sections::expectation_keys(), variation_keys()})
    all.insert(all.end(), some.begin(), some.end());
  return all;
}

const io::Key& scene_key(std::string_view map, std::string_view key) {
  const auto all = scene_keys();
  const auto list = std::ranges::find(all, map, [](const io::KeyList* one) { return one->name; });
  PEDICEL_ASSERT(list != all.end() && (*list)->find(key));
  return *(*list)->find(key);
}

std::optional<Scene> read_scene(const std::filesystem::path& path, Diagnostics& diagnostics) {
  return read_from([&] { return io::load_yaml(path, diagnostics); }, path, diagnostics);
}

std::optional<Scene> parse_scene(const std::string& text, const std::filesystem::path& path,
                                 Diagnostics& diagnostics) {
  return read_from([&] { return io::parse_yaml(text, path.string(), diagnostics); }, path,
                   diagnostics);
}

}  // namespace pedicel::world
