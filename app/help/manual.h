#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace pedicel::app {

/// `pedicel manual [PAGE]`: the manual in a browser where there is one, else the page as text. Adds
/// the verb to the command line; the result runs it and returns the program's exit code.
std::function<int()> add_manual_verb(CLI::App& app);

}  // namespace pedicel::app
