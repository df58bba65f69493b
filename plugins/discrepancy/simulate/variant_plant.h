#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "plugins/discrepancy/data/experiment.h"
#include "plugins/plant/plant_builder.h"

namespace pedicel::discrepancy {

/// Makes the plants of an experiment's variants. The nominal plant is built once, with the node
/// distance of the prediction and without effects and trial masses: its rest shape is the one that
/// the drawing gives.
class PlantMaker {
 public:
  /// `distance` and `junction` (m) as in plant::BuildOptions. Throws InvalidFile where the plant
  /// cannot be built.
  PlantMaker(const Experiment& experiment, double distance, double junction);
  /// The same of a plant that stands somewhere under any gravity.
  PlantMaker(plant::PlantFile file, double distance, const plant::BuildOptions& options);

  /// With a trial's masses, the plant file's own effects and then those of `effects` that belong to
  /// a plant. Throws UsageError where one of them cannot be simulated.
  plant::BuiltPlant make(const Trial& trial, std::span<const plant::Effect> effects) const;

  /// A plant of make() without the trial's masses.
  cosserat::RodModel unladen(cosserat::RodModel made, const Trial& trial) const;

  const plant::BuiltPlant& nominal() const { return nominal_; }
  plant::PlacedPoint locate(const plant::CurvePlace& place) const;
  /// The place `distance` (m) further along its curve as drawn, at most to its ends.
  plant::PlacedPoint locate_beyond(const plant::CurvePlace& place, double distance) const;

 private:
  int curve(const plant::CurvePlace& place) const;

  plant::PlantFile file_;  // without effects
  std::vector<plant::Effect> own_effects_;
  plant::BuiltPlant nominal_;
};

/// True for what happens at the sensor or the grip.
bool is_of_experiment(const plant::Effect& effect);
/// True for what only changes what the instruments say.
bool is_of_sensor(const plant::Effect& effect);

}  // namespace pedicel::discrepancy
