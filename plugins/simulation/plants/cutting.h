#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/world/recorder.h"
#include "engine/world/scene.h"
#include "engine/world/sim_world.h"
#include "plugins/simulation/plants/organ_places.h"

namespace pedicel::simulation {

/// Cuts through stems: those of the scene, and those that somebody asks for. What is cut off goes
/// on as one rigid body, "PLANT/CURVE_cut".
class Cutting : public world::Participant {
 public:
  /// Keeps references to all. A cut of an organ that no plant has is an error.
  Cutting(const std::vector<world::SceneCut>& cuts, cosserat::RodSystem& rods,
          world::SimWorld& world, Diagnostics& diagnostics);

  /// Where the tool is (m, W), for cuts by it and for their record.
  void set_tool(std::function<Pose()> tool) { tool_ = std::move(tool); }

  /// Hears of each body that was cut off, and of its plant.
  void set_released(std::function<void(int plant, int body)> released) {
    released_ = std::move(released);
  }

  /// Between two steps: cuts a stem at the joint next to a fraction of its length. Throws
  /// UsageError where there is no such organ, or it has come off already.
  void cut(const std::string& organ, double at);
  /// Whether there is such an organ, and it has not come off there.
  bool can_cut(const std::string& organ, double at) const;

  world::Phase phase() const override { return world::Phase::commands; }
  void act(world::SimWorld& world, world::WorldReport& report) override;

  /// The body that a fruit fell with, and its centre there (m, in the body's frame); nothing where
  /// it was not cut off.
  struct Carried {
    int body = -1;
    Vec3 centre_B = Vec3::Zero();
    Vec3 stalk_B = Vec3::Zero();  ///< m, of where its stalk begins
  };
  std::optional<Carried> carried(int plant, int fruit) const;
  /// The body that a segment fell with; -1: it was not cut off.
  int body_with(int plant, int element) const;

  /// What was cut so far, with cause "cut".
  const std::vector<world::Event>& events() const { return events_; }

 private:
  struct Planned {
    const world::SceneCut* cut;
    PlaceOnPlant place;
    bool done = false;
  };
  bool is_due(const Planned& one) const;
  void cut_at(const PlaceOnPlant& place, const std::string& organ);

  cosserat::RodSystem& rods_;
  world::SimWorld& world_;
  std::function<Pose()> tool_;
  std::function<void(int plant, int body)> released_;
  std::vector<Planned> planned_;
  std::vector<world::Event> events_;
  std::map<std::pair<int, int>, Carried> carried_;  // of plant and fruit
  std::map<std::pair<int, int>, int> bodies_;       // of plant and element
};

}  // namespace pedicel::simulation
