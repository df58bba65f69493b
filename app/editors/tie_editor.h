#pragma once

#include "app/ui/ui.h"

/// Strings that hold plants: chosen, and in numbers.
namespace pedicel::app {

/// By its number in the scene's list, from 0.
void choose_tie(Ui& ui, int tie);
/// The chosen string of the document; null where there is none.
const world::SceneTie* chosen_tie(const Ui& ui);
/// Its ends, length and stiffness to be typed in.
void draw_tie(Ui& ui);

}  // namespace pedicel::app
