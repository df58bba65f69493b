#pragma once

#include <vector>

#include "plugins/discrepancy/fit/causes.h"
#include "plugins/discrepancy/test/statistics.h"

namespace pedicel::discrepancy {

/// The largest directed statistic of each cause.
std::vector<double> score_statistics(const std::vector<Cause>& causes,
                                     const std::vector<Direction>& directions);

/// Causes whose direction shows in what is left; the `most` strongest, strongest first.
std::vector<Cause> screened(const std::vector<Cause>& causes,
                            const std::vector<Direction>& directions, int most);

}  // namespace pedicel::discrepancy
