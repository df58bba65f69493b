#include "pedicel/io/thing_bounds.h"
#include "pedicel/world/scene_sections.h"

namespace pedicel::world::sections {

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

Anchor read_anchor(const io::YamlNode& node, const std::string& what) {
  io::YamlMap map(node, what);
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

Vec3 read_place(io::YamlMap& map, const std::string& key, std::optional<Vec3> otherwise) {
  const Vec3 place = otherwise ? map.vector(key, *otherwise) : map.vector(key);
  if (!(place.cwiseAbs().maxCoeff() <= io::place_bounds.maximum))
    map.optional(key)->error(key + ": expected three numbers, each " +
                             io::bounds_text(io::place_bounds).substr(9) + ", in m");
  return place;
}

Pose read_pose(io::YamlMap& map) {
  Pose pose;
  pose.position = read_place(map, "position", Vec3::Zero());
  pose.rotation = map.quaternion("orientation", Quat::Identity());
  return pose;
}

}  // namespace pedicel::world::sections
