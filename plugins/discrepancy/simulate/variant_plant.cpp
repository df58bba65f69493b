#include "plugins/discrepancy/simulate/variant_plant.h"

#include <algorithm>

#include "engine/core/check.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {

bool is_of_experiment(const plant::Effect& effect) {
  const effects::EffectDefinition* known = effects::find_effect(effect.name);
  return known && known->file == effects::EffectFile::experiment;
}

bool is_of_sensor(const plant::Effect& effect) {
  const effects::EffectDefinition* known = effects::find_effect(effect.name);
  return known && known->home == effects::Home::sensor;
}

namespace {

plant::BuildOptions with_junction(double junction) {
  plant::BuildOptions options;
  options.junction = junction;
  return options;
}

}  // namespace

PlantMaker::PlantMaker(const Experiment& experiment, double distance, double junction)
    : PlantMaker(experiment.plant(), distance, with_junction(junction)) {}

PlantMaker::PlantMaker(plant::PlantFile file, double distance, const plant::BuildOptions& options)
    : file_(std::move(file)) {
  own_effects_ = std::move(file_.effects);
  file_.effects.clear();
  file_.distance = distance;
  Diagnostics diagnostics;
  auto built = plant::build_plant(file_, options, diagnostics);
  if (!built) throw InvalidFile(diagnostics);
  nominal_ = std::move(*built);
}

plant::BuiltPlant PlantMaker::make(const Trial& trial, std::span<const plant::Effect> added) const {
  plant::BuiltPlant built = nominal_;
  for (const plant::PlantMass& mass : trial.masses) {
    const plant::PlacedPoint at = locate(mass.place);
    built.model.masses.push_back({at.element, at.back, mass.mass, 0.0});
    cosserat::lump_inertia(built.model, at.element);
  }
  std::vector<plant::Effect> all = own_effects_;
  for (const plant::Effect& effect : added)
    if (!is_of_experiment(effect)) all.push_back(effect);
  Diagnostics diagnostics;
  effects::apply_effects(file_, all, built.model, built, diagnostics);
  if (diagnostics.has_errors()) throw UsageError(diagnostics.text());
  built.model.clock = trial.clock;
  return built;
}

cosserat::RodModel PlantMaker::unladen(cosserat::RodModel made, const Trial& trial) const {
  const auto first = made.masses.begin() + static_cast<long>(nominal_.model.masses.size());
  made.masses.erase(first, first + static_cast<long>(trial.masses.size()));
  for (const plant::PlantMass& mass : trial.masses)
    cosserat::lump_inertia(made, locate(mass.place).element);
  return made;
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
