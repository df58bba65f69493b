#pragma once

#include <map>
#include <string>
#include <vector>

#include "engine/world/expectation.h"
#include "plugins/simulation/plants/plant_step.h"

namespace pedicel::simulation {

/// Everything that a scene may expect something of (world::known_quantities()), gathered while a
/// run goes on.
class Measurements : public world::Observer {
 public:
  Measurements(const cosserat::RodSystem& rods, const PlantStep& plants,
               const coupling::ColliderSet& colliders);

  void observe(const world::SimWorld& world, const world::WorldReport& report) override;
  void set_wall_seconds(double seconds) { wall_seconds_ = seconds; }

  /// The measured value; NaN where it could not be measured (a fruit that never came off).
  double value(const world::Expectation& expectation, const world::SimWorld& world) const;

  double largest_stretch() const;  ///< 1, of any segment over the run

 private:
  struct PlantRecord {
    double drift = 0.0, stretch = 0.0, bend = 0.0;  // m, 1, rad: largest over the run
    std::vector<double> fruit_start, fruit_top;     // m, heights
    std::vector<double> fruit_force;                // N, largest
  };
  void observe_plant(int plant);
  const Detached* find_detached(const std::string& fruit) const;
  double count(const world::Expectation& expectation, const std::string& cause) const;
  double of_plants(const world::Expectation& expectation, double PlantRecord::*value) const;
  double of_fruit(const world::Expectation& expectation, const world::SimWorld& world) const;
  double fruits_in(const world::Expectation& expectation, const world::SimWorld& world) const;
  double contact_force(const world::Expectation& expectation) const;
  double end_drop(const std::string& plant) const;
  bool is_plant(const std::string& wanted, int plant) const;

  const cosserat::RodSystem& rods_;
  const PlantStep& plants_;
  const coupling::ColliderSet& colliders_;
  std::vector<PlantRecord> records_;
  std::map<std::string, double> link_force_;  // N, largest normal force by collider name
  double penetration_ = 0.0, time_ = 0.0, wall_seconds_ = 0.0;
};

}  // namespace pedicel::simulation
