#pragma once

#include <string>
#include <vector>

#include "pedicel/cosserat/model/rod_model.h"
#include "pedicel/coupling/collider_source.h"

namespace pedicel::app {

/// "arm/left_finger overlaps truss/stalk_5 by 2.1 mm at the start", one sentence for each organ and
/// thing, deepest places first. What a plant grows out of is left out: a stem that stands in the
/// ground or hangs from a beam.
struct StartOverlap {
  int collider = 0;
  std::string text;
};
std::vector<StartOverlap> start_overlaps(const cosserat::RodModel& model,
                                         const coupling::ColliderSet& colliders,
                                         const std::vector<coupling::Overlap>& overlaps);

}  // namespace pedicel::app
