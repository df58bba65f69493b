#pragma once

#include <string>

#include "plugins/discrepancy/select/verdict.h"
#include "plugins/plant/plant_file.h"

namespace pedicel::hidden {

/// How near a named cause came to the hidden one. Compared is the size that data can tell, in which
/// the effect vanishes at 0 (a factor 1.02 where 1.04 was hidden is wrong by half):
///
/// | cause | size |
/// |---|---|
/// | factors, `gain` | less 1 |
/// | `anisotropy` | abs(ln ratio): one direction's ratio is the other's inverse |
/// | `weak_segment` | (1/factor - 1) length, the turn that a moment adds |
/// | `asymmetry` | abs(coefficient) / k0: either sign about one axis or its opposite |
/// | `material_nonlinearity` | coefficient / k0^2 |
/// | `internal_friction` | ratio curvature, the moment of slip over EI |
/// | `creep` | fraction / time, the rate over a trial far shorter than it |
/// | `wind`, `gust` | drag_area |velocity|^2, the force at rest |
/// | `grip_compliance` | 1/stiffness less that of the stated grip |
/// | `marker_offset`, `frame_rotation` | the vector |
/// | others | their first parameter |
struct SizeError {
  std::string cause;
  double error = 0.0;           ///< |said - true| / |true|; NaN where nothing can be compared
  int inside = 0, entries = 0;  ///< components of the size, and how many 95 % intervals hold them
  /// |at - true at| where both name a place on the same curve; NaN else.
  double place = 0.0;
};

/// Intervals of products are those of their factors' corners, so wider than 95 %.
/// `grip_stiffness` (N/m) is what the drives state.
SizeError size_error(const plant::Effect& truth, const discrepancy::NamedCause& said,
                     double grip_stiffness);

}  // namespace pedicel::hidden
