#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/world/scene.h"
#include "plugins/cosserat/solver/rod_system.h"
#include "plugins/simulation/plants/organ_places.h"

namespace pedicel::simulation {

/// The scene's ties, as strings of the plants.
class SceneTies {
 public:
  struct One {
    std::string name;         ///< "tie_1", or of a plant of a grid "tie_1_3"
    int plant = 0;            ///< that it holds, index into the RodSystem
    bool is_between = false;  ///< it ends on a plant
    std::size_t slot = 0;     ///< in RodSystem::ties(), or strings() where it ends on a plant
    int number = 0;           ///< in the scene's list, from 0
  };
  /// How a string runs now.
  struct Course {
    Vec3 from_W = Vec3::Zero(), to_W = Vec3::Zero();  ///< m, the tied place and the other end
    double length = 0.0;                              ///< m, where it becomes taut
    double tension = 0.0;                             ///< N
  };

  /// Gives them to the plants, where they stand as drawn. A tie on an organ that no plant has is an
  /// error, and so is one with both ends on one segment.
  SceneTies(const std::vector<world::SceneTie>& ties, cosserat::RodSystem& rods,
            Diagnostics& diagnostics);

  const std::vector<One>& all() const { return all_; }
  /// N, of one of them now.
  double tension(const One& one) const;
  /// Nothing where what it held came off.
  std::optional<Course> course(const One& one) const;

 private:
  void add(const world::SceneTie& tie, const std::string& organ, const std::string& number,
           One one);
  Vec3 now(const PlaceOnPlant& place) const;

  cosserat::RodSystem& rods_;
  std::vector<One> all_;
};

}  // namespace pedicel::simulation
