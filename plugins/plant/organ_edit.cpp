#include "pedicel/plant/organ_edit.h"

#include <cmath>

#include "pedicel/core/check.h"
#include "pedicel/io/csv.h"
#include "pedicel/plant/plant_edit.h"
#include "pedicel/plant/plant_edit_parts.h"
#include "pedicel/plant/plant_numbers.h"

namespace pedicel::plant {

namespace {

template <typename Item>
Item* find(std::vector<Item>& items, const std::string& name) {
  for (Item& item : items)
    if (item.name == name) return &item;
  return nullptr;
}

[[noreturn]] void no_organ(const std::string& name) {
  throw UsageError("no fruit or leaf \"" + name + "\", expected one of this plant");
}

double above_zero(const std::string& what, double value) {
  if (value > 0.0 && std::isfinite(value)) return value;
  throw UsageError(what + " = " + io::format_number(value) + ", expected a number above 0");
}

double within_bounds(const PlantNumber& number, double value) {
  if (io::within(value, number.bounds) && std::isfinite(value)) return value;
  throw UsageError(std::string(number.name()) + " = " + io::format_number(value) + ", expected " +
                   io::bounds_text(number.bounds));
}

void check_place(const PlantFile& plant, const CurvePlace& place) {
  find_stem(plant, place.curve);
  check_fraction(place.at);
}

void set_fruit(PlantFruit& fruit, const std::string& key, double value) {
  if (key == "radius") {
    fruit.radius = above_zero(key, value);
  } else if (key == "density") {
    fruit.density = above_zero(key, value);
  } else if (const PlantNumber* limit = find_number_of<DetachLimits>(key)) {
    member_of(fruit.detach, *limit) =
        value == 0.0 ? std::nullopt : std::optional(within_bounds(*limit, value));
  } else {
    throw UsageError("\"" + key + "\" of a fruit, expected one of: radius, density, " +
                     names_of_numbers<DetachLimits>());
  }
}

template <typename Items>
void remove_number(Items& items, int index, const std::string& what) {
  if (index < 0 || index >= static_cast<int>(items.size()))
    throw UsageError(what + " " + std::to_string(index) + ", expected one of " +
                     std::to_string(items.size()) + " from 0 on");
  items.erase(items.begin() + index);
}

}  // namespace

void add_fruit(PlantFile& plant, PlantFruit fruit) {
  check_free(plant, fruit.name);
  check_place(plant, fruit.place);
  above_zero("radius", fruit.radius);
  above_zero("density", fruit.density);
  for_numbers_of<DetachLimits>([&](const PlantNumber& number, auto member) {
    if (const auto& limit = fruit.detach.*member) within_bounds(number, *limit);
  });
  plant.fruits.push_back(std::move(fruit));
}

void add_leaf(PlantFile& plant, PlantLeaf leaf) {
  check_free(plant, leaf.name);
  check_place(plant, leaf.place);
  above_zero("size", leaf.size);
  if (leaf.normal.norm() < 1.0e-9) throw UsageError("a normal of length 0, expected a direction");
  plant.leaves.push_back(std::move(leaf));
}

void remove_organ(PlantFile& plant, const std::string& name) {
  const auto is_it = [&](const auto& item) { return item.name == name; };
  if (std::erase_if(plant.fruits, is_it) + std::erase_if(plant.leaves, is_it) == 0) no_organ(name);
}

void place_organ(PlantFile& plant, const std::string& name, const std::string& stem, double at) {
  check_place(plant, {stem, at, {}});
  if (PlantFruit* fruit = find(plant.fruits, name))
    fruit->place = {stem, at, {}};
  else if (PlantLeaf* leaf = find(plant.leaves, name))
    leaf->place = {stem, at, {}};
  else
    no_organ(name);
}

void set_organ(PlantFile& plant, const std::string& name, const std::string& key, double value) {
  if (PlantFruit* fruit = find(plant.fruits, name)) return set_fruit(*fruit, key, value);
  PlantLeaf* leaf = find(plant.leaves, name);
  if (!leaf) no_organ(name);
  if (key != "size") throw UsageError("\"" + key + "\" of a leaf, expected size");
  leaf->size = above_zero(key, value);
}

void turn_leaf(PlantFile& plant, const std::string& name, const Vec3& normal,
               const Vec3& direction) {
  PlantLeaf* leaf = find(plant.leaves, name);
  if (!leaf) no_organ(name);
  if (normal.norm() < 1.0e-9) throw UsageError("a normal of length 0, expected a direction");
  leaf->normal = normal;
  leaf->direction = direction.norm() < 1.0e-9 ? std::nullopt : std::optional(direction);
}

void add_mass(PlantFile& plant, const std::string& stem, double at, double mass) {
  check_place(plant, {stem, at, {}});
  plant.masses.push_back({{stem, at, {}}, above_zero("mass", mass)});
}

void add_support(PlantFile& plant, const std::string& stem, double at) {
  check_place(plant, {stem, at, {}});
  plant.supports.push_back({stem, at, {}});
}

void remove_mass(PlantFile& plant, int index) {
  remove_number(plant.masses, index, "mass");
}

void remove_support(PlantFile& plant, int index) {
  remove_number(plant.supports, index, "support");
}

void set_material(PlantFile& plant, const std::string& stem, const std::string& key, double value) {
  MaterialValues& material =
      stem.empty() ? plant.material : plant.curves[find_stem(plant, stem)].material;
  const PlantNumber* number = find_number_of<MaterialValues>(key);
  if (!number)
    throw UsageError("\"" + key +
                     "\" of a material, expected one of: " + names_of_numbers<MaterialValues>());
  std::optional<double>& held = member_of(material, *number);
  // 0 takes a stem's own number away, where it is none that a material can have.
  if (!stem.empty() && value == 0.0 && !io::within(0.0, number->bounds))
    held.reset();
  else
    held = within_bounds(*number, value);
}

void set_sampling(PlantFile& plant, const std::string& key, double value) {
  if (key != "connect" && key != "distance")
    throw UsageError("\"" + key + "\" of the sampling, expected connect or distance");
  (key == "connect" ? plant.connect : plant.distance) = above_zero(key, value);
}

}  // namespace pedicel::plant
