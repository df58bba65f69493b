#pragma once

#include <filesystem>

#include "app/ui/ui.h"

namespace pedicel::app {

/// Within a popup: what can be added to the scene.
void draw_add_menu(Ui& ui);

/// Adds a robot and shows its panel; a fault is shown.
void add_robot(Ui& ui, const std::filesystem::path& file);

}  // namespace pedicel::app
