#pragma once

#include <algorithm>

namespace pedicel::cosserat {

/// How large Newton's change of one plant is in an iteration.
struct NewtonChange {
  double turn = 0.0;     ///< rad, largest of an element
  double shift = 0.0;    ///< 1, largest, in element lengths
  double largest = 0.0;  ///< m or rad, of any unknown

  /// rad or element lengths, whichever is more.
  double motion() const { return std::max(turn, shift); }
};

}  // namespace pedicel::cosserat
