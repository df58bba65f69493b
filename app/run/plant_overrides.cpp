#include "pedicel/app/run/plant_overrides.h"

#include <algorithm>
#include <map>

#include "pedicel/io/bounds.h"
#include "pedicel/plant/plant_numbers.h"
#include "pedicel/world/settings.h"

namespace pedicel::app {

namespace {

using plant::DetachLimits;
using plant::MaterialValues;

const std::map<std::string, std::optional<double> DetachLimits::*>& detach_keys() {
  static const std::map<std::string, std::optional<double> DetachLimits::*> keys = {
      {"detach.stretch", &DetachLimits::stretch},
      {"detach.bend", &DetachLimits::bend},
      {"detach.force", &DetachLimits::force},
      {"detach.moment", &DetachLimits::moment},
      {"detach.torsion", &DetachLimits::torsion}};
  return keys;
}

const std::map<std::string, std::optional<double> MaterialValues::*>& material_keys() {
  static const std::map<std::string, std::optional<double> MaterialValues::*> keys = {
      {"material.youngs_modulus", &MaterialValues::youngs_modulus},
      {"material.poisson_ratio", &MaterialValues::poisson_ratio},
      {"material.density", &MaterialValues::density},
      {"material.damping_time", &MaterialValues::damping_time}};
  return keys;
}

std::string all_keys() {
  std::string text;
  for (const auto& [key, member] : detach_keys()) text += key + ", ";
  for (const auto& [key, member] : material_keys()) text += key + ", ";
  return text + "sampling.connect, sampling.distance";
}

// Curves of other tissue than the plant (a soft stalk on a woody stem) stay so much softer, lighter
// or calmer than it. Without a number of the plant to compare with, or with 0, there is no ratio.
void set_material(plant::PlantFile& plant, const std::string& key,
                  std::optional<double> MaterialValues::*member, double value) {
  const std::optional<double> before = plant.material.*member;
  plant.material.*member = value;
  for (plant::PlantCurve& curve : plant.curves) {
    std::optional<double>& own = curve.material.*member;
    if (!own) continue;
    if (!before)
      own.reset();
    else if (*before != 0.0)
      own = *own * (value / *before);
    if (own && key == "material.poisson_ratio") own = std::clamp(*own, -0.99, 0.5);
  }
}

}  // namespace

void apply_plant_overrides(plant::PlantFile& plant, const std::vector<world::Setting>& settings,
                           Diagnostics& diagnostics) {
  for (const world::Setting& setting : settings) {
    const auto detach = detach_keys().find(setting.key);
    const auto material = material_keys().find(setting.key);
    const bool connect = setting.key == "sampling.connect";
    if (detach == detach_keys().end() && material == material_keys().end() && !connect &&
        setting.key != "sampling.distance") {
      diagnostics.error(setting.where,
                        "unknown key \"" + setting.key + "\", expected one of: " + all_keys());
      continue;
    }
    const std::optional<double> value = world::to_number(setting.text);
    const io::Bounds bounds = plant::number_bounds(setting.key);
    if (!value || !io::within(*value, bounds)) {
      diagnostics.error(setting.where, setting.key + " is \"" + setting.text + "\", expected " +
                                           io::bounds_text(bounds));
      continue;
    }
    if (detach != detach_keys().end()) {
      for (plant::PlantFruit& fruit : plant.fruits) fruit.detach.*(detach->second) = *value;
    } else if (material != material_keys().end()) {
      set_material(plant, setting.key, material->second, *value);
    } else {
      (connect ? plant.connect : plant.distance) = *value;
    }
  }
}

}  // namespace pedicel::app
