#include "discrepancy/variant_plant.h"

#include <algorithm>

#include "core/check.h"
#include "plant/apply_effects.h"
#include "plant/effects.h"

namespace pedicel::discrepancy {

bool is_of_experiment(const plant::Effect& effect) {
  const plant::EffectKind* kind = plant::find_effect(effect.name);
  return kind && kind->home == plant::EffectHome::experiment;
}

bool is_of_sensor(const plant::Effect& effect) {
  return is_of_experiment(effect) && !effect.name.starts_with("grip_");
}

PlantMaker::PlantMaker(const Experiment& experiment, double distance, double junction)
    : file_(experiment.plant) {
  own_effects_ = std::move(file_.effects);
  file_.effects.clear();
  file_.distance = distance;
  plant::BuildOptions options;
  options.junction = junction;
  Diagnostics diagnostics;
  auto built = plant::build_plant(file_, options, diagnostics);
  if (!built) throw InvalidFile(diagnostics);
  nominal_ = std::move(*built);
}

plant::BuiltPlant PlantMaker::make(const Trial& trial,
                                   std::span<const plant::Effect> effects) const {
  plant::BuiltPlant built = nominal_;
  for (const plant::PlantMass& mass : trial.masses) {
    const plant::PlacedPoint at = locate(mass.place);
    built.model.masses.push_back({at.element, at.back, mass.mass, 0.0});
    cosserat::lump_inertia(built.model, at.element);
  }
  plant::PlantFile file = file_;
  file.effects = own_effects_;
  for (const plant::Effect& effect : effects)
    if (!is_of_experiment(effect)) file.effects.push_back(effect);
  Diagnostics diagnostics;
  plant::apply_effects(file, built, diagnostics);
  if (diagnostics.has_errors()) throw UsageError(diagnostics.text());
  built.model.clock = trial.clock;
  return built;
}

int PlantMaker::curve(const plant::CurvePlace& place) const {
  const int index = file_.curve_index(place.curve);
  if (index < 0)
    throw UsageError("curve \"" + place.curve + "\" is unknown in plant \"" + file_.name + "\"");
  return index;
}

plant::PlacedPoint PlantMaker::locate(const plant::CurvePlace& place) const {
  return nominal_.locate(curve(place), place.at);
}

plant::PlacedPoint PlantMaker::locate_beyond(const plant::CurvePlace& place,
                                             double distance) const {
  const int index = curve(place);
  const double at = place.at + distance / nominal_.curve_lengths[index];
  return nominal_.locate(index, std::clamp(at, 0.0, 1.0));
}

}  // namespace pedicel::discrepancy
