#pragma once

#include <array>
#include <string>
#include <vector>

#include "engine/robot/robot.h"
#include "engine/world/sim_world.h"
#include "plugins/cosserat/solver/rod_system.h"
#include "plugins/simulation/plants/organ_places.h"
#include "plugins/simulation/robot_control.h"

namespace pedicel::simulation {

/// Organs that links of the robot hold rigidly, as it was recorded: each by a stiff spring at one
/// place, of a curve the nearest to the link's origin.
class HeldOrgans {
 public:
  /// Keeps references to both. To be made when the plants have all other supports.
  HeldOrgans(std::vector<Grasp> grasps, cosserat::RodSystem& rods, const robot::Robot& robot);

  /// While links still are where the step began: takes and lets go.
  world::Participant& before() { return before_; }
  /// When links are where the step ends, before the plants move: carries what is held along.
  world::Participant& carry() { return carry_; }
  /// After the plants: adds what the held organs exert on their links in this step.
  void add_forces(const world::SimWorld& world, std::vector<robot::LinkReaction>& forces);

 private:
  class Part : public world::Participant {
   public:
    Part(world::Phase phase, HeldOrgans& owner, void (HeldOrgans::*task)(double time))
        : phase_(phase), owner_(owner), task_(task) {}
    world::Phase phase() const override { return phase_; }
    void act(world::SimWorld& world, world::WorldReport&) override {
      (owner_.*task_)(world.time());
    }

   private:
    world::Phase phase_;
    HeldOrgans& owner_;
    void (HeldOrgans::*task_)(double time);
  };
  struct Held {
    std::string what;
    int link = 0;
    PlaceOnPlant place;  // of the spring that holds it
    Vec3 position_L;     // m, of that place
    Vec3 centre_L;       // m, of the organ
    Quat rotation;       // E to L
    Vec3 turning;        // N m/rad
    double mass = 0.0;   // kg, of a fruit: once it is off the plant, the link carries it
    std::array<Vec3, 2> before{Vec3::Zero(), Vec3::Zero()};  // m, W, at the last two steps
  };

  void take_and_release(double time);
  void carry_along(double time);
  void take_hold(const Grasp& grasp);
  bool find(const Grasp& grasp, Held& held) const;
  cosserat::Support support_of(const Held& held) const;
  bool is_on_plant(const Held& held) const {
    return rods_.state(held.place.plant).alive[held.place.element];
  }

  std::vector<Grasp> grasps_;  // by time
  std::size_t next_ = 0;
  cosserat::RodSystem& rods_;
  const robot::Robot& robot_;
  std::vector<std::size_t> own_supports_;  // of each plant, without what is held
  std::vector<Held> held_;
  bool changed_ = false;  // supports are not those of the plants alone
  Part before_, carry_;
};

}  // namespace pedicel::simulation
