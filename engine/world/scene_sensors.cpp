#include <algorithm>
#include <cmath>

#include "engine/io/csv.h"
#include "engine/io/thing_bounds.h"
#include "engine/world/scene_sections.h"
#include "engine/world/settings.h"

namespace pedicel::world::sections {

namespace {

using io::KeyType;
using io::Told;

constexpr io::Bounds sensor_rates{1e-3, 1e4};

std::vector<std::string> sensor_words() {
  std::vector<std::string> words;
  words.reserve(sensor_count);
  for (int s = 0; s < sensor_count; ++s) words.emplace_back(name_of(static_cast<Sensor>(s)));
  return words;
}

const io::KeyList& camera_list() {
  static const io::KeyList keys{
      "camera",
      "a camera",
      {{.name = "name", .type = KeyType::text, .form = "once", .sentence = "name of the camera"},
       {.name = "eye",
        .type = KeyType::vector,
        .unit = "m",
        .bounds = io::place_bounds,
        .sentence = "where it stands"},
       {.name = "target",
        .type = KeyType::vector,
        .unit = "m",
        .otherwise = SceneCamera{}.target,
        .bounds = io::place_bounds,
        .form = "apart from `eye`",
        .sentence = "where it looks"},
       {.name = "fov",
        .unit = "rad",
        .otherwise = SceneCamera{}.field_of_view,
        .bounds = view_angles,
        .sentence = "vertical field of view"},
       {.name = "follow",
        .type = KeyType::map,
        .otherwise = Told{"none"},
        .form = "a thing",
        .sentence = "it goes with this; `eye` and `target` then count from it"},
       {.name = "position",
        .type = KeyType::vector,
        .unit = "m",
        .otherwise = Told{"in place of `eye`"},
        .bounds = io::place_bounds,
        .sentence = "where it stands, with `orientation`"},
       {.name = "orientation",
        .type = KeyType::rotation,
        .otherwise = Told{"in place of `target`"},
        .sentence = "turn of its frame: x right, y down, z forward"},
       {.name = "focal",
        .type = KeyType::numbers,
        .unit = "px",
        .otherwise = Told{"in place of `fov`"},
        .bounds = io::positive,
        .form = "one number, or twice the same",
        .sentence = "focal length for its `size`"},
       picture_size_key(SceneCamera{}.size, "width and height of what its sensors write"),
       {.name = "sensors",
        .type = KeyType::list,
        .otherwise = Told{"none"},
        .words = sensor_words(),
        .sentence = "what a run [writes](cameras.md#files-of-a-run) of it"},
       {.name = "rate",
        .unit = "Hz",
        .otherwise = SceneCamera{}.rate,
        .bounds = sensor_rates,
        .sentence = "how often"},
       {.name = "noise",
        .type = KeyType::map,
        .otherwise = Told{"none"},
        .sentence = "[noise](cameras.md#noise) of its sensors"}}};
  return keys;
}

/// Of the keys that instruments have, those of one kind.
io::KeyList instrument_list(const InstrumentKind& kind) {
  const SceneInstrument plain(kind);
  const auto has = [&](const std::string& key) { return std::ranges::count(kind.keys, key) > 0; };
  io::KeyList list{kind.name, kind.what, {}};
  list.keys.push_back(
      {.name = "name", .type = KeyType::text, .form = "once", .sentence = "name of the sensor"});
  if (has("link"))
    list.keys.push_back(
        {.name = "link",
         .type = KeyType::text,
         .otherwise = has("organ") ? io::Otherwise(Told{"on an organ"}) : io::Needed{},
         .form = "name of a link",
         .sentence = "where it sits"});
  if (has("organ")) {
    list.keys.push_back({.name = "organ",
                         .type = KeyType::text,
                         .otherwise = Told{"on a link"},
                         .form = "`PLANT/CURVE` or `PLANT/FRUIT`",
                         .sentence = "where it sits on a plant, in place of `link`"});
    list.keys.push_back({.name = "at",
                         .unit = "1",
                         .otherwise = plain.at,
                         .bounds = {0.0, 1.0},
                         .sentence = "fraction of the curve's length, from its foot"});
  }
  if (has("position")) list.also = {&pose_keys()};
  if (has("touch"))
    list.keys.push_back(
        {.name = "touch",
         .type = KeyType::flag,
         .otherwise = plain.touch,
         .sentence = "only what plants and bodies exert on that link (a fingertip)"});
  if (has("tared"))
    list.keys.push_back(
        {.name = "tared",
         .type = KeyType::flag,
         .otherwise = plain.tared,
         .sentence = "less its mean over the first 0.2 s; its table begins once that is known"});
  list.keys.push_back({.name = "rate",
                       .unit = "Hz",
                       .otherwise = plain.rate,
                       .bounds = sensor_rates,
                       .sentence = "how often it is sampled"});
  list.keys.push_back({.name = "noise",
                       .type = KeyType::map,
                       .otherwise = Told{"none"},
                       .sentence = "[noise](cameras.md#noise) of the sensor"});
  return list;
}

/// One a kind, in their order.
const std::vector<io::KeyList>& instrument_lists() {
  static const std::vector<io::KeyList> lists = [] {
    std::vector<io::KeyList> all;
    for (const InstrumentKind& kind : instrument_kinds()) all.push_back(instrument_list(kind));
    return all;
  }();
  return lists;
}

template <class Noise>
void read_described(io::DescribedMap& map, const char* key, Noise& noise) {
  if (const auto node = map.optional(key))
    apply_settings(read_settings(*node, key), key, noise.parameters(), {}, node->diagnostics());
}

std::vector<Sensor> read_sensor_words(const io::YamlNode& node) {
  const std::vector<std::string> words = sensor_words();
  std::vector<Sensor> sensors;
  for (const io::YamlNode& one : node.list("sensors")) {
    const std::string word = one.choice("sensors", words);
    const auto sensor = static_cast<Sensor>(std::ranges::find(words, word) - words.begin());
    if (std::ranges::count(sensors, sensor) > 0)
      one.error("sensors: \"" + word + "\" comes twice, expected once");
    else
      sensors.push_back(sensor);
  }
  return sensors;
}

/// As measured cameras have it: a place and a turn of the frame with x right, y down, z forward.
void read_optical_pose(io::DescribedMap& map, SceneCamera& camera) {
  if (map.has("eye") || map.has("target"))
    map.error("a camera: expected eye and target, or position and orientation, not both");
  const Pose pose = read_pose(map);
  camera.eye = pose.position;
  camera.target = pose * Vec3::UnitZ();
  camera.up = pose.rotation * -Vec3::UnitY();
}

/// `focal` in pixels in place of `fov`. Pictures have square pixels and the axis in their middle.
void read_focal(io::DescribedMap& map, SceneCamera& camera) {
  const auto node = map.optional("focal");
  if (!node) return;
  if (map.has("fov")) node->error("focal: expected fov or focal, not both");
  std::vector<double> focal;
  const int before = node->diagnostics().error_count();
  if (node->is_list())
    focal = node->numbers("focal", map.key("focal").bounds);
  else
    focal = {node->number("focal", map.key("focal").bounds)};
  if (node->diagnostics().error_count() > before) return;
  if (focal.empty() || focal.size() > 2 || (focal.size() == 2 && focal[0] != focal[1]))
    return node->error("focal: expected one length in pixels, or two equal ones");
  camera.field_of_view = 2.0 * std::atan(0.5 * camera.size[1] / focal[0]);
  const io::Bounds& angles = map.key("fov").bounds;
  if (!io::within(camera.field_of_view, angles))
    node->error("focal: gives a field of view beyond " + io::format_number(angles.minimum) +
                " to " + io::format_number(angles.maximum) + " rad");
}

}  // namespace

std::vector<const io::KeyList*> sensor_keys() {
  std::vector<const io::KeyList*> all = {&camera_list()};
  for (const io::KeyList& list : instrument_lists()) all.push_back(&list);
  return all;
}

SceneCamera read_camera(const io::YamlNode& node) {
  SceneCamera camera;
  const int before = node.diagnostics().error_count();
  io::DescribedMap map(node, camera_list());
  camera.name = map.text("name");
  read_picture_size(map, camera.size);
  if (map.has("orientation")) {
    read_optical_pose(map, camera);
  } else {
    camera.eye = read_place(map, "eye");
    camera.target = read_place(map, "target");
  }
  camera.field_of_view = map.number("fov");
  read_focal(map, camera);
  if (const auto follow = map.optional("follow")) camera.follow = read_anchor(*follow, "follow");
  if (const auto words = map.optional("sensors")) camera.sensors = read_sensor_words(*words);
  camera.rate = map.number("rate");
  read_described(map, "noise", camera.noise);
  const bool is_read = node.diagnostics().error_count() == before;
  if (is_read && !((camera.eye - camera.target).norm() > 1e-6))
    node.error("a camera: expected eye and target to be apart");
  map.finish();
  return camera;
}

SceneInstrument read_instrument(const io::YamlNode& node, const InstrumentKind& kind) {
  SceneInstrument one(kind);
  const io::KeyList& keys = *std::ranges::find(instrument_lists(), kind.name, &io::KeyList::name);
  io::DescribedMap map(node, keys);
  one.where = node.position();
  one.name = map.text("name");
  if (keys.find("link")) one.link = map.text("link");
  if (keys.find("organ")) {
    one.organ = map.text("organ");
    one.at = map.number("at");
    if (one.link.empty() == one.organ.empty()) map.error(kind.what + ": expected link or organ");
  }
  if (keys.find("orientation")) one.pose = read_pose(map);
  if (keys.find("touch")) one.touch = map.boolean("touch");
  if (keys.find("tared")) one.tared = map.boolean("tared");
  one.rate = map.number("rate");
  read_described(map, "noise", one.noise);
  map.finish();
  return one;
}

SceneLook read_look(const io::YamlNode& node) {
  SceneLook look;
  apply_settings(read_settings(node, "look"), "look", look.parameters(), {}, node.diagnostics());
  return look;
}

}  // namespace pedicel::world::sections
