#include "plugins/plant/organ_edit.h"

#include <cmath>

#include "engine/core/check.h"
#include "engine/io/csv.h"
#include "plugins/plant/plant_edit.h"
#include "plugins/plant/plant_edit_parts.h"

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

// A number that its owner has to have is told as one above 0, where it has no other bounds.
template <typename Owner>
double within_bounds(const PlantKey<Owner>& key, double value) {
  const io::Bounds& bounds = key.bounds;
  const bool needed = std::holds_alternative<double Owner::*>(key.member) && !key.otherwise;
  if (needed && bounds.open_minimum && bounds.minimum == 0.0 && std::isinf(bounds.maximum))
    return above_zero(std::string(key.name), value);
  if (io::within(value, bounds) && std::isfinite(value)) return value;
  throw UsageError(std::string(key.name) + " = " + io::format_number(value) + ", expected " +
                   io::bounds_text(bounds));
}

// Every number that it has.
template <typename Owner, typename Keys>
void check_numbers(const Keys& keys, const Owner& owner) {
  for (const PlantKey<Owner>& key : keys)
    if (const auto value = number_of(owner, key)) within_bounds(key, *value);
}

// The key of a number of that name; null where there is none.
template <typename Keys>
auto find_number(const Keys& keys, const std::string& name) {
  const auto* key = find_key(keys, name);
  return key && key->is_number() ? key : nullptr;
}

// 0 takes a number away that need not be there, where 0 is none that it can be.
template <typename Owner>
void set_checked(Owner& owner, const PlantKey<Owner>& key, double value) {
  const bool may_be_absent = std::holds_alternative<std::optional<double> Owner::*>(key.member);
  if (may_be_absent && value == 0.0 && !io::within(0.0, key.bounds))
    set_number_of(owner, key, std::nullopt);
  else
    set_number_of(owner, key, within_bounds(key, value));
}

void check_place(const PlantFile& plant, const CurvePlace& place) {
  find_stem(plant, place.curve);
  check_fraction(place.at);
}

void set_fruit(PlantFruit& fruit, const std::string& key, double value) {
  if (const auto* own = find_number(fruit_keys, key))
    set_checked(fruit, *own, value);
  else if (const auto* limit = find_number(detach_keys, key))
    set_checked(fruit.detach, *limit, value);
  else
    throw UsageError("\"" + key + "\" of a fruit, expected one of: " + number_names(fruit_keys) +
                     ", " + number_names(detach_keys));
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
  check_numbers(fruit_keys, fruit);
  check_numbers(detach_keys, fruit.detach);
  plant.fruits.push_back(std::move(fruit));
}

void add_leaf(PlantFile& plant, PlantLeaf leaf) {
  check_free(plant, leaf.name);
  check_place(plant, leaf.place);
  check_numbers(leaf_keys, leaf);
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
  const auto* own = find_number(leaf_keys, key);
  if (!own)
    throw UsageError("\"" + key + "\" of a leaf, expected " + number_names(leaf_keys, " or "));
  set_checked(*leaf, *own, value);
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
  const PlantMass one{{stem, at, {}}, mass};
  check_numbers(mass_keys, one);
  plant.masses.push_back(one);
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
  const MaterialKey* number = find_key(material_keys, key);
  if (!number)
    throw UsageError("\"" + key +
                     "\" of a material, expected one of: " + number_names(material_keys));
  // The plant's own is needed, where a stem's may be taken away.
  if (stem.empty())
    set_number_of<MaterialValues>(material, *number, within_bounds<MaterialValues>(*number, value));
  else
    set_checked<MaterialValues>(material, *number, value);
}

void set_sampling(PlantFile& plant, const std::string& key, double value) {
  const auto* number = find_number(sampling_keys, key);
  if (!number)
    throw UsageError("\"" + key + "\" of the sampling, expected " +
                     number_names(sampling_keys, " or "));
  set_checked(plant, *number, value);
}

}  // namespace pedicel::plant
