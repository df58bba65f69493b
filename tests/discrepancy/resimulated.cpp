#include "tests/discrepancy/resimulated.h"

#include <cmath>
#include <stdexcept>

#include "tests/discrepancy/sensor_noise.h"

namespace pedicel::hidden {

namespace {

using discrepancy::Experiment;
using discrepancy::Trial;
using reference::Mesh;
using reference::Subject;
using reference::TrialPlan;

/// The interval that all samples of a trial keep to, s.
double interval_of(const Trial& trial) {
  const std::vector<double>& time = trial.markers.time;
  const double step = time.size() > 1 ? time[1] - time[0] : 0.0;
  for (std::size_t i = 0; i < time.size(); ++i)
    if (!(step > 0.0) || std::abs(time[i] - static_cast<double>(i) * step) > 1e-6)
      throw std::invalid_argument("trial \"" + trial.name +
                                  "\": expected samples at equal intervals from 0 on");
  return step;
}

reference::Rows rows_of(const discrepancy::DrivenPath& path) {
  return {path.time, path.position, path.rotation};
}

TrialPlan plan_of(const Trial& trial) {
  TrialPlan plan;
  plan.name = trial.name;
  plan.interval = interval_of(trial);
  plan.duration = trial.markers.time.back();
  plan.clock = trial.clock;
  plan.gravity = trial.gravity;
  plan.masses.assign(trial.masses.begin(), trial.masses.end());
  if (trial.window)
    throw std::invalid_argument("trial \"" + trial.name +
                                "\" begins in motion, expected one that begins at rest: what was "
                                "done before is not known");
  for (const discrepancy::Hold& hold : trial.holds) {
    if (hold.direction)
      throw std::invalid_argument("trial \"" + trial.name +
                                  "\" has a hold with direction: true, expected none");
    plan.holds.push_back(
        {hold.place, rows_of(hold.path), hold.release, hold.stiffness, hold.axes, hold.one_sided});
  }
  for (const discrepancy::TimedLoad& load : trial.loads)
    plan.loads.push_back({load.place, load.force, load.from, load.to});
  if (trial.base) plan.base = rows_of(*trial.base);
  plan.measures_force = trial.force.size() > 0;
  plan.measures_wrench = trial.wrench.size() > 0;
  plan.is_static = trial.is_static;
  return plan;
}

// What holds the plant takes it where it stands.
void follow_plant(Trial& trial, const Subject& hidden, const Mesh& mesh) {
  const Subject plain{hidden.plant, {}, {}};
  const TrialPlan plan = plan_of(trial);
  for (discrepancy::Hold& hold : trial.holds) {
    const Vec3 shift = settled_point(hidden, plan, hold.place, mesh) -
                       settled_point(plain, plan, hold.place, mesh);
    for (Vec3& p : hold.path.position) p += shift;
  }
}

}  // namespace

Experiment resimulated(Experiment experiment, const std::vector<plant::Effect>& effects,
                       const std::vector<reference::OutsideEffect>& outside,
                       const MeasuringOptions& options) {
  const Mesh mesh{options.mesh * experiment.plant().distance, options.dt};
  const Subject hidden{experiment.plant(), effects, outside};
  const double position_std = experiment.noise.position_std.value_or(0.0);
  const double force_std = experiment.noise.force_std.value_or(0.0);
  std::vector<reference::MarkerPlan> markers;
  for (const discrepancy::Marker& m : experiment.markers) markers.push_back({m.name, m.place});
  Random random(options.seed);
  for (Trial& trial : experiment.trials) {
    if (options.follow_plant) follow_plant(trial, hidden, mesh);
    Subject subject = hidden;
    for (const auto* known : {&experiment.effects, &trial.effects})
      subject.effects.insert(subject.effects.end(), known->begin(), known->end());
    reference::Record record = run_trial(subject, plan_of(trial), markers, mesh);
    if (!record.settled)
      throw std::invalid_argument("trial \"" + trial.name + "\": no equilibrium at time 0");
    if (!record.markers.allFinite())
      throw std::invalid_argument("trial \"" + trial.name + "\": the simulation diverged");
    add_noise(record.markers, position_std, options.rho, random);
    add_outliers(record.markers, subject.effects, position_std, random);
    trial.markers = {record.time, record.markers};
    if (record.force.rows() > 0) {
      add_noise(record.force, force_std, 0.0, random);
      trial.force = {record.time, record.force};
    }
    if (record.wrench.rows() > 0) {
      Eigen::MatrixXd force = record.wrench.leftCols(3), moment = record.wrench.rightCols(3);
      add_noise(force, force_std, 0.0, random);
      add_noise(moment, experiment.noise.moment_std.value_or(0.0), 0.0, random);
      trial.wrench.time = record.time;
      trial.wrench.value.resize(record.wrench.rows(), 6);
      trial.wrench.value << force, moment;
    }
  }
  return experiment;
}

}  // namespace pedicel::hidden
