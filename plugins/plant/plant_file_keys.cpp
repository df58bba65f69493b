#include "plugins/plant/plant_file_keys.h"

#include <type_traits>

#include "plugins/plant/effect_reader.h"
#include "plugins/plant/model/plant_model.h"

namespace pedicel::plant {

namespace {

using io::Key;
using io::KeyType;
using io::Told;

/// A key of the model as keys of files are described.
template <typename Owner>
Key described(const PlantKey<Owner>& key) {
  Key file{.name = std::string(key.name), .sentence = std::string(key.sentence)};
  const auto add = [&](auto member) {
    using Member = decltype(member);
    if constexpr (std::is_same_v<Member, double Owner::*> ||
                  std::is_same_v<Member, std::optional<double> Owner::*>) {
      file.unit = key.unit;
      file.bounds = key.bounds;
      if (std::is_same_v<Member, std::optional<double> Owner::*>) file.otherwise = Told{"none"};
      if (key.otherwise) file.otherwise = *key.otherwise;
    } else if constexpr (std::is_same_v<Member, Vec3 Owner::*> ||
                         std::is_same_v<Member, std::optional<Vec3> Owner::*>) {
      file.type = KeyType::vector;
      file.unit = "1";
      file.form = "not zero";
      if (std::is_same_v<Member, std::optional<Vec3> Owner::*>) file.otherwise = Told{"none"};
    } else if constexpr (std::is_same_v<Member, std::string Owner::*>) {
      file.type = KeyType::text;
    } else {
      file.type = KeyType::word;
      file.words.assign(member.words.begin(), member.words.end());
      file.otherwise = file.words.front();
    }
  };
  std::visit(add, key.member);
  return file;
}

template <typename Owner, typename Keys>
void add_described(std::vector<Key>& all, const Keys& keys) {
  for (const PlantKey<Owner>& key : keys) all.push_back(described(key));
}

/// `otherwise` in place of what stands there.
void tell(std::vector<Key>& keys, std::string_view name, const char* otherwise) {
  for (Key& key : keys)
    if (key.name == name) key.otherwise = Told{otherwise};
}

Key name_key(const char* what) {
  return {.name = "name",
          .type = KeyType::text,
          .form = "once",
          .sentence = std::string("name of the ") + what};
}

Key part_key(const char* name, KeyType type, const char* otherwise, const char* sentence) {
  return {.name = name, .type = type, .otherwise = Told{otherwise}, .sentence = sentence};
}

std::vector<Key> keys_of_plant() {
  std::vector<Key> keys = {
      io::format_key("pedicel-plant"),
      io::version_key(),
      {.name = "name", .type = KeyType::text, .sentence = "name of the plant"}};
  add_described<PlantFile>(keys, plant_keys);
  const std::vector<Key> more = {
      part_key("material", KeyType::map, "none", "defaults for every curve, see below"),
      {.name = "sampling", .type = KeyType::map, .sentence = "how curves become rods"},
      {.name = "root",
       .type = KeyType::vector,
       .unit = "m",
       .sentence = "the curve end that is nearest is clamped"},
      part_key("supports", KeyType::list, "none", "places that are clamped, too"),
      {.name = "curves", .type = KeyType::list, .sentence = "stems, branches and stalks"},
      part_key("fruits", KeyType::list, "none", "spheres on curves"),
      part_key("leaves", KeyType::list, "none", "blades on curves"),
      part_key("masses", KeyType::list, "none", "point masses on curves"),
      part_key("effects", KeyType::list, "none", "extensions of the model: [Effects](effects.md)")};
  keys.insert(keys.end(), more.begin(), more.end());
  return keys;
}

std::vector<Key> keys_of_material() {
  std::vector<Key> keys;
  add_described<MaterialValues>(keys, material_keys);
  for (Key& key : keys) key.otherwise = Told{"the plant's"};
  keys.push_back(
      part_key("known_to", KeyType::map, "none", "how well the numbers are known, see below"));
  return keys;
}

std::vector<Key> keys_of_known_to() {
  std::vector<Key> keys;
  for (const MaterialKey& key : material_keys)
    if (key.known_to)
      keys.push_back({.name = std::string(key.name),
                      .unit = "1",
                      .otherwise = Told{"not said"},
                      .bounds = io::positive,
                      .sentence = "relative standard deviation of that number: 0.1 is 10 %"});
  return keys;
}

std::vector<Key> keys_of_curve() {
  std::vector<Key> keys = {name_key("curve")};
  add_described<PlantCurve>(keys, curve_keys);
  keys.push_back({.name = "points",
                  .type = KeyType::list,
                  .unit = "m",
                  .form = "two or more `[x, y, z]`",
                  .sentence = "control points"});
  keys.push_back({.name = "radius",
                  .type = KeyType::numbers,
                  .unit = "m",
                  .otherwise = Told{"needed but for a rectangle"},
                  .bounds = io::positive,
                  .form = "one number, or one a point",
                  .sentence = "linear in arc length between points"});
  keys.push_back(part_key("section", KeyType::map, "a circle", "cross-section"));
  keys.push_back(
      part_key("material", KeyType::map, "the plant's", "overrides of the plant's material"));
  return keys;
}

std::vector<Key> keys_of_section() {
  std::vector<Key> keys;
  add_described<SectionShape>(keys, section_keys);
  tell(keys, "ratio", "needed for an ellipse");
  tell(keys, "width", "needed for a rectangle");
  tell(keys, "height", "needed for a rectangle");
  tell(keys, "normal", "needed but for a circle");
  return keys;
}

std::vector<Key> keys_of_fruit() {
  std::vector<Key> keys = {name_key("fruit")};
  add_described<PlantFruit>(keys, fruit_keys);
  keys.push_back(part_key("detach", KeyType::map, "none", "when it comes off"));
  return keys;
}

std::vector<Key> keys_of_leaf() {
  std::vector<Key> keys = {name_key("leaf")};
  add_described<PlantLeaf>(keys, leaf_keys);
  tell(keys, "direction", "along the stem");
  return keys;
}

template <typename Owner, typename Keys>
std::vector<Key> all_described(const Keys& keys) {
  std::vector<Key> all;
  add_described<Owner>(all, keys);
  return all;
}

}  // namespace

const io::KeyList& plant_list() {
  static const io::KeyList keys{"plant", "a plant file", keys_of_plant()};
  return keys;
}

const io::KeyList& sampling_list() {
  static const io::KeyList keys{"sampling", "sampling", all_described<PlantFile>(sampling_keys),
                                "sampling"};
  return keys;
}

const io::KeyList& material_list() {
  static const io::KeyList keys{"material", "material", keys_of_material()};
  return keys;
}

const io::KeyList& known_to_list() {
  static const io::KeyList keys{"known_to", "known_to", keys_of_known_to()};
  return keys;
}

const io::KeyList& curve_list() {
  static const io::KeyList keys{"curve", "a curve", keys_of_curve()};
  return keys;
}

const io::KeyList& section_list() {
  static const io::KeyList keys{"section", "section", keys_of_section()};
  return keys;
}

const io::KeyList& support_list() {
  static const io::KeyList keys{"support", "a support", {}, "", {&place_keys()}};
  return keys;
}

const io::KeyList& fruit_list() {
  static const io::KeyList keys{"fruit", "a fruit", keys_of_fruit(), "", {&place_keys()}};
  return keys;
}

const io::KeyList& detach_list() {
  static const io::KeyList keys{"detach", "detach", all_described<DetachLimits>(detach_keys)};
  return keys;
}

const io::KeyList& leaf_list() {
  static const io::KeyList keys{"leaf", "a leaf", keys_of_leaf(), "", {&place_keys()}};
  return keys;
}

const io::KeyList& mass_list() {
  static const io::KeyList keys{
      "mass", "a mass", all_described<PlantMass>(mass_keys), "", {&place_keys()}};
  return keys;
}

std::vector<const io::KeyList*> plant_file_keys() {
  return {&plant_list(),  &sampling_list(), &material_list(), &known_to_list(),
          &curve_list(),  &section_list(),  &place_keys(),    &fruit_list(),
          &detach_list(), &leaf_list(),     &mass_list()};
}

}  // namespace pedicel::plant
