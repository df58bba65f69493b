#include "pedicel/io/asset_folder.h"
#include "pedicel/io/yaml.h"
#include "pedicel/plant/effect_reader.h"
#include "pedicel/plant/plant_file.h"
#include "pedicel/plant/plant_numbers.h"
#include "pedicel/plant/plant_size.h"

namespace pedicel::plant {

namespace {

using io::YamlMap;
using io::YamlNode;

std::optional<double> optional_number(YamlMap& map, const std::string& key,
                                      const io::Bounds& bounds) {
  const auto node = map.optional(key);
  if (!node) return std::nullopt;
  return node->number(key, bounds);
}

// Every number of a group that plant_numbers() describes.
template <typename Group>
void read_numbers(YamlMap& map, Group& group) {
  for_numbers_of<Group>([&](const PlantNumber& number, auto member) {
    group.*member = optional_number(map, std::string(number.name()), number.bounds);
  });
}

// A direction: its length does not count, but it must have one.
Vec3 direction(const YamlNode& node, const std::string& what) {
  const Vec3 value = node.vector(what);
  if (node.is_list() && node.raw().size() == 3 && value.norm() < 1.0e-9)
    node.error(what + " has length 0, expected a direction [x, y, z]");
  return value;
}

MaterialKnowledge read_known_to(const YamlNode& node) {
  YamlMap map(node, "known_to");
  MaterialKnowledge known;
  known.youngs_modulus = optional_number(map, "youngs_modulus", io::positive);
  known.density = optional_number(map, "density", io::positive);
  known.damping_time = optional_number(map, "damping_time", io::positive);
  map.finish();
  return known;
}

MaterialValues read_material(const YamlNode& node) {
  YamlMap map(node, "material");
  MaterialValues material;
  read_numbers(map, material);
  if (const auto known_to = map.optional("known_to")) material.known_to = read_known_to(*known_to);
  map.finish();
  return material;
}

SectionShape read_section(const YamlNode& node) {
  YamlMap map(node, "section");
  SectionShape section;
  const std::string kind = map.choice("kind", {"circle", "ellipse", "rectangle"}, "circle");
  if (kind == "ellipse") {
    section.kind = SectionKind::ellipse;
    section.ratio = map.number("ratio", {0.0, 1.0, true});
  } else if (kind == "rectangle") {
    section.kind = SectionKind::rectangle;
    section.width = map.number("width", io::positive);
    section.height = map.number("height", io::positive);
  }
  if (section.kind != SectionKind::circle)
    if (const auto normal = map.required("normal")) section.normal = direction(*normal, "normal");
  map.finish();
  return section;
}

PlantCurve read_curve(const YamlNode& node) {
  YamlMap map(node, "a curve");
  PlantCurve curve;
  curve.where = node.position();
  curve.name = map.text("name");
  curve.interpolation = map.choice("interpolation", {"smooth", "linear"}, "smooth") == "linear"
                            ? Interpolation::linear
                            : Interpolation::smooth;
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
  read_numbers(map, limits);
  map.finish();
  return limits;
}

PlantFruit read_fruit(const YamlNode& node) {
  YamlMap map(node, "a fruit");
  PlantFruit fruit;
  fruit.where = node.position();
  fruit.name = map.text("name");
  fruit.place = read_place(map);
  fruit.radius = map.number("radius", io::positive);
  fruit.density = map.number("density", io::positive);
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
  leaf.leaf_template = map.text("template");
  leaf.size = map.number("size", io::positive);
  if (const auto normal = map.required("normal")) leaf.normal = direction(*normal, "normal");
  if (const auto along = map.optional("direction")) leaf.direction = direction(*along, "direction");
  map.finish();
  return leaf;
}

PlantMass read_mass(const YamlNode& node) {
  YamlMap map(node, "a mass");
  PlantMass mass;
  mass.place = read_place(map);
  mass.mass = map.number("mass", io::positive);
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
  plant.shape =
      map.choice("shape", {"drawn", "rest"}, "drawn") == "rest" ? Shape::rest : Shape::drawn;
  plant.look =
      map.choice("look", {"tomato", "apple"}, "tomato") == "apple" ? Look::apple : Look::tomato;
  if (const auto material = map.optional("material")) plant.material = read_material(*material);
  if (const auto sampling = map.required("sampling")) {
    YamlMap inner(*sampling, "sampling");
    plant.connect = inner.number("connect", number_bounds("sampling.connect"));
    plant.distance = inner.number("distance", number_bounds("sampling.distance"));
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
