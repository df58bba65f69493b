#pragma once

#include "pedicel/cosserat/model/rod_state.h"

namespace pedicel::cosserat {

/// What the joint at the near end of an element passes on (N and N m, in E): its elastic load
/// (joint_load()), and tau K times the rate of its strains by Kelvin-Voigt damping. Newton's law
/// for a fruit has both, and so has a load cell in its stalk. The clamp of a plant's first elements
/// is taken to stand.
JointLoad stalk_load(const RodModel& model, const RodState& state, int element);

}  // namespace pedicel::cosserat
