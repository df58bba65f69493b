#pragma once

#include <span>

#include "plugins/discrepancy/scene_fit/scene_fit.h"

namespace pedicel::discrepancy {

/// Something that the scene does not have acts on a plant.
struct OutsideForce {
  bool found = false;
  int trial = -1, plant = -1;  ///< the trial in which it shows most
  plant::CurvePlace place;
  Vec3 position = Vec3::Zero();   ///< m, W, of the place when it begins
  double from = 0.0, to = 0.0;    ///< s, when it begins and ends
  Vec3 direction = Vec3::Zero();  ///< unit, W, of its mean
  double size = 0.0;              ///< N, its root mean square while it acts
  double share = 0.0;             ///< 1, of the misfit's mean square that it takes
  std::vector<double> time;       ///< s
  std::vector<Vec3> force;        ///< N, W, over `time`
};

/// Where on the plants one force would have to act, with any course over time, to explain best what
/// `model` leaves in the trial where it leaves most: responses to forces at places along all curves
/// are simulated side by side, and the course is fitted to them time by time, as if slow.
OutsideForce find_outside_force(SceneEvaluator& evaluator, const std::vector<plant::Effect>& model,
                                std::span<const int> trials, int threads);

}  // namespace pedicel::discrepancy
