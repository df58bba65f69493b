#pragma once

#include <functional>
#include <string>
#include <vector>

#include "plugins/cosserat/model/rod_model.h"
#include "plugins/coupling/collider_source.h"

namespace pedicel::simulation {

/// "arm/left_finger overlaps truss/stalk_5 by 2.1 mm at the start", one sentence for each organ and
/// thing, deepest places first. What a plant grows out of is left out: a stem that stands in the
/// ground or hangs from a beam.
struct StartOverlap {
  int collider = 0;
  std::string text;
};

/// The shapes of stems, by their index, that may lean on a body where one of them overlaps it;
/// empty: none does. What its fingers overlap is in its grip, and so is a fruit that overlaps the
/// body, with its stalk. `overlaps`: of a plant with all colliders; `is_of_body` and `is_finger`
/// tell of a collider, by its index, whose it is.
std::vector<bool> leaning_stems(const cosserat::RodModel& model,
                                const std::vector<coupling::Overlap>& overlaps,
                                const std::function<bool(int)>& is_of_body,
                                const std::function<bool(int)>& is_finger);

/// Lets a plant lean on what its stems overlap in `state`: it comes to rest there, under gravity,
/// without friction. False where it finds no rest; the state is then as it was.
bool lean(const cosserat::RodModel& model, cosserat::RodState& state, const Vec3& gravity,
          cosserat::ContactSource& contacts);

std::vector<StartOverlap> start_overlaps(const cosserat::RodModel& model,
                                         const coupling::ColliderSet& colliders,
                                         const std::vector<coupling::Overlap>& overlaps);

}  // namespace pedicel::simulation
