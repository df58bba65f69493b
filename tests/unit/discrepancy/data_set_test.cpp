// Residuals in units of the noise, of an experiment whose predictions are written down.
#include "plugins/discrepancy/simulate/data_set.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "tests/unit/discrepancy/coloured_noise.h"
#include "tests/unit/discrepancy/made_data.h"

namespace pedicel::discrepancy {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::array all{0, 1, 2};
constexpr std::array release{0};

Eigen::VectorXd residual_of(const DataSet& data, int trial, const Prediction& prediction,
                            double horizon = 1.0) {
  Eigen::VectorXd r(data.size(std::span(&trial, 1)));
  data.residual(trial, prediction, horizon, r);
  return r;
}

// 18 channels of 301 samples. The mean square of n = 5418 white numbers scatters by sqrt(2 / n) =
// 0.019, their lag-one correlation by 1 / sqrt(n) = 0.014; five times that is allowed.
TEST(DataSet, WhitensColouredNoiseToUnitInnovations) {
  MadeData made;
  made.add_noise(3, 0.9);
  DataSet data(made.experiment);
  const Noise position = MadeData::noise_of(MadeData::position_std, 0.9);
  data.set_noise(position, white_noise(MadeData::force_std));
  const Eigen::VectorXd r = residual_of(data, 0, made.predictions[0]);
  ASSERT_EQ(r.size(), 18 * 301);
  EXPECT_NEAR(testing::power(r), 1.0, 0.095);
  EXPECT_NEAR(testing::lag_one(r), 0.0, 0.07);
  const Eigen::MatrixXd raw = data.scaled_residual(0, made.predictions[0]);
  EXPECT_GT(testing::lag_one(raw.col(4)), 0.7);
}

// Markers' columns one after the other, then the force's.
TEST(DataSet, CountsEntriesAndSamples) {
  MadeData made;
  DataSet data(made.experiment);
  EXPECT_EQ(data.size(release), 18 * 301);
  EXPECT_EQ(data.size(all), 18 * (301 + 401 + 351) + 3 * 351);
  EXPECT_EQ(data.samples(all), data.size(all));
  EXPECT_EQ(data.samples(release, 0.5), 18 * 151);  // up to 3 s, which counts
  made.experiment.trials[0].markers.value(7, 2) = nan;
  EXPECT_EQ(data.samples(release), 18 * 301 - 1);
}

TEST(DataSet, LeavesAGapAtZeroAndStartsAfreshAfterIt) {
  MadeData made;
  Samples& markers = made.experiment.trials[0].markers;
  for (const int row : {9, 10, 11}) markers.value(row, 4) += 0.001 * row;
  markers.value(10, 4) = nan;
  DataSet data(made.experiment);
  data.set_noise(MadeData::noise_of(5e-4, 0.6), white_noise(1.0));
  const Eigen::VectorXd r = residual_of(data, 0, made.predictions[0]).segment(4 * 301, 301);
  const double innovation = 5e-4 * 0.8;  // sqrt(1 - 0.6^2)
  EXPECT_NEAR(r[8], 0.0, 1e-9);
  EXPECT_NEAR(r[9], 0.009 / innovation, 1e-6);
  EXPECT_EQ(r[10], 0.0);
  EXPECT_NEAR(r[11], 0.011 / 5e-4, 1e-6);
  EXPECT_NEAR(r[12], -0.6 * 0.011 / innovation, 1e-6);
  EXPECT_NEAR(r[13], 0.0, 1e-6);
}

TEST(DataSet, CutsAtTheHorizonAndCountsAFailedPredictionHigh) {
  MadeData made;
  made.change([](int, double, int, const Vec3&) { return Vec3(1e-3, 0, 0); });
  DataSet data(made.experiment);
  data.set_noise(white_noise(1e-3), white_noise(1.0));
  const Eigen::VectorXd whole = residual_of(data, 0, made.predictions[0]);
  const Eigen::VectorXd half = residual_of(data, 0, made.predictions[0], 0.5);
  EXPECT_NEAR(whole[300], 1.0, 1e-9);
  EXPECT_NEAR(half[150], 1.0, 1e-9);
  EXPECT_EQ(half[151], 0.0);
  Prediction failed = made.predictions[0];
  failed.markers.bottomRows(100).setConstant(nan);
  EXPECT_NEAR(residual_of(data, 0, failed)[300], 1000.0, 1e-9);
}

TEST(DataSet, MeasuresRmsOverTheNoise) {
  MadeData made;
  made.change([](int trial, double, int, const Vec3&) {
    return trial == 0 ? Vec3(3e-3, 0, 0) : Vec3(0, 1e-3, 1e-3);
  });
  DataSet data(made.experiment);
  data.set_noise(white_noise(1e-3), white_noise(1.0));
  EXPECT_NEAR(data.rms(release, made.predictions), std::sqrt(9.0 / 3.0), 1e-9);
  const double markers = 18.0 * (301 * 9.0 + 401 * 2.0 + 351 * 2.0) / 3.0;
  EXPECT_NEAR(data.rms(all, made.predictions), std::sqrt(markers / data.size(all)), 1e-9);
  EXPECT_EQ(data.rms({}, made.predictions), 0.0);
}

TEST(DataSet, EstimatesItsNoiseFromWhatAModelLeaves) {
  MadeData made;
  made.add_noise(4, 0.5);
  DataSet data(made.experiment);
  AllSeries series;
  for (int t = 0; t < 3; ++t) data.raw_residuals(t, made.predictions[t], series);
  EXPECT_EQ(series.position.size(), 3 * 18u);
  EXPECT_EQ(series.force.size(), 3u);
  data.choose_noise(series, {});
  EXPECT_NEAR(data.position_noise().std / MadeData::position_std, 1.0, 0.06);
  EXPECT_NEAR(data.position_noise().correlation(), 0.5, 0.06);
  // 1053 samples of one correlation: a sixth of the accuracy.
  EXPECT_NEAR(data.force_noise().std / MadeData::force_std, 1.0, 0.3);
  made.experiment.noise.position_std = 1e-4;
  data.choose_noise(series, {});
  EXPECT_DOUBLE_EQ(data.position_noise().std, 1e-4);
}

}  // namespace
}  // namespace pedicel::discrepancy
