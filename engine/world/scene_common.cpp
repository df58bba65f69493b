#include "engine/io/thing_bounds.h"
#include "engine/world/scene_sections.h"

namespace pedicel::world::sections {

const io::KeyList& pose_keys() {
  static const io::KeyList keys{"pose",
                                "a pose",
                                {{.name = "position",
                                  .type = io::KeyType::vector,
                                  .unit = "m",
                                  .otherwise = Vec3(0, 0, 0),
                                  .bounds = io::place_bounds,
                                  .sentence = "place in the world"},
                                 {.name = "orientation",
                                  .type = io::KeyType::rotation,
                                  .otherwise = io::Told{"`[0, 0, 0, 1]`"},
                                  .form = "not zero",
                                  .sentence = "turn in the world"}}};
  return keys;
}

const io::KeyList& thing_keys() {
  const auto one = [](const char* name, const char* form, const char* sentence) {
    return io::Key{.name = name,
                   .type = io::KeyType::text,
                   .otherwise = io::Told{"one of four"},
                   .form = form,
                   .sentence = sentence};
  };
  static const io::KeyList keys{
      "thing",
      "a thing",
      {one("fruit", "`PLANT/FRUIT`", "a fruit"), one("body", "name of a body", "a body"),
       one("plant", "name of a plant", "a plant"), one("tool", "`true`", "the robot's tool")}};
  return keys;
}

std::filesystem::path read_path(const io::YamlNode& node, const std::string& what,
                                const std::filesystem::path& folder, bool may_be_absent) {
  const std::filesystem::path path = (folder / node.text(what)).lexically_normal();
  std::error_code ignored;
  if (!may_be_absent && !std::filesystem::is_regular_file(path, ignored))
    node.error(what + ": " + path.string() + " is not there, expected a file");
  return path;
}

std::vector<Setting> read_settings(const io::YamlNode& node, const std::string& what) {
  std::vector<Setting> settings;
  if (!node.is_map()) {
    node.error(what + ": expected keys with values");
    return settings;
  }
  for (const auto& item : node.raw()) {
    const io::YamlNode value(item.second, node.file(), node.diagnostics());
    settings.push_back({item.first.Scalar(), value.text(item.first.Scalar()), value.position()});
  }
  return settings;
}

io::Key picture_size_key(const std::array<int, 2>& otherwise, const std::string& sentence) {
  return {.name = "size",
          .type = io::KeyType::numbers,
          .unit = "px",
          .otherwise = io::Told{"`[" + std::to_string(otherwise[0]) + ", " +
                                std::to_string(otherwise[1]) + "]`"},
          .bounds = picture_sizes,
          .form = "two whole ones",
          .sentence = sentence};
}

void read_picture_size(io::DescribedMap& map, std::array<int, 2>& size) {
  const auto node = map.optional("size");
  if (!node) return;
  const io::Bounds& bounds = map.key("size").bounds;
  const auto parts = node->list("size");
  if (parts.size() != 2) return node->error("size: expected [width, height] in pixels");
  for (std::size_t i = 0; i < 2; ++i)
    size[i] = parts[i].integer("size", static_cast<int>(bounds.minimum),
                               static_cast<int>(bounds.maximum));
}

Anchor read_anchor(const io::YamlNode& node, const std::string& what) {
  io::DescribedMap map(node, thing_keys(), what);
  Anchor anchor{Anchor::Kind::none, "", node.position()};
  const std::pair<const char*, Anchor::Kind> kinds[] = {{"fruit", Anchor::Kind::fruit},
                                                        {"body", Anchor::Kind::body},
                                                        {"plant", Anchor::Kind::plant},
                                                        {"tool", Anchor::Kind::tool}};
  for (const auto& [key, kind] : kinds) {
    const auto name = map.optional(key);
    if (!name) continue;
    if (anchor.kind != Anchor::Kind::none) node.error(what + ": expected one thing only");
    anchor.kind = kind;
    anchor.name = name->text(key);
  }
  if (node.is_map() && anchor.kind == Anchor::Kind::none)
    node.error(what + ": expected {fruit: NAME}, {body: NAME}, {plant: NAME} or {tool: true}");
  map.finish();
  return anchor;
}

Vec3 read_place(io::DescribedMap& map, const std::string& key) {
  const io::Bounds& bounds = map.key(key).bounds;
  const Vec3 place = map.vector(key);
  if (!(place.cwiseAbs().maxCoeff() <= bounds.maximum))
    map.optional(key)->error(key + ": expected three numbers, each " +
                             io::bounds_text(bounds).substr(9) + ", in m");
  return place;
}

Pose read_pose(io::DescribedMap& map) {
  Pose pose;
  pose.position = read_place(map, "position");
  pose.rotation = map.quaternion("orientation");
  return pose;
}

}  // namespace pedicel::world::sections
