#pragma once

#include <imgui.h>

#include <string>

#include "app/ui/ui.h"

namespace pedicel::app {

/// What came off, how and when, in one line.
std::string break_text(const world::Event& event);

/// Keeps what has been of the run while it goes back and forth, and tells of breaks as they come.
void follow_run(Ui& ui);

/// The run's time from 0 to where it has been, with a mark where something came off: click or drag
/// to go there. Draws into [low, high] px.
void draw_time_line(Ui& ui, const ImVec2& low, const ImVec2& high);
/// px that it takes; 0 where there is nothing to show.
float time_line_height(const Ui& ui);

}  // namespace pedicel::app
