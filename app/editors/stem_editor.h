#pragma once

#include <string>

#include "app/ui/ui.h"

namespace pedicel::app {

/// Chooses a stem of the document; the simulation's organ of the same name is highlighted, too.
void choose_curve(Ui& ui, const std::string& plant, const std::string& curve);
/// Chooses a fruit that is still on.
void choose_fruit(Ui& ui, const std::string& plant, const std::string& fruit);
/// Chooses a leaf.
void choose_leaf(Ui& ui, const std::string& plant, const std::string& leaf);

/// The stem of the document that the selection is of (a curve, or an element with its name); null
/// where there is none.
const plant::PlantCurve* chosen_curve(const Ui& ui, std::string& plant);

/// The chosen thing in numbers that can be typed in.
void draw_details(Ui& ui);

}  // namespace pedicel::app
