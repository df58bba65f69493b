#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "engine/io/bounds.h"
#include "plugins/plant/model/plant_model.h"

namespace pedicel::plant {

/// A number of a plant that a user can set, in its file, by `--set`, in a scene and in the window:
/// made of the descriptions of the file's keys (plant_model.h).
struct PlantNumber {
  std::string key;               ///< "material.density"
  std::string_view unit;         ///< "1" where it has none
  io::Bounds bounds;             ///< what is accepted
  double low = 0.0, high = 0.0;  ///< what a slider spans; both 0: none is shown
  bool logarithmic = false;      ///< of the slider
  bool restarts = false;         ///< a change starts the run anew
  std::string_view sentence;     ///< what it does
  /// Where plant_model.h describes it.
  std::variant<const PlantKey<MaterialValues>*, const PlantKey<DetachLimits>*,
               const PlantKey<PlantFile>*>
      of;
};
/// The numbers of material_keys, detach_keys and sampling_keys.
std::span<const PlantNumber> plant_numbers();

/// Null where there is no such key.
const PlantNumber* find_plant_number(std::string_view key);

/// What a plant says; of detachment, what its first fruit says. Nothing where it says nothing.
std::optional<double> value_of(const PlantFile& plant, const PlantNumber& number);
/// Sets it. Of a material, curves with a number of their own keep their ratio to the plant's; of
/// detachment, every fruit gets it.
void set_number(PlantFile& plant, const PlantNumber& number, double value);

}  // namespace pedicel::plant
