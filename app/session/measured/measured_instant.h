#pragma once

#include <vector>

#include "app/session/measured/measured_data.h"

namespace pedicel::app {

/// A marker at a time of a trial. Places are NaN where nothing was measured or simulated.
struct MarkerInstant {
  Vec3 measured, simulated;  ///< m, W
  Vec3 error() const { return measured - simulated; }
};

/// What was measured and what a model says at a time of a trial, linear between samples.
struct MeasuredInstant {
  double time = 0.0;                   ///< s, within the trial
  std::vector<MarkerInstant> markers;  ///< in the experiment's order
  double rms = 0.0;                    ///< m, of the markers that were seen; NaN: none was
  std::vector<Vec3> shape;             ///< m, W, points of MeasuredData::shape(); empty: not known
};

/// Time is kept within the trial; nothing where there is no such trial or it has no markers.
std::optional<MeasuredInstant> instant_of(const MeasuredData& data, int trial,
                                          discrepancy::Model model, double time);

/// One coordinate of a marker, or of the force, over a trial, for plots.
struct MeasuredSeries {
  std::vector<double> time;      ///< s, within the trial
  std::vector<double> measured;  ///< m or N; NaN where it was not seen
  std::array<std::vector<double>, discrepancy::model_count> models;  ///< empty: not known
};
/// `axis` 0, 1, 2: x, y, z.
MeasuredSeries series_of(const MeasuredData& data, int trial, int marker, int axis);
/// The pull on the plant at the first hold (N); `axis` 0, 1, 2: x, y, z, 3: its size. Nothing where
/// none was measured.
std::optional<MeasuredSeries> force_series_of(const MeasuredData& data, int trial, int axis);

}  // namespace pedicel::app
