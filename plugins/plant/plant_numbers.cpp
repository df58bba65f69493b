#include "plugins/plant/plant_numbers.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pedicel::plant {

namespace {

template <typename Owner, typename Keys>
void add_numbers(std::vector<PlantNumber>& all, const std::string& map, const Keys& keys,
                 bool restarts = false) {
  for (const PlantKey<Owner>& key : keys)
    if (key.is_number())
      all.push_back({map + "." + std::string(key.name), key.unit, key.bounds, key.slider.low,
                     key.slider.high, key.slider.logarithmic, restarts, key.sentence, &key});
}

// Curves of other tissue than the plant (a soft stalk on a woody stem) stay so much softer, lighter
// or calmer than it. Without a number of the plant to compare with, or with 0, there is no ratio.
void set_material(PlantFile& plant, const PlantKey<MaterialValues>& key, double value) {
  const std::optional<double> before = number_of(plant.material, key);
  set_number_of(plant.material, key, value);
  for (PlantCurve& curve : plant.curves) {
    std::optional<double> own = number_of(curve.material, key);
    if (!own) continue;
    if (!before)
      own.reset();
    else if (*before != 0.0)
      own = *own * (value / *before);
    // A ratio may lead out of what a number may be.
    if (own && std::isfinite(key.bounds.maximum))
      own = std::clamp(*own, key.bounds.minimum + 0.01, key.bounds.maximum);
    set_number_of(curve.material, key, own);
  }
}

}  // namespace

std::span<const PlantNumber> plant_numbers() {
  static const std::vector<PlantNumber> all = [] {
    std::vector<PlantNumber> numbers;
    add_numbers<MaterialValues>(numbers, "material", material_keys);
    add_numbers<DetachLimits>(numbers, "detach", detach_keys);
    // Nodes and junctions are made anew.
    add_numbers<PlantFile>(numbers, "sampling", sampling_keys, true);
    return numbers;
  }();
  return all;
}

const PlantNumber* find_plant_number(std::string_view key) {
  const auto all = plant_numbers();
  const auto number = std::ranges::find(all, key, &PlantNumber::key);
  return number == all.end() ? nullptr : &*number;
}

std::optional<double> value_of(const PlantFile& plant, const PlantNumber& number) {
  if (const auto* of = std::get_if<const PlantKey<MaterialValues>*>(&number.of))
    return number_of(plant.material, **of);
  if (const auto* of = std::get_if<const PlantKey<PlantFile>*>(&number.of))
    return number_of(plant, **of);
  if (plant.fruits.empty()) return std::nullopt;
  return number_of(plant.fruits.front().detach,
                   *std::get<const PlantKey<DetachLimits>*>(number.of));
}

void set_number(PlantFile& plant, const PlantNumber& number, double value) {
  if (const auto* of = std::get_if<const PlantKey<MaterialValues>*>(&number.of))
    set_material(plant, **of, value);
  else if (const auto* own = std::get_if<const PlantKey<PlantFile>*>(&number.of))
    set_number_of(plant, **own, value);
  else
    for (PlantFruit& fruit : plant.fruits)
      set_number_of(fruit.detach, *std::get<const PlantKey<DetachLimits>*>(number.of), value);
}

}  // namespace pedicel::plant
