#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace pedicel::app {

/// `pedicel fit EXPERIMENT PARAMETER ... --out DIR`: parameters of the model from measured data,
/// with their intervals. Adds the verb to the command line; the result runs it and returns the
/// program's exit code.
std::function<int()> add_fit_verb(CLI::App& app);

}  // namespace pedicel::app
