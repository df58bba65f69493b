#pragma once

#include <string>
#include <vector>

#include "engine/world/sim_world.h"
#include "plugins/simulation/plants/organ_places.h"
#include "plugins/simulation/simulation.h"

namespace pedicel::app {

/// Forces on organs that act until they are changed. One on a fruit goes on at the fruit that came
/// off.
class OrganForces : public world::Participant {
 public:
  /// The simulation must outlive it, and it the simulation's last step.
  explicit OrganForces(simulation::Simulation& simulation) : simulation_(simulation) {}

  /// N and N m in the world, at a place of an organ (find_organ_place()). One at the same place of
  /// the same organ takes its place. Throws UsageError where there is no such organ.
  void set(const std::string& organ, double at, const Vec3& force_W, const Vec3& moment_W);
  void clear();

  world::Phase phase() const override { return world::Phase::commands; }
  void act(world::SimWorld& world, world::WorldReport& report) override;

 private:
  struct One {
    std::string organ;
    double at = 0.0;
    simulation::PlaceOnPlant place;
    std::size_t slot = 0;  // in RodSystem::loads()
    Vec3 force_W = Vec3::Zero(), moment_W = Vec3::Zero();
  };
  void push_fallen(const One& one, world::SimWorld& world) const;

  simulation::Simulation& simulation_;
  std::vector<One> all_;
};

}  // namespace pedicel::app
