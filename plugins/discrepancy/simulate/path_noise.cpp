#include "plugins/discrepancy/simulate/path_noise.h"

#include <algorithm>

#include "plugins/discrepancy/simulate/trial_run.h"

namespace pedicel::discrepancy {

namespace {

constexpr double usual_junction = 0.05;  // as Numerics has it

/// Channels of one trial at time 0, at rest.
class Still {
 public:
  Still(const PlantMaker& maker, const Experiment& experiment)
      : maker_(maker), experiment_(experiment) {}

  Eigen::VectorXd channels(const Trial& trial) const {
    RunMember nominal;
    nominal.effects = experiment_.effects;
    nominal.effects.insert(nominal.effects.end(), trial.effects.begin(), trial.effects.end());
    StepPlan none;
    none.time = {0.0};
    const std::atomic<bool> no_stop{false};
    const RunResult result =
        run_trial(maker_, experiment_, trial, none, {&nominal, 1}, no_stop).front();
    const std::vector<double> begin{0.0};
    const Observed seen =
        observe(result.motion, experiment_.markers, nominal.effects, begin, begin, begin);
    const Eigen::Index force = trial.force.value.cols(), wrench = trial.wrench.value.cols();
    Eigen::VectorXd all(seen.markers.cols() + force + wrench);
    all << seen.markers.transpose(), seen.force.transpose().topRows(force),
        seen.wrench.transpose().topRows(wrench);
    return all;
  }

 private:
  const PlantMaker& maker_;
  const Experiment& experiment_;
};

std::vector<DrivenPath*> paths_of(Trial& trial) {
  std::vector<DrivenPath*> paths;
  for (Hold& hold : trial.holds) paths.push_back(&hold.path);
  if (trial.base) paths.push_back(&*trial.base);
  return paths;
}

PathNoise of_trial(const Still& still, const Trial& given, double std) {
  Trial trial = given;
  PathNoise noise;
  for (const Hold& hold : trial.holds) noise.until = std::max(noise.until, hold.release);
  if (trial.base) noise.until = std::numeric_limits<double>::infinity();
  for (DrivenPath* path : paths_of(trial))
    for (int axis = 0; axis < 3; ++axis) {
      const auto moved = [&](double way) {
        for (Vec3& place : path->position) place[axis] += way;
        const Eigen::VectorXd there = still.channels(trial);
        for (Vec3& place : path->position) place[axis] -= way;
        return there;
      };
      const Eigen::VectorXd change = 0.5 * (moved(std) - moved(-std));
      if (!change.allFinite()) continue;  // it cannot be led there
      if (noise.variance.size() == 0) noise.variance.setZero(change.size());
      noise.variance += change.cwiseAbs2();
    }
  return noise;
}

}  // namespace

std::vector<PathNoise> path_noise(const Experiment& experiment) {
  std::vector<PathNoise> all(experiment.trials.size());
  if (!experiment.noise.path_std) return all;
  const double distance = experiment.plant().distance;
  const PlantMaker maker(experiment, distance, usual_junction * distance);
  const Still still(maker, experiment);
  for (std::size_t t = 0; t < all.size(); ++t)
    all[t] = of_trial(still, experiment.trials[t], *experiment.noise.path_std);
  return all;
}

}  // namespace pedicel::discrepancy
