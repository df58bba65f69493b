#pragma once

#include <vector>

#include "plugins/simulation/plants/plant_step.h"

namespace pedicel::simulation {

/// How gently plants were handled over a run: what touched each organ and fruit, how hard, and how
/// near stalks came to breaking. Contacts of a plant with itself count, too.
class Gentleness : public world::Observer {
 public:
  struct Record {
    double peak_force = 0.0;    ///< N, largest sum of the normal forces on it
    double impulse = 0.0;       ///< N s, of that sum over time
    double first_touch = -1.0;  ///< s; negative: it was never touched
    /// J, by how much its strain energy rose above that at the start, at most; 0 for fruits.
    double strain_energy = 0.0;
    double margin_used = 0.0;  ///< 1, of the stalk's threshold, at most; 0 for organs
    bool broken = false;       ///< it, or a part of it, came off

    bool touched() const { return first_touch >= 0.0; }
  };
  struct Total {
    double peak_force = 0.0, impulse = 0.0, strain_energy = 0.0, margin_used = 0.0;
    int touched = 0, broken = 0;  ///< organs and fruits; fruits that came off
  };

  Gentleness(const cosserat::RodSystem& rods, const PlantStep& plants);

  void observe(const world::SimWorld& world, const world::WorldReport& report) override;

  const std::vector<Record>& organs(int plant) const { return plants_[plant].organs; }
  const std::vector<Record>& fruits(int plant) const { return plants_[plant].fruits; }
  /// Peaks are the largest of any organ, impulses and energies are sums.
  Total total() const;

 private:
  struct Plant {
    std::vector<Record> organs, fruits;
    std::vector<double> start;  // J, strain energy of each organ
    std::vector<double> now;
  };
  void observe_contacts(int plant, double time, double dt);
  void observe_energy(int plant);
  void sum_energy(int plant, std::vector<double>& sums) const;

  const cosserat::RodSystem& rods_;
  const PlantStep& step_;
  std::vector<Plant> plants_;
  long steps_ = 0;
};

}  // namespace pedicel::simulation
