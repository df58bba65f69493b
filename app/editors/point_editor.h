#pragma once

#include <string>

#include "app/ui/ui.h"
#include "plugins/plant/point_kind.h"

namespace pedicel::app {

/// The control points of a stem: their kinds, their numbers, and buttons that change them.
void draw_points(Ui& ui, const std::string& plant, const plant::PlantCurve& curve);

// What the keys do with the chosen point; each says what to choose where nothing fits.
/// The next kind: smooth, corner, linear.
void change_point_kind(Ui& ui);
void set_point_kind(Ui& ui, plant::PointKind kind);
/// Half way to the next point; of a whole stem in its longest piece.
void insert_point(Ui& ui);
/// The chosen point, or all of the chosen stem.
void smooth_points(Ui& ui);

}  // namespace pedicel::app
