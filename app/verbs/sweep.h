#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace pedicel::app {

/// `pedicel sweep SCENE --set key=v1,v2,...` or `--param-sweep TABLE`: a scene for several values,
/// here or as tasks of a cluster. Adds the verb to the command line; the result runs it and returns
/// the program's exit code.
std::function<int()> add_sweep_verb(CLI::App& app);

}  // namespace pedicel::app
