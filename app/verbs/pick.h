#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace pedicel::app {

/// `pedicel pick FILE...`: how pulls on fruits ended, from the wrist's force. Returns what runs it.
std::function<int()> add_pick_verb(CLI::App& app);

}  // namespace pedicel::app
