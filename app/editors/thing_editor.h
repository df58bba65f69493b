#pragma once

#include <string>

#include "app/ui/ui.h"

/// Plants as a whole, bodies, cameras, ground and robot: chosen, and in numbers.
namespace pedicel::app {

void choose_plant(Ui& ui, const std::string& name);
void choose_body(Ui& ui, const std::string& name);
void choose_camera(Ui& ui, const std::string& name);
void choose_ground(Ui& ui);

/// Copies the chosen one (of a stem or an organ: its plant) beside it.
void duplicate_thing(Ui& ui);
/// Deletes the chosen one; false: it is none of these.
bool remove_thing(Ui& ui);

/// Its place, turn, extents and name to be typed in; false: it is none of these.
bool draw_thing(Ui& ui);

}  // namespace pedicel::app
