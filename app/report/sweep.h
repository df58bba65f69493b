#pragma once

#include "app/report/headless.h"

namespace pedicel::app {

/// One value of a sweep and its run.
struct SweepRun {
  double value = 0.0;
  SceneResult result;
};

/// The scene of one value of its sweep: what is expected over the sweep is measured in its run, and
/// the rest, which the scene expects of its own value, is not asked.
world::Scene scene_of_value(const world::Scene& scene, double value);

/// How its run is done: alone, quietly, without video.
RunOptions options_of_value(const RunOptions& options);
/// Its folder, "sweep_detach.stretch=0.1".
std::string folder_of_value(const world::Scene& scene, double value);

/// The line on standard error that tells of one value; not where `options` are quiet.
void say_value(const world::Scene& scene, const SweepRun& run, const RunOptions& options);

/// What run_with_sweep() makes of the scene's own run and those of the values, wherever they were
/// done: judges what is expected over the sweep, compares solvers, writes the report into the
/// output of `result`. `result` comes back with the sweep's verdicts.
SceneResult end_sweep(const world::Scene& scene, const RunOptions& options, SceneResult result,
                      const std::vector<SweepRun>& runs);

/// What a sweep is measured by: the quantity that the scene expects to change, else the first one;
/// null where it expects nothing.
const world::Expectation* measured_by(const world::Scene& scene);

/// What a run measured of the thing that an expectation is about; NaN where it did not.
double measured_in(const world::Expectation& wanted, const SceneResult& run);

}  // namespace pedicel::app
