#pragma once

#include <string>

#include "plugins/simulation/simulation.h"

namespace pedicel::simulation {

/// The longest row of steps in which a plant found no equilibrium: it is squeezed by what does not
/// give way, or folded flat, and inexact there.
class RoughSpell {
 public:
  /// After every step.
  void look(const Simulation& simulation, const world::WorldReport& report);
  /// "warning: no equilibrium in 212 steps in a row from 0.8 s: p/stem, pressed by ..."; empty
  /// where none was long enough to be said.
  std::string warning() const;

 private:
  void look_for_folds(const Simulation& simulation);

  int row_ = 0, longest_ = 0;  // steps
  double from_ = 0.0;          // s
  std::string text_;           // of the longest one
  std::string folded_;         // the first stem that lay flat on itself; empty: none
};

}  // namespace pedicel::simulation
