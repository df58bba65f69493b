#pragma once

#include <optional>
#include <string>

#include "app/session/live/snapshot.h"
#include "plugins/simulation/simulation.h"

namespace pedicel::app {

/// A place on a plant that is pulled.
struct PullPlace {
  int plant = 0, element = 0;
  double back = 0.0;        ///< m, from the element's child node
  double stiffness = 50.0;  ///< N/m, of the spring
};

/// A spring from a place of a plant to a point of the world. It is a support of the rods that holds
/// no direction, so the solver takes it implicitly and no stiffness makes it unstable. When the
/// place comes off with its fruit, the spring goes on pulling the fruit's body, as a damped spring
/// no stiffer than that body stands.
class Pull : public world::Participant {
 public:
  /// The simulation must outlive it, and it the simulation's last step.
  explicit Pull(simulation::Simulation& simulation) : simulation_(simulation) {}

  void begin(const PullPlace& place, const Vec3& target_W);
  void move(const Vec3& target_W);
  void end();
  bool active() const { return place_.has_value(); }
  PullSnapshot snapshot() const;
  /// The rods' supports were replaced (other constants): puts the spring in again.
  void renew();

  world::Phase phase() const override { return world::Phase::commands; }
  void act(world::SimWorld& world, world::WorldReport& report) override;

 private:
  bool on_plant() const;
  void put_in();
  void take_out();
  void find_body();
  Vec3 point() const;
  Vec3 body_force() const;

  simulation::Simulation& simulation_;
  std::optional<PullPlace> place_;
  Vec3 target_W_ = Vec3::Zero();  // m
  bool in_ = false;               // the support is in the rods, the last one
  int body_ = -1;                 // that the place has become; -1: none yet
  Vec3 arm_ = Vec3::Zero();       // m, of the place, in the body
};

}  // namespace pedicel::app
