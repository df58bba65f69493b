#pragma once

#include <span>

#include "plugins/cosserat/solver/rod_solver.h"

namespace pedicel::cosserat {

/// settle() of a plant that touches what `contacts` find, without friction.
StepReport settle_touching(const RodModel& model, RodState& state, const Vec3& gravity,
                           std::span<const Load> loads, std::span<ContactSource* const> contacts,
                           int iterations = 500);

}  // namespace pedicel::cosserat
