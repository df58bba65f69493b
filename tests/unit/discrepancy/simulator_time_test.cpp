// Frequencies after a release, and the order of convergence in the time step where forces jump.
#include <gtest/gtest.h>

#include "engine/core/ring_down.h"
#include "plugins/discrepancy/simulate/simulator.h"
#include "tests/unit/discrepancy/beam_experiment.h"

namespace pedicel::discrepancy {
namespace {

using testing::Beam;
using testing::experiment_of;
using testing::on_stem;

Eigen::MatrixXd markers(const Experiment& experiment, double distance, double dt) {
  Simulator simulator(experiment, {distance, dt}, 1);
  const Variant variant;
  const Simulator::Request request{&variant, 0};
  return simulator.run({&request, 1}).front().markers;
}

// f1 = 1.8751^2 / (2 pi L^2) sqrt(EI / (rho A)). Pulled at the tip, higher modes start at 3 % and
// less; the mesh (20 elements) errs by 3e-3, the step by (w dt)^2/3 = 2e-4.
TEST(SimulatorInTime, AReleaseRingsAtTheFirstFrequency) {
  const Beam beam;
  Experiment experiment = experiment_of(beam, 3.0, 0.005);
  experiment.trials[0].holds = {
      {on_stem(1.0), testing::resting_at(Vec3(0.004, 0, beam.length)), 0.1, 50.0}};
  const Eigen::MatrixXd found = markers(experiment, 0.02, 1.0 / 1920);
  std::vector<double> tip;
  for (int s = 40; s < found.rows(); ++s) tip.push_back(found(s, 3));
  const auto ring = ring_down(tip, 0.005);
  ASSERT_TRUE(ring);
  const double expected = 1.8751 * 1.8751 / (2.0 * M_PI * beam.length * beam.length) *
                          std::sqrt(beam.stiffness() / beam.mass_per_length());
  EXPECT_NEAR(ring->frequency / expected, 1.0, 4e-3);
}

/// Halving the step thrice: by how much the error falls the last time, the finest taken for the
/// truth. A second-order scheme gives (16 - 1) / (4 - 1) = 5, a first-order one 3.
double fall(const Experiment& experiment) {
  const auto at = [&](double rate) { return markers(experiment, 0.02, 1.0 / rate); };
  const Eigen::MatrixXd truth = at(3840.0);
  return (at(960.0) - truth).norm() / (at(1920.0) - truth).norm();
}

Experiment damped() {
  Experiment experiment = experiment_of({}, 0.5, 0.013);
  experiment.plant().material.damping_time = 0.01;
  return experiment;
}

// At times that no step of equal length meets.
TEST(SimulatorInTime, AReleaseKeepsSecondOrder) {
  Experiment experiment = damped();
  experiment.trials[0].holds = {
      {on_stem(0.8), testing::resting_at(Vec3(0.03, 0.01, 0.32)), 0.1234, 60.0}};
  EXPECT_GT(fall(experiment), 4.2);
}

TEST(SimulatorInTime, StepsOfALoadKeepSecondOrder) {
  Experiment experiment = damped();
  experiment.trials[0].loads = {{on_stem(1.0), Vec3(0.02, 0, 0), 0.0711, 0.2503}};
  EXPECT_GT(fall(experiment), 4.2);
}

}  // namespace
}  // namespace pedicel::discrepancy
