#include "plugins/discrepancy/simulate/trial_run.h"

#include <cmath>

#include "plugins/cosserat/solver/rod_system.h"
#include "plugins/discrepancy/simulate/grip.h"
#include "plugins/discrepancy/simulate/trial_member.h"

namespace pedicel::discrepancy {

namespace {

// Of a beginning in motion. Each run leaves a tenth or less of what was wrong before it, however
// far the plant is bent.
constexpr int rehearsals = 5;

/// Newton's, of a step. Measured on releases of a stem of 0.6 m with two branches (90 elements,
/// steps of 1/960 s): 1e-7 leaves the markers within 5 um of the converged steps (rms 0.5 um). That
/// is still 0.2 nats of scatter in a fit's cost, which the derivatives feel (differences.cpp). The
/// elimination's factors are of single precision: on a stiff stem an iteration leaves a hundredth
/// there, so that 1e-8 stops with as much of it, where a fit ended a third of the way along its
/// valley.
cosserat::RodSettings solver_settings() {
  cosserat::RodSettings settings;
  settings.newton_iterations = 12;
  settings.tolerance = 1.0e-10;
  return settings;
}

bool failed(const cosserat::StepReport& report) {
  return report.errors & (cosserat::not_finite | cosserat::not_converged);
}

void simulate(std::vector<TrialMember>& members, const Trial& trial, const StepPlan& plan,
              bool rehearses, const std::atomic<bool>& stop) {
  cosserat::RodSystem rods(solver_settings());
  int working = 0;
  for (TrialMember& member : members) {
    member.enter(rods, rehearses);
    working += member.healthy() ? 1 : 0;
  }
  for (int k = 0; k < plan.steps() && working > 0; ++k) {
    const double begin = plan.time[k], end = plan.time[k + 1];
    for (int p = 0; p < rods.size(); ++p)
      members[p].drive(rods, p, begin, end, plan.restart[k] != 0);
    rods.step(plan.dt[k], trial.gravity);
    for (int p = 0; p < rods.size(); ++p) {
      TrialMember& member = members[p];
      if (!member.healthy()) continue;
      if (failed(rods.report(p)) || stop) {
        member.fail();
        --working;
      } else {
        member.record(rods.state(p), rods.detached(p), k + 1, begin, end);
      }
    }
  }
}

}  // namespace

Eigen::MatrixXd tracking_at_samples(const RunResult& result, const Samples& markers) {
  Eigen::MatrixXd out;
  out.setConstant(markers.size(), markers.value.cols(), std::numeric_limits<double>::quiet_NaN());
  for (int s = 0; s < markers.size(); ++s) {
    const Interval at = find_interval(result.motion.time, markers.time[s]);
    if (at.row < 0) continue;
    out.row(s) = result.tracking.row(at.row);
    if (at.length > 0.0)
      out.row(s) = (1.0 - at.share) * out.row(s) + at.share * result.tracking.row(at.row + 1);
    out.row(s) = markers.value.row(s).array().isNaN().select(0.0, out.row(s));
  }
  return out;
}

std::vector<double> jumps_of(const Trial& trial, std::span<const plant::Effect> effects) {
  std::vector<double> times = slip_times(effects);
  for (const MeasuredEvent& event : trial.events)
    if (event.is_detachment()) times.push_back(event.time);
  for (const Hold& hold : trial.holds) times.push_back(hold.release);
  for (const TimedLoad& load : trial.loads) times.insert(times.end(), {load.from, load.to});
  return times;
}

std::vector<RunResult> run_trial(const PlantMaker& maker, const Experiment& experiment,
                                 const Trial& trial, const StepPlan& plan,
                                 std::span<const RunMember> given, const std::atomic<bool>& stop,
                                 const StepPlan& rehearsal) {
  std::vector<TrialMember> members;
  members.reserve(given.size());
  for (const RunMember& one : given) {
    members.emplace_back(maker, experiment, trial, one, std::max(plan.steps(), rehearsal.steps()));
    members.back().settle();
  }
  if (trial.is_static) {
    for (TrialMember& member : members)
      for (int row = 0; row <= plan.steps() && !stop && member.healthy(); ++row)
        member.settle_row(row);
  } else {
    if (rehearsal.steps() > 0) {
      for (TrialMember& member : members) member.prepare_start();
      for (int i = 0; i < rehearsals && !stop; ++i) {
        simulate(members, trial, rehearsal, true, stop);
        for (TrialMember& member : members) member.learn();
      }
    }
    simulate(members, trial, plan, false, stop);
  }
  std::vector<RunResult> results;
  results.reserve(members.size());
  for (TrialMember& member : members) results.push_back(member.take());
  return results;
}

}  // namespace pedicel::discrepancy
