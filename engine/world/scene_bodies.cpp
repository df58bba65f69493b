#include "engine/io/thing_bounds.h"
#include "engine/io/yaml_words.h"
#include "engine/world/scene_sections.h"

namespace pedicel::world::sections {

namespace {

using io::KeyType;
using io::Told;

const io::KeyList& body_list() {
  const Told shape{"one shape"};
  static const io::KeyList keys{
      "body",
      "a body",
      {{.name = "name", .type = KeyType::text, .form = "one line, once", .sentence = "its name"},
       {.name = "box",
        .type = KeyType::vector,
        .unit = "m",
        .otherwise = shape,
        .bounds = io::extent_bounds,
        .sentence = "edges of a box"},
       {.name = "sphere",
        .type = KeyType::map,
        .otherwise = shape,
        .form = "`{radius}`",
        .sentence = "a ball"},
       {.name = "cylinder",
        .type = KeyType::map,
        .otherwise = shape,
        .form = "`{radius, length}`",
        .sentence = "along Z"},
       {.name = "capsule",
        .type = KeyType::map,
        .otherwise = shape,
        .form = "`{radius, length}`",
        .sentence = "a cylinder with round ends; `length` without them"},
       {.name = "tray",
        .type = KeyType::map,
        .otherwise = shape,
        .form = "`{size, wall}`",
        .sentence = "an open box; its place is the middle of its lower face"},
       {.name = "mass",
        .unit = "kg",
        .otherwise = BodyDescription{}.mass,
        .bounds = io::mass_bounds,
        .sentence = "0: it does not move"},
       {.name = "friction",
        .unit = "1",
        .otherwise = BodyDescription{}.friction,
        .bounds = io::not_negative,
        .sentence = "Coulomb; two bodies' values are multiplied"},
       {.name = "restitution",
        .unit = "1",
        .otherwise = BodyDescription{}.restitution,
        .bounds = io::fraction,
        .sentence = "how much it bounces; two bodies have the product of theirs"},
       {.name = "look",
        .type = KeyType::word,
        .otherwise = BodyDescription{}.look,
        .words = body_looks(),
        .sentence = "how it is drawn"}},
      "",
      {&pose_keys()}};
  return keys;
}

/// Of a ball, which has no length, too.
const io::KeyList& round_list() {
  static const io::KeyList keys{"round",
                                "a round shape",
                                {{.name = "radius",
                                  .unit = "m",
                                  .bounds = io::extent_bounds,
                                  .sentence = "of a ball, cylinder or capsule"},
                                 {.name = "length",
                                  .unit = "m",
                                  .bounds = io::extent_bounds,
                                  .sentence = "of a cylinder or capsule"}}};
  return keys;
}

const io::KeyList& tray_list() {
  static const io::KeyList keys{"tray",
                                "tray",
                                {{.name = "size",
                                  .type = KeyType::vector,
                                  .unit = "m",
                                  .bounds = io::extent_bounds,
                                  .sentence = "outside of a tray"},
                                 {.name = "wall",
                                  .unit = "m",
                                  .bounds = io::extent_bounds,
                                  .form = "below half the size",
                                  .sentence = "thickness of a tray"}}};
  return keys;
}

const io::KeyList& ground_list() {
  static const io::KeyList keys{"ground",
                                "ground",
                                {{.name = "height",
                                  .unit = "m",
                                  .otherwise = GroundPlane{}.height,
                                  .bounds = io::place_bounds,
                                  .sentence = "where the plane lies"},
                                 {.name = "friction",
                                  .unit = "1",
                                  .otherwise = GroundPlane{}.friction,
                                  .bounds = io::not_negative,
                                  .sentence = "Coulomb"},
                                 {.name = "restitution",
                                  .unit = "1",
                                  .otherwise = GroundPlane{}.restitution,
                                  .bounds = io::fraction,
                                  .sentence = "how much bodies bounce on it, multiplied with "
                                              "theirs; 0: none does"}}};
  return keys;
}

Vec3 read_size(const io::YamlNode& node, const io::Key& key) {
  const Vec3 size = node.vector(key.name);
  if (!(size.minCoeff() > 0.0 && size.maxCoeff() <= key.bounds.maximum))
    node.error(key.name + ": expected three numbers > 0 and at most " +
               io::yaml_number(key.bounds.maximum) + ", in m");
  return size;
}

BodyPart read_round(const io::YamlNode& node, BodyPart::Kind kind, const std::string& what) {
  BodyPart part;
  part.kind = kind;
  io::DescribedMap map(node, round_list(), what);
  part.radius = map.number("radius");
  if (kind != BodyPart::Kind::sphere) part.length = map.number("length");
  map.finish();
  return part;
}

std::vector<BodyPart> read_tray(const io::YamlNode& node) {
  io::DescribedMap map(node, tray_list());
  const auto size_node = map.required("size");
  const Vec3 size = size_node ? read_size(*size_node, map.key("size")) : Vec3::Ones();
  const double wall = map.number("wall");
  map.finish();
  if (2.0 * wall >= size.minCoeff()) map.error("tray: expected walls thinner than half its size");
  return tray_parts(size, wall);
}

std::vector<BodyPart> read_shape(io::DescribedMap& map) {
  std::vector<BodyPart> parts;
  int shapes = 0;
  if (const auto box = map.optional("box")) {
    parts.emplace_back().half_extents = 0.5 * read_size(*box, map.key("box"));
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

std::vector<const io::KeyList*> body_keys() {
  return {&body_list(), &round_list(), &tray_list(), &ground_list()};
}

BodyDescription read_body(const io::YamlNode& node) {
  BodyDescription body;
  io::DescribedMap map(node, body_list());
  body.name = map.text("name");
  body.parts = read_shape(map);
  body.mass = map.number("mass");
  body.pose = read_pose(map);
  body.friction = map.number("friction");
  body.restitution = map.number("restitution");
  body.look = map.choice("look");
  map.finish();
  return body;
}

GroundPlane read_ground(const io::YamlNode& node) {
  GroundPlane ground;
  io::DescribedMap map(node, ground_list());
  ground.height = map.number("height");
  ground.friction = map.number("friction");
  ground.restitution = map.number("restitution");
  map.finish();
  return ground;
}

}  // namespace pedicel::world::sections
