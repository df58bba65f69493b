// Drives that cannot be right, and those that are only unusual.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/core/random.h"
#include "plugins/discrepancy/procedure/diagnosis.h"
#include "plugins/discrepancy/simulate/simulator.h"
#include "tests/unit/discrepancy/beam_experiment.h"

namespace pedicel::discrepancy {
namespace {

using ::testing::HasSubstr;

/// Bent by a rigid hold within a second, then held; the hand's force is measured.
Experiment bent(double modulus_factor) {
  Experiment e = testing::experiment_of({}, 2.0, 0.02);
  e.noise = {2.0e-4, 2.0e-3};
  Trial& trial = e.trials.front();
  trial.name = "bent";
  Hold hold{testing::on_stem(0.75), {}, std::numeric_limits<double>::infinity(), {}};
  for (double t = 0.0; t < 2.05; t += 0.1) {
    const double s = std::min(t, 1.0), aside = 0.02 * s * s * (3.0 - 2.0 * s);
    hold.path.time.push_back(t);
    // A cantilever's point comes nearer to its root by 3/5 y^2 / z.
    hold.path.position.emplace_back(aside, 0.0, 0.3 - 0.6 * aside * aside / 0.3);
  }
  trial.holds = {hold};
  Variant variant;
  variant.effects = {testing::effect("youngs_modulus", "factor", {modulus_factor})};
  Simulator simulator(e, {0.02, 1.0 / 960.0}, 1);
  const Simulator::Request request{&variant, 0};
  const Prediction seen = simulator.run(std::span(&request, 1)).front();
  Random random(3);
  trial.markers.value = seen.markers;
  trial.force.value = seen.force;
  for (double& x : trial.markers.value.reshaped()) x += 2.0e-4 * random.normal();
  for (double& x : trial.force.value.reshaped()) x += 2.0e-3 * random.normal();
  return e;
}

TEST(Drive, ThatTakesFarMoreThanTheMeasuredForceIsBadData) {
  Experiment e = bent(1.0);
  // 8 mm too high: the stem would have to be stretched.
  for (Vec3& p : e.trials.front().holds.front().path.position) p.z() += 0.008;
  const Verdict verdict = diagnose(e, {}).verdict;
  EXPECT_EQ(verdict.outcome, Outcome::bad_data) << headline(verdict);
  EXPECT_THAT(verdict.remainder, HasSubstr("the drive of trial \"bent\" cannot be right"));
}

TEST(Drive, OfAStemFarStifferThanItsFileIsPossible) {
  const Verdict verdict = diagnose(bent(6.0), {}).verdict;
  EXPECT_NE(verdict.outcome, Outcome::bad_data) << headline(verdict);
}

}  // namespace
}  // namespace pedicel::discrepancy
