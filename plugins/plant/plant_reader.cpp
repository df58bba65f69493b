#include <algorithm>
#include <type_traits>

#include "pedicel/io/asset_folder.h"
#include "pedicel/io/yaml.h"
#include "pedicel/plant/effect_reader.h"
#include "pedicel/plant/plant_file.h"
#include "pedicel/plant/plant_size.h"

namespace pedicel::plant {

namespace {

using io::YamlMap;
using io::YamlNode;

// A direction: its length does not count, but it must have one.
Vec3 direction(const YamlNode& node, const std::string& what) {
  const Vec3 value = node.vector(what);
  if (node.is_list() && node.raw().size() == 3 && value.norm() < 1.0e-9)
    node.error(what + " has length 0, expected a direction [x, y, z]");
  return value;
}

// One key after the other, as its description says: those that its owner does not have are left
// for finish() to refuse.
template <typename Owner>
void read_key(YamlMap& map, const PlantKey<Owner>& key, Owner& owner) {
  const std::string name(key.name);
  const auto read = [&](auto member) {
    using Member = decltype(member);
    if constexpr (std::is_same_v<Member, double Owner::*>) {
      owner.*member = key.otherwise ? map.number(name, key.bounds, *key.otherwise)
                                    : map.number(name, key.bounds);
    } else if constexpr (std::is_same_v<Member, std::optional<double> Owner::*>) {
      if (const auto node = map.optional(name)) owner.*member = node->number(name, key.bounds);
    } else if constexpr (std::is_same_v<Member, Vec3 Owner::*>) {
      if (const auto node = map.required(name)) owner.*member = direction(*node, name);
    } else if constexpr (std::is_same_v<Member, std::optional<Vec3> Owner::*>) {
      if (const auto node = map.optional(name)) owner.*member = direction(*node, name);
    } else if constexpr (std::is_same_v<Member, std::string Owner::*>) {
      owner.*member = map.text(name);
    } else {
      const std::vector<std::string> words(member.words.begin(), member.words.end());
      const std::string word = map.choice(name, words, words.front());
      member.set(owner, static_cast<int>(std::ranges::find(words, word) - words.begin()));
    }
  };
  std::visit(read, key.member);
}

template <typename Owner, typename Keys>
void read_keys(YamlMap& map, const Keys& keys, Owner& owner) {
  for (const PlantKey<Owner>& key : keys)
    if (!key.stands || key.stands(owner)) read_key(map, key, owner);
}

MaterialKnowledge read_known_to(const YamlNode& node) {
  YamlMap map(node, "known_to");
  MaterialKnowledge known;
  for (const MaterialKey& key : material_keys) {
    if (!key.known_to) continue;
    const std::string name(key.name);
    if (const auto given = map.optional(name))
      known.*key.known_to = given->number(name, io::positive);
  }
  map.finish();
  return known;
}

MaterialValues read_material(const YamlNode& node) {
  YamlMap map(node, "material");
  MaterialValues material;
  read_keys(map, material_keys, material);
  if (const auto known_to = map.optional("known_to")) material.known_to = read_known_to(*known_to);
  map.finish();
  return material;
}

SectionShape read_section(const YamlNode& node) {
  YamlMap map(node, "section");
  SectionShape section;
  read_keys(map, section_keys, section);
  map.finish();
  return section;
}

PlantCurve read_curve(const YamlNode& node) {
  YamlMap map(node, "a curve");
  PlantCurve curve;
  curve.where = node.position();
  curve.name = map.text("name");
  read_keys(map, curve_keys, curve);
  if (const auto points = map.required("points"))
    for (const YamlNode& point : points->list("points"))
      curve.points.push_back(point.vector("point " + std::to_string(curve.points.size() + 1)));
  if (const auto section = map.optional("section")) curve.section = read_section(*section);
  const bool needed = curve.section.kind != SectionKind::rectangle;
  if (const auto radius = needed ? map.required("radius") : map.optional("radius")) {
    if (radius->is_list()) {
      curve.radius = radius->numbers("radius", io::positive);
    } else {
      curve.radius = {radius->number("radius", io::positive)};
    }
  }
  if (const auto material = map.optional("material")) curve.material = read_material(*material);
  map.finish();
  return curve;
}

DetachLimits read_limits(const YamlNode& node) {
  YamlMap map(node, "detach");
  DetachLimits limits;
  read_keys(map, detach_keys, limits);
  map.finish();
  return limits;
}

PlantFruit read_fruit(const YamlNode& node) {
  YamlMap map(node, "a fruit");
  PlantFruit fruit;
  fruit.where = node.position();
  fruit.name = map.text("name");
  fruit.place = read_place(map);
  read_keys(map, fruit_keys, fruit);
  if (const auto detach = map.optional("detach")) fruit.detach = read_limits(*detach);
  map.finish();
  return fruit;
}

PlantLeaf read_leaf(const YamlNode& node) {
  YamlMap map(node, "a leaf");
  PlantLeaf leaf;
  leaf.where = node.position();
  leaf.name = map.text("name");
  leaf.place = read_place(map);
  read_keys(map, leaf_keys, leaf);
  map.finish();
  return leaf;
}

PlantMass read_mass(const YamlNode& node) {
  YamlMap map(node, "a mass");
  PlantMass mass;
  mass.place = read_place(map);
  read_keys(map, mass_keys, mass);
  map.finish();
  return mass;
}

CurvePlace read_support(const YamlNode& node) {
  YamlMap map(node, "a support");
  const CurvePlace place = read_place(map);
  map.finish();
  return place;
}

PlantFile read_plant(YamlMap& map) {
  PlantFile plant;
  plant.where = map.position();
  plant.name = map.text("name");
  read_keys(map, plant_keys, plant);
  if (const auto material = map.optional("material")) plant.material = read_material(*material);
  if (const auto sampling = map.required("sampling")) {
    YamlMap inner(*sampling, "sampling");
    read_keys(inner, sampling_keys, plant);
    inner.finish();
  }
  plant.root = map.vector("root");
  for (const YamlNode& item : map.list("supports")) plant.supports.push_back(read_support(item));
  if (const auto curves = map.required("curves"))
    for (const YamlNode& item : curves->list("curves")) plant.curves.push_back(read_curve(item));
  for (const YamlNode& item : map.list("fruits")) plant.fruits.push_back(read_fruit(item));
  for (const YamlNode& item : map.list("leaves")) plant.leaves.push_back(read_leaf(item));
  for (const YamlNode& item : map.list("masses")) plant.masses.push_back(read_mass(item));
  for (const YamlNode& item : map.list("effects"))
    plant.effects.push_back(read_effect(item, effects::EffectFile::plant));
  map.finish();
  return plant;
}

std::optional<PlantFile> read(const YamlNode& node) {
  Diagnostics& diagnostics = node.diagnostics();
  const int before = diagnostics.error_count();
  YamlMap map(node, "a plant file");
  if (!node.is_map() || !io::check_format(map, "pedicel-plant", 1)) return std::nullopt;
  PlantFile plant = read_plant(map);
  // Values that were refused come back as zeros: checking those would only repeat the faults.
  if (diagnostics.error_count() == before) check_plant(plant, diagnostics);
  if (diagnostics.error_count() > before) return std::nullopt;
  return plant;
}

}  // namespace

std::optional<PlantFile> parse_plant(const std::string& text, const std::string& name,
                                     Diagnostics& diagnostics) {
  const int before = diagnostics.error_count();
  try {
    const YamlNode node = io::parse_yaml(text, name, diagnostics);
    auto plant = read(node);
    return diagnostics.error_count() > before ? std::nullopt : plant;
  } catch (const InvalidFile& fault) {
    diagnostics.add(fault);
    return std::nullopt;
  }
}

SearchPath leaf_folders_of(const std::filesystem::path& folder) {
  SearchPath folders{folder, folder / "../assets/leaves"};
  if (const auto assets = io::asset_folder(); !assets.empty()) folders.push_back(assets / "leaves");
  return folders;
}

std::optional<PlantFile> read_plant_file(const std::filesystem::path& path,
                                         Diagnostics& diagnostics) {
  const int before = diagnostics.error_count();
  try {
    const YamlNode node = io::load_yaml(path, diagnostics);
    auto plant = read(node);
    if (!plant || diagnostics.error_count() > before) return std::nullopt;
    plant->leaf_folders = leaf_folders_of(path.parent_path());
    warn_of_size(*plant, diagnostics);
    return plant;
  } catch (const InvalidFile& fault) {
    diagnostics.add(fault);
    return std::nullopt;
  }
}

}  // namespace pedicel::plant
