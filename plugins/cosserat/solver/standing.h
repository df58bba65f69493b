#pragma once

#include <span>

#include "plugins/cosserat/model/rod_state.h"
#include "plugins/cosserat/solver/rod_solver.h"

namespace pedicel::cosserat {

/// How well a plant stands as drawn.
struct Standing {
  /// False: a joint, support or weld would have to be bent by more than 2.5 rad at rest.
  bool solvable = true;
  int element = -1;                ///< it; where solvable, the one that is bent most at rest
  double largest_rest_bend = 0.0;  ///< rad
};

/// Finds the unloaded rest shape with which the drawn shape is an equilibrium under gravity: one
/// pass from the leaves to the root gives the force and moment in every joint, and
/// rest = drawn strain - compliance x load (exact in a tree, where the loads are determinate).
///
/// With supports and welds the loads are indeterminate, and those of least elastic energy are
/// taken, springs included. They are what the linear stiffness of the drawn shape gives
/// (Castigliano), so that without gravity the plant is free of stress to first order; the pass then
/// balances them exactly. Supports are moved and turned to carry their share. A weld carries its
/// own through a gap of force / stiffness, by which this moves the drawn node of the later of its
/// elements. Call it again where the model or gravity changes.
Standing stand_as_drawn(RodModel& model, const Vec3& gravity);

/// How far a plant settles from where it was drawn.
struct Residual {
  double largest = 0.0, rms = 0.0;  ///< m, over the nodes
  int element = -1;                 ///< whose node moves most; -1: none moves
  bool settled = true;              ///< false: no equilibrium was found, the distances are a guess
};

/// The residual of stand_as_drawn(): the distances between the nodes as they were in `drawn`,
/// before it, and where `standing`, its result, comes to rest under gravity (settle()).
Residual settled_from(const RodModel& drawn, const RodModel& standing, const Vec3& gravity);

/// Whether the drawn shape is a stable equilibrium: all eigenvalues of the exact Hessian of the
/// potential are positive (their signs are read off the pivots of the block elimination). Beyond
/// its buckling load (Greenhill) a plant that stands as drawn falls over at the first touch.
bool is_stable(const RodModel& model, const RodState& state, const Vec3& gravity,
               std::span<const Load> loads = {});

}  // namespace pedicel::cosserat
