#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace pedicel::app {

/// `pedicel lab TRUTH EXPERIMENT --rounds N --out DIR`: diagnoses an experiment, does the
/// experiment that it asks for on a hidden truth, takes the answer in, and so on. Returns what runs
/// it.
std::function<int()> add_lab_verb(CLI::App& app);

}  // namespace pedicel::app
