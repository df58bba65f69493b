#pragma once

#include <span>

#include "engine/core/random.h"
#include "plugins/discrepancy/simulate/simulator.h"
#include "tests/unit/discrepancy/beam_experiment.h"

namespace pedicel::discrepancy::testing {

/// A beam held aside by 30 mm and let go after 0.2 s, simulated with `numerics` and measured with
/// white noise of this size (m); its plant file has nodes every `distance` m.
inline Experiment released_beam(double noise, double distance, const Numerics& numerics) {
  Beam beam;
  beam.damping_time = 0.01;
  Experiment e = experiment_of(beam, 1.0, 0.02);
  e.plant().distance = distance;
  Trial& trial = e.trials[0];
  trial.force = {};
  trial.gravity = Vec3(0, 0, -9.81);
  trial.holds.push_back({on_stem(0.8), resting_at(Vec3(0.03, 0, 0.8 * beam.length)), 0.2, 20.0});
  const Variant nominal;
  Simulator simulator(e, numerics, 1);
  const Simulator::Request request{&nominal, 0};
  Eigen::MatrixXd seen = simulator.run(std::span(&request, 1)).front().markers;
  Random random(5);
  for (double& x : seen.reshaped()) x += noise * random.normal();
  trial.markers.value = seen;
  return e;
}

}  // namespace pedicel::discrepancy::testing
