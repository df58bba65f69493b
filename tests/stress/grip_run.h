#pragma once

#include <string>

#include "tests/stress/grip_case.h"

namespace pedicel::stress {

/// What became of a grip.
struct GripOutcome {
  std::string fault;           ///< empty where it passed
  double force_used = 0.0;     ///< 1, of the joint's effort and friction: largest, filtered
  double sunk = 0.0;           ///< 1, deepest overlap with a finger, of the radius there
  double friction_used = 0.0;  ///< 1, of mu times the normal forces, while it was held
  double seconds = 0.0;        ///< of wall time
  int unsolved = 0;            ///< steps that did not converge
  bool gripped = false, lost = false, broken = false;
};

/// Runs it to its end. It fails where
///  - the run ends as unstable, or a number is not finite;
///  - the fingers press with more than effort and friction of their joint, by 10 %: the sum of both
///    fingers' normal forces along the way that they open, from the contacts' forces, through a
///    low-pass of 20 ms (a step is 4.2 ms), unless they are pushed open to their stops;
///  - a finger, on the way that it closes, sinks in by more than 0.8 of the radius of what it
///    touches;
///  - what was held is lost although friction never had to carry nine tenths of what it can, and
///    nothing broke.
GripOutcome run_grip(const GripCase& one);

}  // namespace pedicel::stress
