#pragma once

#include <vector>

#include "discrepancy/causes.h"
#include "discrepancy/statistics.h"

namespace pedicel::discrepancy {

/// The largest directed statistic of each cause.
std::vector<double> promise_of(const std::vector<Cause>& causes,
                               const std::vector<Direction>& directions);

/// Causes whose direction shows in what is left; the loudest dozen, loudest first.
std::vector<Cause> promising(const std::vector<Cause>& causes,
                             const std::vector<Direction>& directions);

}  // namespace pedicel::discrepancy
