#include "plugins/simulation/plants/plant_overrides.h"

#include "engine/io/bounds.h"
#include "engine/world/settings.h"
#include "plugins/plant/plant_numbers.h"
#include "plugins/plant/plant_shape.h"

namespace pedicel::simulation {

namespace {

std::string all_keys() {
  std::string text;
  for (const plant::PlantNumber& number : plant::plant_numbers())
    text += (text.empty() ? "" : ", ") + std::string(number.key);
  for (const plant::ShapeFactor& factor : plant::shape_factors())
    text += ", " + std::string(factor.key);
  return text;
}

}  // namespace

void apply_plant_overrides(plant::PlantFile& plant, const std::vector<world::Setting>& settings,
                           Diagnostics& diagnostics) {
  for (const world::Setting& setting : settings) {
    const plant::PlantNumber* number = plant::find_plant_number(setting.key);
    // Each setting by itself: one that is wrong does not hide the others.
    const plant::ShapeFactor* factor = plant::find_shape_factor(setting.key);
    if (!number && !factor) {
      diagnostics.error(setting.where,
                        "unknown key \"" + setting.key + "\", expected one of: " + all_keys());
      continue;
    }
    const std::optional<double> value = world::to_number(setting.text);
    const io::Bounds bounds = number ? number->bounds : plant::shape_bounds;
    if (!value || !io::within(*value, bounds)) {
      diagnostics.error(setting.where, setting.key + " is \"" + setting.text + "\", expected " +
                                           io::bounds_text(bounds));
      continue;
    }
    if (factor) {
      plant::scale_shape(plant, factor->what, *value);
      continue;
    }
    // In their order: a later setting of the same key counts.
    plant::set_number(plant, *number, *value);
  }
}

}  // namespace pedicel::simulation
