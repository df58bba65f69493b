#pragma once

#include <span>

#include "cosserat/rod_solver.h"
#include "cosserat/rod_state.h"

namespace pedicel::cosserat {

/// How well a plant stands as drawn.
struct Standing {
  bool solvable = true;  ///< false: a joint would have to be bent by more than 2.5 rad at rest
  int element = -1;      ///< that joint
  double largest_rest_bend = 0.0;  ///< rad
};

/// Finds the unloaded rest shape with which the drawn shape is an equilibrium under gravity: one
/// pass from the leaves to the root gives the force and moment in every joint, and
/// rest = drawn strain - compliance x load (exact in a tree, where the loads are determinate). With
/// supports the loads are indeterminate: the supports' reactions are chosen that make the elastic
/// energy of the drawn shape least. Welds carry nothing in the drawn shape.
Standing stand_as_drawn(RodModel& model, const Vec3& gravity);

/// Whether the drawn shape is a stable equilibrium: all eigenvalues of the exact Hessian of the
/// potential are positive (their signs are read off the pivots of the block elimination). Beyond
/// its buckling load (Greenhill) a plant that stands as drawn falls over at the first touch.
bool is_stable(const RodModel& model, const RodState& state, const Vec3& gravity,
               std::span<const Load> loads = {});

}  // namespace pedicel::cosserat
