#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace pedicel::app {

/// `pedicel diagnose EXPERIMENT --out DIR`: what the simulation of an experiment gets wrong. Adds
/// the verb to the command line; the result runs it and returns the program's exit code.
std::function<int()> add_diagnose_verb(CLI::App& app);

}  // namespace pedicel::app
