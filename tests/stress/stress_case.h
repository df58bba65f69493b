#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/geometry/signed_distance.h"
#include "plugins/cosserat/solver/rod_solver.h"
#include "plugins/coupling/coupling_settings.h"

namespace pedicel::stress {

/// Something rigid that goes through the plant at constant speed.
struct Ram {
  std::string shape_name;
  std::shared_ptr<const geometry::SignedDistance> shape;
  Pose start;           ///< X_WC at time 0
  Vec3 velocity, spin;  ///< m/s and rad/s, W
  Pose at(double time) const;
};

/// The clamp swings about where it was drawn: sin(2 pi frequency t) times these.
struct Shake {
  Vec3 amplitude, turn;    ///< m and rad (rotation vector), W
  double frequency = 0.0;  ///< Hz
  Pose at(const Pose& drawn, double time) const;
};

/// A load that acts for from <= t < to.
struct TimedLoad {
  cosserat::Load load;
  double from = 0.0, to = 0.0;  ///< s
};

/// One ordeal: everything about it follows from its seed.
struct StressCase {
  std::uint64_t seed = 0;
  std::string plant_name;
  cosserat::RodModel plant;
  cosserat::RodSettings rods;
  coupling::CouplingSettings coupling;
  double dt = 0.0;  ///< s
  int steps = 0;
  Vec3 gravity = Vec3::Zero();  ///< m/s2, W
  double youngs_modulus = 0.0;  ///< Pa, of the plant
  double damping_time = 0.0;    ///< s
  std::optional<Ram> ram;
  std::optional<Shake> shake;
  std::vector<TimedLoad> loads;
};

/// Draws the case of a seed: the same on every machine, where the digitised trees are there.
StressCase draw_case(std::uint64_t seed);

/// One line that says what it is.
std::string describe(const StressCase& one);

}  // namespace pedicel::stress
