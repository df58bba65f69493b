#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace pedicel::app {

/// Adds the verb `dataset`. What it returns runs it, with the exit code.
std::function<int()> add_dataset_verb(CLI::App& app);

}  // namespace pedicel::app
