#pragma once

#include "app/ui/ui.h"

namespace pedicel::app {

/// The model extensions of a plant (wind, a soft base, yield, ...): each with its numbers and its
/// place, to add and take away. Every change is one `set effects`.
void draw_effects(Ui& ui, const std::string& plant);

}  // namespace pedicel::app
