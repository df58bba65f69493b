#pragma once

#include "plugins/cosserat/model/rod_model.h"

namespace pedicel::cosserat {

/// Turns the frame of an element of a finished model about its third axis by `angle` (rad), and
/// with it everything that is given in that frame, so that the plant moves as before: rest
/// rotations and strains, stiffnesses, inertias, supports and welds. Exact where both directions of
/// the section are equal; else the products between the turned axes are left out of shear and
/// rotary inertia (second order in the slenderness), of bending and of supports. Before the plant
/// has a state.
void turn_frame(RodModel& model, int element, double angle);

/// Makes a joint `ratio` times as stiff when it is bent towards `direction` (W, projected on the
/// cross-section as drawn), and as stiff as before across it: K' = S K S with
/// S = 1 + (sqrt(ratio) - 1) a a^T, a the axis of that bend. The element's frame is turned to the
/// principal axes of K', so that it stays diagonal. A direction along the segment changes nothing.
void make_anisotropic(RodModel& model, int element, double ratio, const Vec3& direction);

}  // namespace pedicel::cosserat
