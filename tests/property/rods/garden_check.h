#pragma once

#include <string>

#include "tests/property/rods/random_garden.h"

namespace pedicel::plain {

/// What a garden's check found. Figures are parts of what is allowed (1: all of it).
struct Outcome {
  std::string fault;      ///< empty: none
  double residual = 0.0;  ///< 1, of the lanes' solution in the plain solver's system
  double change = 0.0;    ///< 1, Newton's change that the plain solver still finds at a step's end
  double distance = 0.0;  ///< 1, of the plain solver's own minimum
  int solved = 0, steps = 0;  ///< of plants
  int valleys = 0;            ///< steps of plants that ended in another minimum
};

/// Newton's system of the garden's first step, solved by the lanes on one and two threads with
/// every instruction set that this processor has, put into the plain solver's system.
void check_solution(const Garden& garden, Outcome& outcome);

/// The garden's steps in a RodSystem: the same bits on one and two threads and, for one plant,
/// alone; all numbers finite; velocities, memory and what is left of the potential's gradient are
/// the plain solver's; instruction sets agree.
void check_steps(const Garden& garden, Outcome& outcome);

Outcome check_garden(const Garden& garden);

}  // namespace pedicel::plain
