#pragma once

#include <span>

#include "plugins/cosserat/model/rod_model.h"
#include "plugins/cosserat/model/rod_state.h"
#include "plugins/cosserat/solver/rod_solver.h"

namespace pedicel::cosserat {

/// Finds the static equilibrium nearest to the state under gravity, the model's supports and loads:
/// by Newton's method (settle()), and where that does not converge by letting the plant
/// sink there in steps of backward Euler that start from rest and grow longer. False where neither
/// ends at rest. `contacts` are what it touches without friction.
bool find_equilibrium(const RodModel& model, RodState& state, const Vec3& gravity,
                      std::span<const Load> loads, std::span<ContactSource* const> contacts = {});

/// Gives the model the shape in which its hung branches relaxed (is_hung()): that of
/// `unladen`, the same plant without what was hung on it for a trial, under gravity alone, from the
/// state on. False where it finds no rest.
bool hang(RodModel& model, const RodModel& unladen, RodState state, const Vec3& gravity);

}  // namespace pedicel::cosserat
