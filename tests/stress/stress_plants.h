#pragma once

#include "engine/core/random.h"
#include "tests/stress/stress_case.h"

namespace pedicel::stress {

/// Draws the plant of a case whose modulus and damping time are set: a random tree (with sections
/// of every kind, fruits, masses, supports and loops), one that ships, or a digitised tree.
void draw_plant(Random& random, StressCase& one);

}  // namespace pedicel::stress
