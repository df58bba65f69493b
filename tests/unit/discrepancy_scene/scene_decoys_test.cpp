#include "plugins/discrepancy/scene_procedure/scene_decoys.h"

#include <gtest/gtest.h>

#include "plugins/discrepancy/settings/diagnosis_settings.h"
#include "tests/unit/discrepancy_scene/arm_at_stem.h"

namespace pedicel::discrepancy {
namespace {

// Two models whose predictions differ by a ramp of one marker, and data that say what is asked.
class SceneDecoys : public testing::Test {
 protected:
  SceneDecoys() {
    at_.write_all();
    experiment_ = at_.read();
    const Trial& trial = experiment_.trials.front();
    without_.markers = Eigen::MatrixXd::Zero(trial.markers.size(), trial.markers.value.cols());
    for (const Samples& pixels : trial.pixels)
      without_.pixels.push_back(Eigen::MatrixXd::Zero(pixels.size(), pixels.value.cols()));
    for (const Samples& wrench : trial.wrenches)
      without_.wrenches.push_back(Eigen::MatrixXd::Zero(wrench.size(), wrench.value.cols()));
    without_.torques = Eigen::MatrixXd::Zero(trial.torques.size(), trial.torques.value.cols());
    with_ = without_;
    with_.markers.col(0) = ramp();
  }
  Eigen::VectorXd ramp() const {
    return Eigen::VectorXd::LinSpaced(without_.markers.rows(), 0.0, 0.1).cwiseAbs2();  // to 10 mm
  }
  Decoys of(const Eigen::MatrixXd& measured) {
    experiment_.trials.front().markers.value = measured;
    const SceneDataSet data(experiment_);
    const int trial = 0;
    return scene_decoys(experiment_, data, {&trial, 1}, {&without_, 1}, {&with_, 1},
                        Evidence{}.too_alike);
  }
  ArmAtStem at_;
  Experiment experiment_;
  SceneReadings without_, with_;
};

TEST_F(SceneDecoys, LoseWhereTheDataAreTheChange) {
  const Decoys decoys = of(with_.markers);
  EXPECT_GT(decoys.own, 1.0);
  EXPECT_LT(decoys.reversed, 0.5 * decoys.own);
  EXPECT_LT(decoys.exchanged, 1.0e-6 * decoys.own);
  EXPECT_TRUE(decoys.lose(5.0));
}

TEST_F(SceneDecoys, WinWhereTheDataAreItBackwards) {
  Eigen::MatrixXd backwards = without_.markers;
  backwards.col(0) = ramp().reverse();
  EXPECT_FALSE(of(backwards).lose(5.0));
}

TEST_F(SceneDecoys, WinWhereTheNeighbourShowsIt) {
  Eigen::MatrixXd elsewhere = without_.markers;
  elsewhere.col(6) = ramp();
  const Decoys decoys = of(elsewhere);
  EXPECT_GT(decoys.exchanged, 1.0);
  EXPECT_FALSE(decoys.lose(5.0));
}

}  // namespace
}  // namespace pedicel::discrepancy
