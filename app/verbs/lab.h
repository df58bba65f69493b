#pragma once

#include <cstddef>
#include <functional>
#include <nlohmann/json.hpp>

#include "plugins/discrepancy/select/verdict.h"

namespace CLI {
class App;
}

namespace pedicel::app {

/// `pedicel lab TRUTH EXPERIMENT --rounds N --out DIR`: diagnoses an experiment, does the
/// experiment that it asks for on a hidden truth, takes the answer in, and so on. Returns what runs
/// it.
std::function<int()> add_lab_verb(CLI::App& app);

/// An entry of lab.json: how many trials a round had, and what was said of them.
nlohmann::ordered_json lab_round(int round, std::size_t trials,
                                 const discrepancy::Verdict& verdict);

}  // namespace pedicel::app
