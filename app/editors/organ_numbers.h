#pragma once

#include "app/ui/ui.h"

namespace pedicel::app {

/// Where the chosen thing is now in the world, with a button that leads the robot's tool there.
void draw_place(Ui& ui);
/// The button alone.
void tool_to_selection_button(Ui& ui);

/// What a fruit comes off at, as it acts now: the tuned numbers where somebody has tuned them, with
/// a word about it. What is typed is this fruit's; a tuned number is written into the plant first.
void draw_thresholds(Ui& ui, const std::string& plant, const plant::PlantFruit& fruit);

/// The numbers of a fruit or a leaf that stand in its entry of the plant file.
void draw_fruit_numbers(Ui& ui, const std::string& plant, const plant::PlantFruit& fruit);
void draw_leaf_numbers(Ui& ui, const std::string& plant, const plant::PlantLeaf& leaf);

/// The material of a stem, as it acts now: its own numbers, or the plant's until one is typed.
void draw_stem_material(Ui& ui, const std::string& plant, const plant::PlantCurve& curve);

/// Masses fixed to a stem, and clamps that hold it (ties, stakes): to add, move and take away.
void draw_stem_loads(Ui& ui, const std::string& plant, const plant::PlantCurve& curve);

}  // namespace pedicel::app
