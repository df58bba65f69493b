#include "pedicel/plant/plant_numbers.h"

#include <algorithm>

#include "pedicel/core/check.h"

namespace pedicel::plant {

namespace {

// Curves of other tissue than the plant (a soft stalk on a woody stem) stay so much softer, lighter
// or calmer than it. Without a number of the plant to compare with, or with 0, there is no ratio.
void set_material(PlantFile& plant, std::optional<double> MaterialValues::*member, double value) {
  const std::optional<double> before = plant.material.*member;
  plant.material.*member = value;
  for (PlantCurve& curve : plant.curves) {
    std::optional<double>& own = curve.material.*member;
    if (!own) continue;
    if (!before)
      own.reset();
    else if (*before != 0.0)
      own = *own * (value / *before);
    if (own && member == &MaterialValues::poisson_ratio) own = std::clamp(*own, -0.99, 0.5);
  }
}

}  // namespace

std::span<const PlantNumber> plant_numbers() {
  static const PlantNumber all[] = {
      {"material.youngs_modulus", "Pa", io::positive, 1.0e5, 1.0e11, true, false,
       "Stiffness of the stems (those with their own keep their ratio to it); a green stem 1e7 to "
       "1e9, wood 1e10.",
       &MaterialValues::youngs_modulus},
      {"material.poisson_ratio",
       "1",
       {-1.0, 0.5, true},
       -0.9,
       0.5,
       false,
       false,
       "Decides the shear and twist stiffness; 0.3 to 0.4 for tissue.",
       &MaterialValues::poisson_ratio},
      {"material.density", "kg/m3", io::positive, 50.0, 3000.0, false, false,
       "Mass of the stems (those with their own keep their ratio to it); fresh tissue 700 to 1000.",
       &MaterialValues::density},
      {"material.damping_time", "s", io::not_negative, 0.0, 1.0, false, false,
       "Kelvin-Voigt: damping ratio = pi * frequency * this; 0.01 calms a stem within seconds. "
       "Stems with their own keep their ratio to it.",
       &MaterialValues::damping_time},
      {"detach.stretch", "1", io::positive, 1.0e-3, 2.0, true, false,
       "Strain of its stalk at which a fruit comes off.", &DetachLimits::stretch},
      {"detach.bend", "rad", io::positive, 1.0e-3, 3.2, true, false,
       "Bending of its stalk's joint at which a fruit comes off.", &DetachLimits::bend},
      {"detach.force", "N", io::positive, 1.0e-3, 1.0e3, true, false,
       "Force in its stalk at which a fruit comes off.", &DetachLimits::force},
      {"detach.moment", "N m", io::positive, 1.0e-5, 1.0e2, true, false,
       "Bending moment in its stalk at which a fruit comes off.", &DetachLimits::moment},
      {"detach.torsion", "N m", io::positive, 1.0e-5, 1.0e2, true, false,
       "Torsion in its stalk at which a fruit comes off.", &DetachLimits::torsion},
      {"sampling.connect", "m", io::positive, 0.0, 0.0, true, true,
       "How near the end of a curve must be to another one to be joined to it.",
       &PlantFile::connect},
      {"sampling.distance", "m", io::positive, 1.0e-3, 0.5, true, true,
       "How far apart nodes lie: finer is more exact and slower.", &PlantFile::distance}};
  return all;
}

const PlantNumber* find_plant_number(std::string_view key) {
  const auto all = plant_numbers();
  const auto number = std::ranges::find(all, key, &PlantNumber::key);
  return number == all.end() ? nullptr : &*number;
}

io::Bounds number_bounds(std::string_view key) {
  const PlantNumber* number = find_plant_number(key);
  PEDICEL_ASSERT(number);
  return number->bounds;
}

std::optional<double> value_of(const PlantFile& plant, const PlantNumber& number) {
  if (const auto* of = std::get_if<std::optional<double> MaterialValues::*>(&number.member))
    return plant.material.*(*of);
  if (const auto* of = std::get_if<double PlantFile::*>(&number.member)) return plant.*(*of);
  if (plant.fruits.empty()) return std::nullopt;
  return plant.fruits.front().detach.*
         std::get<std::optional<double> DetachLimits::*>(number.member);
}

void set_number(PlantFile& plant, const PlantNumber& number, double value) {
  if (const auto* of = std::get_if<std::optional<double> MaterialValues::*>(&number.member))
    set_material(plant, *of, value);
  else if (const auto* own = std::get_if<double PlantFile::*>(&number.member))
    plant.*(*own) = value;
  else
    for (PlantFruit& fruit : plant.fruits)
      fruit.detach.*std::get<std::optional<double> DetachLimits::*>(number.member) = value;
}

}  // namespace pedicel::plant
