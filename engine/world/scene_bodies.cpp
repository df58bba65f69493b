#include "pedicel/io/thing_bounds.h"
#include "pedicel/io/yaml_words.h"
#include "pedicel/world/scene_sections.h"

namespace pedicel::world::sections {

namespace {

Vec3 read_size(const io::YamlNode& node, const std::string& what) {
  const Vec3 size = node.vector(what);
  if (!(size.minCoeff() > 0.0 && size.maxCoeff() <= io::extent_bounds.maximum))
    node.error(what + ": expected three numbers > 0 and at most " +
               io::yaml_number(io::extent_bounds.maximum) + ", in m");
  return size;
}

BodyPart read_round(const io::YamlNode& node, BodyPart::Kind kind, const std::string& what) {
  BodyPart part;
  part.kind = kind;
  io::YamlMap map(node, what);
  part.radius = map.number("radius", io::extent_bounds);
  if (kind != BodyPart::Kind::sphere) part.length = map.number("length", io::extent_bounds);
  map.finish();
  return part;
}

std::vector<BodyPart> read_tray(const io::YamlNode& node) {
  io::YamlMap map(node, "tray");
  const auto size_node = map.required("size");
  const Vec3 size = size_node ? read_size(*size_node, "size") : Vec3::Ones();
  const double wall = map.number("wall", io::extent_bounds);
  map.finish();
  if (2.0 * wall >= size.minCoeff()) map.error("tray: expected walls thinner than half its size");
  return tray_parts(size, wall);
}

std::vector<BodyPart> read_shape(io::YamlMap& map) {
  std::vector<BodyPart> parts;
  int shapes = 0;
  if (const auto box = map.optional("box")) {
    parts.emplace_back().half_extents = 0.5 * read_size(*box, "box");
    ++shapes;
  }
  const std::pair<const char*, BodyPart::Kind> round[] = {{"sphere", BodyPart::Kind::sphere},
                                                          {"cylinder", BodyPart::Kind::cylinder},
                                                          {"capsule", BodyPart::Kind::capsule}};
  for (const auto& [key, kind] : round) {
    const auto node = map.optional(key);
    if (!node) continue;
    parts.push_back(read_round(*node, kind, key));
    ++shapes;
  }
  if (const auto tray = map.optional("tray")) {
    parts = read_tray(*tray);
    ++shapes;
  }
  if (map.node().is_map() && shapes != 1)
    map.error("a body: expected exactly one of box, sphere, cylinder, capsule and tray");
  return parts;
}

}  // namespace

BodyDescription read_body(const io::YamlNode& node) {
  BodyDescription body;
  io::YamlMap map(node, "a body");
  body.name = map.text("name");
  body.parts = read_shape(map);
  body.mass = map.number("mass", io::mass_bounds, 0.0);
  body.pose = read_pose(map);
  body.friction = map.number("friction", io::not_negative, body.friction);
  body.restitution = map.number("restitution", io::fraction, body.restitution);
  body.look = map.choice("look", body_looks(), body.look);
  map.finish();
  return body;
}

GroundPlane read_ground(const io::YamlNode& node) {
  GroundPlane ground;
  io::YamlMap map(node, "ground");
  ground.height = map.number("height", io::place_bounds, 0.0);
  ground.friction = map.number("friction", io::not_negative, ground.friction);
  ground.restitution = map.number("restitution", io::fraction, ground.restitution);
  map.finish();
  return ground;
}

}  // namespace pedicel::world::sections
