#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "plugins/discrepancy/data/experiment.h"
#include "plugins/discrepancy/select/verdict.h"

namespace pedicel::discrepancy {

/// Something to point at in a drawing of the plant.
struct SketchMark {
  std::string label, colour;
  std::vector<plant::CurvePlace> places;  ///< ringed
  /// A part of a curve, from and to as fractions of its length, drawn broad.
  std::optional<std::pair<plant::CurvePlace, double>> stretch;
  bool whole_plant = false;       ///< all curves drawn broad
  bool markers = false;           ///< all markers ringed
  std::optional<Vec3> direction;  ///< W, horizontal: the view shows it
};

/// Where a cause sits on the experiment's plant.
SketchMark mark_of(const Experiment& experiment, const NamedCause& cause,
                   const std::string& colour);

/// One <svg> element: the plant's curves as drawn, from the side that shows most of them (or the
/// marks' directions), its markers with their names, the ground, a scale, and the marks.
std::string plant_sketch(const Experiment& experiment, const std::vector<SketchMark>& marks);

}  // namespace pedicel::discrepancy
