#pragma once

#include "plugins/cosserat/lanes/lanes.h"
#include "plugins/cosserat/lanes/loop_shape.h"

namespace pedicel::cosserat {

/// What the elimination of a pack of loop parts works on. Nothing of it lasts: a thread has one,
/// which stays in its core's cache.
struct alignas(64) LoopWork {
  /// Lower triangle by rows, then the right side, of each element and of what carries them.
  Lanes diagonal[LoopShape::most_elements + 1][block_size];
  Lanes entry[LoopShape::most_entries][36];  ///< by columns
  Lanes weighted[LoopShape::most_in_column][36];
};

/// That of the caller's thread.
LoopWork& loop_work();

}  // namespace pedicel::cosserat
