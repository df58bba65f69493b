// What is left of the plant's own motion: seen along its shapes, not across them, whatever the
// colour of the noise.
#include "plugins/discrepancy/test/residual_power.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/discrepancy/made_data.h"

namespace pedicel::discrepancy {
namespace {

constexpr double hz = 1.3;
const std::vector<int> trials{0, 2};

/// Made data with noise and, in the trials `moved`, a swing.
struct Left {
  MadeData made;
  FitSummary model;
  Eigen::VectorXd swing;  // whitened, by itself

  /// `along` m each marker moves at z = 1 m height; noise whose correlation is `real`, taken for
  /// `believed`.
  Left(std::uint64_t seed, double real, double believed, const Vec3& along,
       const std::vector<int>& moved = {trials.back()}) {
    DataSet data = data_of(believed);
    made.add_noise(seed, real);
    model.residual = residual(data, 1.0);
    model.jacobian = (residual(data, 1.0) - residual(data, 1.1)) / 0.1;
    made.change([&](int trial, double t, int, const Vec3& p) -> Vec3 {
      return std::ranges::find(moved, trial) != moved.end()
                 ? Vec3(p.z() * std::sin(2.0 * M_PI * hz * t) * along)
                 : Vec3(Vec3::Zero());
    });
    swing = residual(data, 1.0) - model.residual;
    model.residual += swing;
  }

  ResidualPower found(const Eigen::VectorXd& numerical = {}) const {
    return residual_power(data_of(0.0), trials, model, numerical, {});
  }

 private:
  DataSet data_of(double correlation) const {
    DataSet data(made.experiment);
    data.set_noise(MadeData::noise_of(MadeData::position_std, correlation),
                   MadeData::noise_of(MadeData::force_std, 0.0));
    return data;
  }

  // Of the predictions with their motion, from where each trial begins, times `factor`.
  Eigen::VectorXd residual(const DataSet& data, double factor) const {
    Eigen::VectorXd all(data.size(trials));
    Eigen::Index place = 0;
    for (const int t : trials) {
      Prediction p = made.predictions[t];
      const Eigen::RowVectorXd first = p.markers.row(0);
      p.markers = (factor * (p.markers.rowwise() - first)).rowwise() + first;
      const Eigen::Index size = data.size(std::span(&t, 1));
      data.residual(t, p, 1.0, all.segment(place, size));
      place += size;
    }
    return all;
  }
};

TEST(ResidualPower, NoiseShowsNothing) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    EXPECT_LT(Left(seed, 0.0, 0.0, Vec3::Zero()).found().deviations, 5.0) << seed;
    EXPECT_LT(Left(seed, 0.8, 0.8, Vec3::Zero()).found().deviations, 5.0) << seed;
    // Taken for less coloured than it is, it has too much power at low frequencies, in all
    // directions alike.
    EXPECT_FALSE(Left(seed, 0.8, 0.6, Vec3::Zero()).found().shows()) << seed;
  }
}

// The plant moves along x. A swing of 0.4 of the noise's deviation at the tip is nowhere seen in a
// sample; over n samples of m markers its square is A^2 n m / 2 in noise units.
TEST(ResidualPower, ASwingOfThePlantShows) {
  const ResidualPower found = Left(3, 0.0, 0.0, Vec3(2e-4, 0, 0)).found();
  EXPECT_TRUE(found.shows()) << found.deviations;
  EXPECT_EQ(found.trial, trials.back());
  EXPECT_LE(found.low_hz, hz + 0.2);
  EXPECT_GE(found.high_hz, hz - 0.2);
}

// What is too small for either trial shows in both together: at the same amplitude the ratio of the
// F test stays and its degrees of freedom double, and so its deviations grow by about sqrt(2).
TEST(ResidualPower, WhatIsSmallInEachTrialShowsInAll) {
  const Vec3 small(1.5e-4, 0, 0);
  const ResidualPower one = Left(3, 0.0, 0.0, small).found();
  const ResidualPower both = Left(3, 0.0, 0.0, small, trials).found();
  EXPECT_FALSE(one.shows()) << one.deviations;
  EXPECT_TRUE(both.shows()) << both.deviations;
  EXPECT_TRUE(both.in_all);
  EXPECT_NEAR(both.low_hz, hz, 0.2);
}

// One sample in 70 stands 30 deviations out, at one place of the plant and along its motion.
TEST(ResidualPower, OutliersAreNoMotion) {
  Left left(3, 0.0, 0.0, Vec3::Zero());
  for (Eigen::Index i = 5; i < left.model.residual.size(); i += 70) left.model.residual[i] += 30.0;
  EXPECT_FALSE(left.found().shows());
}

TEST(ResidualPower, WhatThePlantDoesNotDoIsNoise) {
  EXPECT_FALSE(Left(3, 0.0, 0.0, Vec3(0, 2e-4, 0)).found().shows());
}

TEST(ResidualPower, OurOwnErrorIsTakenOff) {
  const Left left(3, 0.0, 0.0, Vec3(2e-4, 0, 0));
  EXPECT_FALSE(left.found(left.swing).shows());
}

TEST(ResidualPower, NeedsTheModelsDerivatives) {
  Left left(3, 0.0, 0.0, Vec3(2e-4, 0, 0));
  left.model.jacobian.resize(0, 0);
  EXPECT_EQ(left.found().trial, -1);
}

}  // namespace
}  // namespace pedicel::discrepancy
