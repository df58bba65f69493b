// What is wrong with data before any physics: made data with known faults, which must all be found,
// and nothing else.
#include "plugins/discrepancy/admission/admission.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/core/random.h"
#include "tests/unit/discrepancy/made_data.h"

namespace pedicel::discrepancy {
namespace {

using ::testing::HasSubstr;

// With a material and a mesh, without which the plant cannot be built.
MadeData noisy() {
  MadeData made;
  made.experiment.plant().material = {5.0e8, 0.3, 800.0, 0.01};
  made.experiment.plant().connect = 0.01;
  made.experiment.plant().distance = 0.05;
  // The weights act from the start: a plant does not jump from one sample to the next.
  Eigen::MatrixXd& weights = made.experiment.trials[1].markers.value;
  weights.rowwise() = Eigen::RowVectorXd(weights.bottomRows(1));
  made.add_noise(11);
  return made;
}

// A normal number lies 10 deviations out once in 1e23 times.
TEST(Admission, LeavesGoodDataAlone) {
  const MadeData made = noisy();
  const Admission admission = admit(made.experiment);
  EXPECT_EQ(admission.refusal, "");
  EXPECT_EQ(admission.outliers + admission.stuck + admission.swaps + admission.missing, 0);
  EXPECT_TRUE(admission.remarks.empty());
  EXPECT_EQ(admission.samples, 18 * (301 + 401 + 351) + 3 * 351);
  for (std::size_t t = 0; t < made.experiment.trials.size(); ++t)
    EXPECT_TRUE(admission.experiment.trials[t].markers.value ==
                made.experiment.trials[t].markers.value);
}

TEST(Admission, TakesOutOutliersAndNoOthers) {
  MadeData made = noisy();
  Samples& markers = made.experiment.trials[1].markers;
  Random random(12);
  std::vector<std::pair<int, int>> outliers;
  for (int i = 0; i < 10; ++i) outliers.push_back({20 + 38 * i, random.integer(0, 17)});
  for (const auto& [row, column] : outliers) markers.value(row, column) += 0.05;
  // Along two axes at once: still one point.
  markers.value(outliers[3].first, outliers[3].second / 3 * 3 + (outliers[3].second + 1) % 3) -=
      0.04;
  const Admission admission = admit(made.experiment);
  EXPECT_EQ(admission.outliers, 10);
  const Eigen::MatrixXd& kept = admission.experiment.trials[1].markers.value;
  for (const auto& [row, column] : outliers)
    EXPECT_TRUE(kept.row(row).segment(column / 3 * 3, 3).array().isNaN().all()) << row;
  EXPECT_EQ(kept.array().isNaN().count(), 30);
  EXPECT_EQ(admission.points, 6 * (301 + 401 + 351) + 351);
  EXPECT_NEAR(admission.outlier_fraction(), 10.0 / admission.points, 1e-12);
  ASSERT_EQ(admission.remarks.size(), 1u);
  EXPECT_EQ(admission.remarks[0], "10 samples are far from their neighbours and were left out");
}

// 11 deviations along each axis are 19 in all: no axis alone is beyond the limit of 10 deviations
// of what a sample has against its neighbours, 13.9 of its own.
TEST(Admission, TakesOutPointsThatAreOutAskew) {
  MadeData made = noisy();
  Samples& markers = made.experiment.trials[1].markers;
  for (int i = 0; i < 10; ++i)
    markers.value.block<1, 3>(20 + 38 * i, 3 * (i % 6)).array() +=
        (i % 2 ? 11.0 : -11.0) * MadeData::position_std;
  const Admission admission = admit(made.experiment);
  EXPECT_EQ(admission.outliers, 10);
  EXPECT_EQ(admission.experiment.trials[1].markers.value.array().isNaN().count(), 30);
}

TEST(Admission, PutsBackExchangedLabels) {
  MadeData made = noisy();
  Eigen::MatrixXd& value = made.experiment.trials[0].markers.value;
  const Eigen::MatrixXd right = value;
  for (int row = 100; row < 140; ++row) {  // m2 and m5 change places, and back
    value.block<1, 3>(row, 3) = right.block<1, 3>(row, 12);
    value.block<1, 3>(row, 12) = right.block<1, 3>(row, 3);
  }
  const Admission admission = admit(made.experiment);
  EXPECT_TRUE(admission.experiment.trials[0].markers.value == right);
  EXPECT_EQ(admission.swaps, 40);  // samples
  EXPECT_EQ(admission.outliers, 0);
}

TEST(Admission, TakesOutAChannelThatIsStuck) {
  MadeData made = noisy();
  Eigen::MatrixXd& value = made.experiment.trials[2].markers.value;
  value.block(200, 7, 60, 1).setConstant(value(200, 7));
  value.block(50, 3, 19, 1).setConstant(value(50, 3));  // one sample too few
  const Admission admission = admit(made.experiment);
  EXPECT_EQ(admission.stuck, 60);
  const Eigen::MatrixXd& kept = admission.experiment.trials[2].markers.value;
  EXPECT_TRUE(kept.block(200, 7, 60, 1).array().isNaN().all());
  EXPECT_EQ(kept.array().isNaN().count(), 60);
}

// A tracker's program fills gaps by straight lines or splines, which have no noise.
TEST(Admission, TakesOutGapsThatWereFilled) {
  MadeData made = noisy();
  Eigen::MatrixXd& value = made.experiment.trials[2].markers.value;
  const auto fill = [&](int from, int rows, int column, bool straight) {
    const Eigen::RowVector3d a = value.block<1, 3>(from, column);
    const Eigen::RowVector3d b = value.block<1, 3>(from + rows, column);
    for (int i = 1; i < rows; ++i) {
      const double u = static_cast<double>(i) / rows;
      value.block<1, 3>(from + i, column) = a + (straight ? u : u * u * (3.0 - 2.0 * u)) * (b - a);
    }
  };
  fill(100, 31, 6, true);
  fill(200, 41, 9, false);
  fill(250, 8, 0, true);  // too short to tell
  const Admission admission = admit(made.experiment);
  EXPECT_EQ(admission.refusal, "");
  EXPECT_EQ(admission.filled, 28 + 38);  // but for one at either end, whose neighbours are measured
  const Eigen::MatrixXd& kept = admission.experiment.trials[2].markers.value;
  EXPECT_TRUE(kept.block(102, 6, 28, 3).array().isNaN().all());
  EXPECT_TRUE(kept.block(202, 9, 38, 3).array().isNaN().all());
  EXPECT_THAT(admission.remarks, ::testing::Contains(HasSubstr("66 samples lie on smooth lines")));
}

// A simulation without noise, of which more is said than is in it, is no gap.
TEST(Admission, KeepsDataWithoutNoise) {
  MadeData made;
  made.experiment.noise.position_std = MadeData::position_std;
  EXPECT_EQ(admit(made.experiment).filled, 0);
}

// A pull of 50 deviations is let go, and the force is exactly zero from then on: nothing there is
// outlying, neither the jump nor the noise beside what does not scatter.
TEST(Admission, KeepsAForceThatIsLetGo) {
  MadeData made = noisy();
  Trial& push = made.experiment.trials[2];
  push.holds[0].release = 5.0;
  push.force.value.col(0).array() += 0.5;
  push.force.value.bottomRows(101).setZero();  // from 5 s on
  const Admission admission = admit(made.experiment);
  EXPECT_TRUE(admission.experiment.trials[2].force.value == push.force.value);
  EXPECT_EQ(admission.outliers, 0);
  EXPECT_EQ(admission.stuck, 0);
}

TEST(Admission, RefusesMillimetres) {
  MadeData made = noisy();
  for (Trial& trial : made.experiment.trials) trial.markers.value *= 1000.0;
  EXPECT_THAT(admit(made.experiment).refusal,
              HasSubstr("expected metres in the plant's own frame"));
}

TEST(Admission, RefusesWhatHoldsNothing) {
  MadeData made = noisy();
  made.experiment.trials[1].markers.value.setConstant(std::nan(""));
  EXPECT_THAT(admit(made.experiment).refusal,
              HasSubstr("markers.csv has no marker in any of its 401 rows: expected where they"));
  for (Trial& trial : made.experiment.trials) {
    trial.markers.value.setConstant(std::nan(""));
    trial.force.value.setConstant(std::nan(""));
  }
  EXPECT_THAT(admit(made.experiment).refusal, HasSubstr("in any of its 301 rows"));
  for (Trial& trial : made.experiment.trials) trial.markers = {};
  EXPECT_EQ(admit(made.experiment).refusal, "there is no sample at all");
}

TEST(Admission, CountsEmptyCells) {
  MadeData made = noisy();
  made.experiment.trials[0].markers.value.block(10, 0, 5, 3).setConstant(std::nan(""));
  const Admission admission = admit(made.experiment);
  EXPECT_EQ(admission.missing, 15);
  EXPECT_EQ(admission.refusal, "");
  EXPECT_THAT(admission.remarks, ::testing::ElementsAre("15 cells are empty"));
}

}  // namespace
}  // namespace pedicel::discrepancy
