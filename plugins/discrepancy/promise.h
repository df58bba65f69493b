#pragma once

#include <vector>

#include "discrepancy/candidates.h"

namespace pedicel::discrepancy {

/// Causes whose direction shows in what is left; the loudest dozen, loudest first.
std::vector<Cause> promising(const std::vector<Cause>& causes,
                             const std::vector<Direction>& directions);

}  // namespace pedicel::discrepancy
