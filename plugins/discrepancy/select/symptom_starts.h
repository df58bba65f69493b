#pragma once

#include <string>
#include <vector>

#include "plugins/discrepancy/fit/causes.h"
#include "plugins/discrepancy/test/symptoms.h"

namespace pedicel::discrepancy {

/// Lets the symptoms of a model that is extended lead the causes: how clearly they speak for each,
/// and starts with the sizes that their numbers give (effects::Sign). What an earlier model's
/// symptoms said is forgotten; a cause that none speaks for stays as it is. Returns the sizes in
/// words, "latency delay 0.0296 by time_shift"; empty where there are none.
std::string lead(std::vector<Cause>& causes, const std::vector<Symptom>& symptoms,
                 const effects::StartContext& context);

/// Indices of the causes in the order in which first parts are fitted: those that symptoms speak
/// for, the clearest first, then the others by `score`.
std::vector<int> symptoms_first(const std::vector<Cause>& causes, const std::vector<double>& score);

}  // namespace pedicel::discrepancy
