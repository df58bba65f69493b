#pragma once

#include "pedicel/app/report/headless.h"

namespace pedicel::app {

/// One value of a sweep and its run.
struct SweepRun {
  double value = 0.0;
  SceneResult result;
};

/// The scene of one value of its sweep: what is expected over the sweep is measured in its run, and
/// the rest, which the scene expects of its own value, is not asked.
world::Scene scene_of_value(const world::Scene& scene, double value);

/// What a sweep is measured by: the quantity that the scene expects to change, else the first one;
/// null where it expects nothing.
const world::Expectation* measured_by(const world::Scene& scene);

/// What a run measured of the thing that an expectation is about; NaN where it did not.
double measured_in(const world::Expectation& wanted, const SceneResult& run);

}  // namespace pedicel::app
