#pragma once

#include <array>
#include <vector>

#include "engine/world/scene.h"
#include "engine/world/sim_world.h"
#include "plugins/cosserat/solver/rod_system.h"
#include "plugins/simulation/plants/blade.h"

namespace pedicel::simulation {

/// Gives a plant areas on which wind acts: its stems as cylinders, its leaves' blades as plates.
/// Stems whose file states a drag area keep it.
void expose_to_wind(cosserat::RodModel& model, const std::vector<Blade>& blades);

/// The wind of a scene (assets/manual/theory_wind.md): a mean that grows with height, gusts that
/// travel with it, and shelter behind plants.
class WindField : public world::Participant {
 public:
  /// The plants stand as drawn, exposed to wind. `seed` draws the gusts.
  WindField(const world::SceneWind& wind, int seed, cosserat::RodSystem& rods);

  /// m/s, W, at a place (m) and time (s), without shelter.
  Vec3 velocity(const Vec3& place, double time) const;
  /// 1, which an element gets of it.
  double shelter(int plant, int element) const { return shelter_[plant][element]; }

  world::Phase phase() const override { return world::Phase::commands; }
  void act(world::SimWorld& world, world::WorldReport& report) override;

 private:
  // Side by side, for the compiler to take several at once.
  static constexpr int waves = 24;
  using Waves = std::array<double, waves>;

  void draw_gusts(int seed);
  void find_shelter();
  Waves turns_at(double time) const;
  Vec3 velocity(const Vec3& place, double time, const Waves& turns) const;

  world::SceneWind wind_;
  cosserat::RodSystem& rods_;
  std::array<Waves, 3> number_{};             // turns/m, W
  std::array<Waves, 3> amplitude_{};          // 1, of the mean speed, W
  Waves phase_{};                             // turns
  std::vector<std::vector<double>> shelter_;  // by plant and element
};

}  // namespace pedicel::simulation
