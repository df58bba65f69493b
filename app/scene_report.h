#pragma once

#include <vector>

#include "app/headless.h"

namespace pedicel::app {

/// One value of a sweep and its run.
struct SweepRun {
  double value = 0.0;
  RunResult result;
};

/// Writes report.html, and sweep.csv where there was a sweep, into the folder of `result`: what the
/// scene is for, its pictures, the plots of log.csv that matter, events, expectations, numbers.
/// Throws io::WriteError.
void write_scene_report(const world::Scene& scene, const RunResult& result,
                        const std::vector<SweepRun>& sweep);

}  // namespace pedicel::app
