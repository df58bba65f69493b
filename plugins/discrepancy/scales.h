#pragma once

#include "discrepancy/experiment.h"

namespace pedicel::discrepancy {

/// Rough sizes of an experiment, from which candidates take their first values.
struct Scales {
  double length = 0.0;          ///< m, of the longest curve
  double mass = 0.0;            ///< kg, of the plant
  double root_stiffness = 0.0;  ///< N m/rad, EI/length at the root
  double curvature = 0.0;       ///< 1/m, the largest that the measured motion needs
  double duration = 0.0;        ///< s, of the longest trial
  double sample_time = 0.0;     ///< s, between samples
};
Scales scales_of(const Experiment& experiment);

}  // namespace pedicel::discrepancy
