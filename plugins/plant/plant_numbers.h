#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "pedicel/io/bounds.h"
#include "pedicel/plant/model/plant_model.h"

namespace pedicel::plant {

/// A number of a plant that a user can set, in its file, by `--set`, in a scene and in the window:
/// its one description.
struct PlantNumber {
  std::string_view key;   ///< "material.density"
  std::string_view unit;  ///< "1" where it has none
  io::Bounds bounds;      ///< what is accepted
  /// What a slider spans; both 0: none is shown.
  double low = 0.0, high = 0.0;
  bool logarithmic = false;  ///< of the slider
  bool restarts = false;     ///< a change starts the run anew
  std::string_view sentence;
  std::variant<std::optional<double> MaterialValues::*, std::optional<double> DetachLimits::*,
               double PlantFile::*>
      member;
};
std::span<const PlantNumber> plant_numbers();

/// Null where there is no such key.
const PlantNumber* find_plant_number(std::string_view key);
/// Asserts that there is such a key.
io::Bounds number_bounds(std::string_view key);

/// What a plant says; of detachment, what its first fruit says. Nothing where it says nothing.
std::optional<double> value_of(const PlantFile& plant, const PlantNumber& number);
/// Sets it. Of a material, curves with a number of their own keep their ratio to the plant's; of
/// detachment, every fruit gets it.
void set_number(PlantFile& plant, const PlantNumber& number, double value);

}  // namespace pedicel::plant
