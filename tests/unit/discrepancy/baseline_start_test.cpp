// Which parameters data see, on a weightless beam whose tip is pulled aside: it stands at
// d = F L^3 / 3EI, and with a modulus a tenth larger at d / 1.1.
#include "plugins/discrepancy/fit/baseline_start.h"

#include <gtest/gtest.h>

#include "tests/unit/discrepancy/beam_experiment.h"

namespace pedicel::discrepancy {
namespace {

using testing::Beam;

constexpr double deflection = 0.004;  // m

Experiment pulled_aside() {
  Experiment experiment = testing::experiment_of({}, 0.05);
  const Vec3 force(deflection * Beam().tip_stiffness(), 0, 0);
  experiment.trials[0].loads = {{testing::on_stem(1.0), force, -1.0, 1.0}};
  return experiment;
}

class BaselineStart : public ::testing::Test {
 protected:
  /// The tip moves by so many times the noise.
  void set_noise(double seen) {
    const double moved = deflection * (1.0 - 1.0 / 1.1);
    data_.set_noise(white_noise(moved / seen), white_noise(1.0));
  }

  const Experiment experiment_ = pulled_aside();
  DataSet data_{experiment_};
  Simulator simulator_{experiment_, {0.04, 1.0 / 240}, 1};
  Evaluator evaluator_{simulator_, data_};
  FitOptions options_{{0}};
  std::vector<std::string> unseen_;
};

TEST_F(BaselineStart, LeavesOutWhatMovesNothing) {
  set_noise(0.2);
  EXPECT_EQ(baseline_start(evaluator_, options_, unseen_).size(), 1);
  EXPECT_EQ(unseen_, (std::vector<std::string>{"density", "damping_time"}));
}

// The noise was first read as far too large.
TEST_F(BaselineStart, TakesBackWhatIsPlainlySeenWithAnotherNoise) {
  set_noise(0.05);
  Hypothesis base = baseline_start(evaluator_, options_, unseen_);
  EXPECT_EQ(base.size(), 0);
  EXPECT_EQ(unseen_.size(), 3u);
  set_noise(0.2);  // seen, but not plainly
  EXPECT_FALSE(add_plainly_seen(evaluator_, options_, unseen_, base));
  set_noise(0.5);
  EXPECT_TRUE(add_plainly_seen(evaluator_, options_, unseen_, base));
  ASSERT_EQ(base.size(), 1);
  EXPECT_EQ(base.factor_on("youngs_modulus"), 0);
  EXPECT_EQ(base.value(0), 1.0);
  EXPECT_EQ(unseen_, (std::vector<std::string>{"density", "damping_time"}));
  EXPECT_FALSE(add_plainly_seen(evaluator_, options_, unseen_, base));
}

}  // namespace
}  // namespace pedicel::discrepancy
