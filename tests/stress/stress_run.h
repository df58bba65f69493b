#pragma once

#include <string>

#include "tests/stress/stress_case.h"

namespace pedicel::stress {

/// What came of a case.
struct Outcome {
  std::string fault;  ///< what went wrong first, one sentence; empty: it passed
  /// 1, largest: energy found beyond what was put in, against what is allowed (EnergyLedger).
  double excess = 0.0;
  /// 1, largest: stretch and shear of a segment, against what the energy allowed could do to it.
  double strain_used = 0.0;
  double strain = 0.0;  ///< 1, largest stretch and shear of a segment
  int rough_steps = 0;  ///< that the solver itself reports as not converged
  int contacts = 0;     ///< most in one step
  int broken = 0;       ///< fruits that came off
};

/// Runs a case as the program does: colliders move, then the rods, and checks after every step that
/// every number is finite, that the energy is bounded, and that no organ is off its joint: by its
/// stretch and shear gamma alone a segment holds 1/2 l gamma . K gamma, which no more energy than
/// is allowed can bring about. Ends at the first fault.
Outcome run_case(const StressCase& one);

}  // namespace pedicel::stress
