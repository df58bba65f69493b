#include <algorithm>
#include <type_traits>

#include "engine/io/asset_folder.h"
#include "engine/io/described_map.h"
#include "plugins/plant/effect_reader.h"
#include "plugins/plant/plant_file.h"
#include "plugins/plant/plant_file_keys.h"
#include "plugins/plant/plant_size.h"

namespace pedicel::plant {

namespace {

using io::DescribedMap;
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
void read_key(DescribedMap& map, const PlantKey<Owner>& key, Owner& owner) {
  const std::string name(key.name);
  const auto read = [&](auto member) {
    using Member = decltype(member);
    if constexpr (std::is_same_v<Member, double Owner::*>) {
      owner.*member = key.otherwise ? map.number(name) : map.required_number(name);
    } else if constexpr (std::is_same_v<Member, std::optional<double> Owner::*>) {
      owner.*member = map.optional_number(name);
    } else if constexpr (std::is_same_v<Member, Vec3 Owner::*>) {
      if (const auto node = map.required(name)) owner.*member = direction(*node, name);
    } else if constexpr (std::is_same_v<Member, std::optional<Vec3> Owner::*>) {
      if (const auto node = map.optional(name)) owner.*member = direction(*node, name);
    } else if constexpr (std::is_same_v<Member, std::string Owner::*>) {
      owner.*member = map.text(name);
    } else {
      const std::vector<std::string>& words = map.key(name).words;
      const std::string word = map.choice(name);
      member.set(owner, static_cast<int>(std::ranges::find(words, word) - words.begin()));
    }
  };
  std::visit(read, key.member);
}

template <typename Owner, typename Keys>
void read_keys(DescribedMap& map, const Keys& keys, Owner& owner) {
  for (const PlantKey<Owner>& key : keys)
    if (!key.stands || key.stands(owner)) read_key(map, key, owner);
}

MaterialKnowledge read_known_to(const YamlNode& node) {
  DescribedMap map(node, known_to_list());
  MaterialKnowledge known;
  for (const MaterialKey& key : material_keys) {
    if (!key.known_to) continue;
    const std::string name(key.name);
    known.*key.known_to = map.optional_number(name);
  }
  map.finish();
  return known;
}

MaterialValues read_material(const YamlNode& node) {
  DescribedMap map(node, material_list());
  MaterialValues material;
  read_keys(map, material_keys, material);
  if (const auto known_to = map.optional("known_to")) material.known_to = read_known_to(*known_to);
  map.finish();
  return material;
}

SectionShape read_section(const YamlNode& node) {
  DescribedMap map(node, section_list());
  SectionShape section;
  read_keys(map, section_keys, section);
  map.finish();
  return section;
}

PlantCurve read_curve(const YamlNode& node) {
  DescribedMap map(node, curve_list());
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
      curve.radius = radius->numbers("radius", map.key("radius").bounds);
    } else {
      curve.radius = {radius->number("radius", map.key("radius").bounds)};
    }
  }
  if (const auto material = map.optional("material")) curve.material = read_material(*material);
  map.finish();
  return curve;
}

DetachLimits read_limits(const YamlNode& node) {
  DescribedMap map(node, detach_list());
  DetachLimits limits;
  read_keys(map, detach_keys, limits);
  map.finish();
  return limits;
}

PlantFruit read_fruit(const YamlNode& node) {
  DescribedMap map(node, fruit_list());
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
  DescribedMap map(node, leaf_list());
  PlantLeaf leaf;
  leaf.where = node.position();
  leaf.name = map.text("name");
  leaf.place = read_place(map);
  read_keys(map, leaf_keys, leaf);
  map.finish();
  return leaf;
}

PlantMass read_mass(const YamlNode& node) {
  DescribedMap map(node, mass_list());
  PlantMass mass;
  mass.place = read_place(map);
  read_keys(map, mass_keys, mass);
  map.finish();
  return mass;
}

CurvePlace read_support(const YamlNode& node) {
  DescribedMap map(node, support_list());
  const CurvePlace place = read_place(map);
  map.finish();
  return place;
}

PlantFile read_plant(DescribedMap& map) {
  PlantFile plant;
  plant.where = map.position();
  plant.name = map.text("name");
  read_keys(map, plant_keys, plant);
  if (const auto material = map.optional("material")) plant.material = read_material(*material);
  if (const auto sampling = map.required("sampling")) {
    DescribedMap inner(*sampling, sampling_list());
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
  DescribedMap map(node, plant_list());
  if (!node.is_map() || !map.has_format()) return std::nullopt;
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
