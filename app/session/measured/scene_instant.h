#pragma once

#include <vector>

#include "app/session/measured/measured_instant.h"
#include "app/session/measured/measured_scene.h"

namespace pedicel::app {

/// Markers and plants of a measured scene at a time of a trial, linear between samples.
struct SceneInstant {
  std::vector<MarkerInstant> markers;  ///< in the experiment's order; NaN where nothing is known
  std::vector<Vec3> shape;             ///< m, W, points of shapes_of(); empty: not known
};
SceneInstant scene_instant_of(const MeasuredScene& scene, int trial, discrepancy::Model model,
                              double time);

/// A marker in a camera's picture (px); NaN where it was not seen or is not known.
struct ImageInstant {
  Eigen::Vector2d measured, simulated;
};
/// One a marker; none where that camera measured nothing in the trial.
std::vector<ImageInstant> image_instant_of(const MeasuredScene& scene, int trial,
                                           discrepancy::Model model, int camera, double time);

/// A column of an instrument over a trial, in the instrument's unit, for plots.
MeasuredSeries scene_series_of(const MeasuredScene& scene, int trial,
                               const SceneInstrument& instrument, int column);

}  // namespace pedicel::app
