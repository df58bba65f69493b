#pragma once

#include <span>

#include "pedicel/cosserat/model/rod_model.h"
#include "pedicel/cosserat/model/rod_state.h"
#include "pedicel/cosserat/solver/rod_solver.h"

namespace pedicel::discrepancy {

/// Finds the static equilibrium nearest to the state under gravity, the model's supports and loads:
/// by Newton's method (cosserat::settle()), and where that does not converge by letting the plant
/// sink there in steps of backward Euler that start from rest and grow longer. False where neither
/// ends at rest. `contacts` are what it touches without friction.
bool find_equilibrium(const cosserat::RodModel& model, cosserat::RodState& state,
                      const Vec3& gravity, std::span<const cosserat::Load> loads,
                      std::span<cosserat::ContactSource* const> contacts = {});

/// Gives the model the shape in which its hung branches relaxed (cosserat::is_hung()): that of
/// `unladen`, the same plant without what was hung on it for a trial, under gravity alone, from the
/// state on. False where it finds no rest.
bool hang(cosserat::RodModel& model, const cosserat::RodModel& unladen, cosserat::RodState state,
          const Vec3& gravity);

}  // namespace pedicel::discrepancy
