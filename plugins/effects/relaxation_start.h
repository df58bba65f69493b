#pragma once

#include "pedicel/cosserat/model/joint_law.h"
#include "pedicel/plant/model/plant_model.h"

namespace pedicel::effects {

/// What `start` of relaxation and creep says.
inline cosserat::RelaxationStart relaxation_start(const plant::Effect& effect) {
  const auto start = effect.words.find("start");
  if (start == effect.words.end()) return cosserat::RelaxationStart::settled;
  if (start->second == "hung") return cosserat::RelaxationStart::hung;
  return start->second == "unloaded" ? cosserat::RelaxationStart::unloaded
                                     : cosserat::RelaxationStart::settled;
}

}  // namespace pedicel::effects
