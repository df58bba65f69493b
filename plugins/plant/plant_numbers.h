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
  std::string_view key;  ///< "material.density"
  /// What it is called within its group: "density".
  std::string_view name() const { return key.substr(key.find('.') + 1); }
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

/// kg/m3, of a fruit that is added without a density of its own: a ripe tomato's, which just
/// floats.
inline constexpr double usual_fruit_density = 950.0;

/// Calls task(number, member) for every number of a group: MaterialValues or DetachLimits.
template <typename Group, typename Task>
void for_numbers_of(Task&& task) {
  for (const PlantNumber& number : plant_numbers())
    if (const auto* member = std::get_if<std::optional<double> Group::*>(&number.member))
      task(number, *member);
}

/// Null where the group has no number of that name.
template <typename Group>
const PlantNumber* find_number_of(std::string_view name) {
  const PlantNumber* found = nullptr;
  for_numbers_of<Group>([&](const PlantNumber& number, auto) {
    if (number.name() == name) found = &number;
  });
  return found;
}

/// Names of a group's numbers, for a sentence: "stretch, bend, force".
template <typename Group>
std::string names_of_numbers() {
  std::string names;
  for_numbers_of<Group>([&](const PlantNumber& number, auto) {
    names += (names.empty() ? "" : ", ") + std::string(number.name());
  });
  return names;
}

/// The member of `group` that a number of that group is.
template <typename Group>
std::optional<double>& member_of(Group& group, const PlantNumber& number) {
  return group.*std::get<std::optional<double> Group::*>(number.member);
}

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
