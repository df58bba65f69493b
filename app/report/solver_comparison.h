#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/report/sweep.h"

namespace pedicel::app {

/// A sweep over the distance between nodes, with the direct solver and with the position-based one
/// of the paper, and what either costs at equal error.
struct SolverComparison {
  std::string quantity;  ///< what is measured, with its unit

  struct Row {
    double distance = 0.0;  ///< m
    double direct = 0.0, position_based = 0.0;
  };
  std::vector<Row> rows;

  /// A run at the plants' own distance.
  struct Speed {
    std::string solver;
    int substeps = 1;
    double measured = 0.0;
    double error = 0.0;  ///< from `fine`, in the quantity's unit
    double real_time_factor = 0.0;
  };
  double fine_distance = 0.0;  ///< m: an eighth of the sweep's smallest one
  double fine = 0.0;           ///< measured with the direct solver there
  std::vector<Speed> speeds;   ///< the direct solver, then the other with ever more sub-steps
  /// The last two errors are at most 1.1 times that of the direct solver (two: a plant that still
  /// swings may pass by the right place).
  bool equal = false;
};

/// Repeats a sweep over sampling.distance whose `runs` the direct solver made with the other
/// solver; then doubles the sub-steps of that one until its error is that of the direct solver at
/// the scene's own settings, or until there are 4096. Nothing for other sweeps.
std::optional<SolverComparison> compare_solvers(const world::Scene& scene,
                                                const std::vector<SweepRun>& runs,
                                                const RunOptions& options);

/// As a table with units in its header, one line a run.
std::string to_csv(const SolverComparison& comparison);

}  // namespace pedicel::app
