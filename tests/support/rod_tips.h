#pragma once

#include <vector>

#include "plugins/cosserat/solver/rod_system.h"

namespace pedicel::cosserat::cases {

/// Where the last element of each plant is (m, W) after `steps` of 1/240 s in a system that they
/// share.
inline std::vector<Vec3> tips_after(const std::vector<RodModel>& plants, int threads, int steps) {
  RodSystem system(RodSettings{}, threads);
  for (const RodModel& plant : plants) system.add_plant(plant);
  for (int i = 0; i < steps; ++i) system.step(1.0 / 240.0, Vec3(0, 0, -9.81));
  std::vector<Vec3> tips;
  for (int p = 0; p < system.size(); ++p) tips.push_back(system.state(p).position.back());
  return tips;
}

}  // namespace pedicel::cosserat::cases
