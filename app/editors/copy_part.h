#pragma once

#include <string>

#include "app/ui/ui.h"

namespace pedicel::app {

/// Copies of a stem with everything on it: mirrored, and up its parent, by exact numbers.
void draw_copies(Ui& ui, const std::string& plant, const std::string& stem);

}  // namespace pedicel::app
