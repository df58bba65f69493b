#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace pedicel::app {

/// `pedicel transfer EXTENDED EXPERIMENT`: whether a named effect helps with another plant. Returns
/// what runs it.
std::function<int()> add_transfer_verb(CLI::App& app);

}  // namespace pedicel::app
