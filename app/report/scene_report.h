#pragma once

#include <optional>
#include <vector>

#include "app/report/solver_comparison.h"
#include "app/report/sweep.h"

namespace pedicel::app {

/// Writes report.html, sweep.csv where there was a sweep, and solvers.csv where there is a
/// comparison, into the folder of `result`: what the scene is for, its pictures, the plots of
/// log.csv that matter, events, expectations, numbers. Throws io::WriteError.
void write_scene_report(const world::Scene& scene, const SceneResult& result,
                        const std::vector<SweepRun>& sweep,
                        const std::optional<SolverComparison>& comparison);

}  // namespace pedicel::app
