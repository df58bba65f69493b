#pragma once

#include <span>

#include "plugins/cosserat/solver/block_system.h"
#include "plugins/cosserat/solver/rod_solver.h"

namespace pedicel::cosserat {

/// Adds the second derivatives of a plant's potential at `state`: elasticity with the forces that
/// it carries, supports and welds, and dead forces (weights, `loads`) that act off the nodes. Exact
/// at an equilibrium but for the forces in supports and welds. Not positive definite beyond
/// buckling. At an unstrained state without gravity and loads it is the linear stiffness.
void add_exact_hessian(const RodModel& model, const RodState& state, const Vec3& gravity,
                       std::span<const Load> loads, BlockSystem& system);

}  // namespace pedicel::cosserat
