#pragma once

#include "plugins/discrepancy/simulate/data_set.h"

namespace pedicel::discrepancy {

/// Tells the data set how each trial that begins in motion answers to how it begins, by simulations
/// of the variant: what is left of its residuals is then across that.
void find_start_directions(Simulator& simulator, const Variant& variant, DataSet& data);

}  // namespace pedicel::discrepancy
