#pragma once

#include <atomic>
#include <span>
#include <vector>

#include "plugins/discrepancy/simulate/moving_start.h"
#include "plugins/discrepancy/simulate/observation.h"
#include "plugins/discrepancy/simulate/simulator.h"
#include "plugins/discrepancy/simulate/step_plan.h"
#include "plugins/discrepancy/simulate/variant_plant.h"

namespace pedicel::discrepancy {

/// One plant of a group that is simulated side by side.
struct RunMember {
  std::vector<plant::Effect> effects;  ///< of the plant and the grip; others are passed over
  std::span<const PointForce> forces;
  double tracking_stiffness = 0.0;  ///< N/m, of springs from the markers to their measured paths
  bool records_stalks = false;
  const StartPlan* start = nullptr;   ///< how it begins in motion; null: at rest
  std::vector<double> start_shift{};  ///< m, Variant::start_shift
};

struct RunResult {
  Motion motion;
  Motion::Rows tracking;           ///< steps x 3 markers, N, W: the pull of those springs
  std::vector<StalkLoads> stalks;  ///< of the fruits, where wanted
};

/// Simulates one trial with several variants of the plant side by side, in the caller's thread.
/// Fruits come off when the experiment recorded it, where it did: what was done to the plant after
/// that is not another model's to choose. Else they do so by their thresholds.
/// A trial that begins in motion is run up to the end of `rehearsal` first, again and again, until
/// the plant begins as its first samples say. In a static series each step is a row.
/// What a member gives depends on nothing but itself. Ends early, with motions that are not
/// healthy, once `stop` is set.
std::vector<RunResult> run_trial(const PlantMaker& maker, const Experiment& experiment,
                                 const Trial& trial, const StepPlan& plan,
                                 std::span<const RunMember> members, const std::atomic<bool>& stop,
                                 const StepPlan& rehearsal = {});

/// The springs' pulls at the samples (samples x 3 markers, N, W), zero where a marker was not seen.
Eigen::MatrixXd tracking_at_samples(const RunResult& result, const Samples& markers);

/// When forces jump in a trial (s): its loads, releases, fruits that came off, and what the effects
/// add.
std::vector<double> jumps_of(const Trial& trial, std::span<const plant::Effect> effects);

}  // namespace pedicel::discrepancy
