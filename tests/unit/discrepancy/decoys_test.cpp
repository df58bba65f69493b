// A change that is in the data, against the same change in the wrong places.
#include "plugins/discrepancy/select/decoys.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "plugins/discrepancy/settings/diagnosis_settings.h"
#include "tests/unit/discrepancy/made_data.h"

namespace pedicel::discrepancy {
namespace {

const DiagnosisSettings settings;

constexpr std::array release{0};

struct Residuals {
  MadeData made;
  DataSet data{made.experiment};

  // Of the release, in noise units, after `by` was added to what was measured.
  Eigen::VectorXd after(const MadeData::Change& by) {
    made.change(by);
    data.set_noise(white_noise(MadeData::position_std), white_noise(MadeData::force_std));
    Eigen::VectorXd r(data.size(release));
    data.residual(0, made.predictions[0], 1.0, r);
    return r;
  }
};

// Millimetres along x, which die out.
Vec3 dying(double t) {
  return Vec3(1e-3 * std::exp(-t), 0, 0);
}

TEST(Decoys, OfAChangeThatDiesOutAtOneMarkerLose) {
  Residuals residuals;
  const Eigen::VectorXd r = residuals.after(
      [](int, double t, int marker, const Vec3&) { return marker == 2 ? dying(t) : Vec3::Zero(); });
  const Decoys decoys = decoys_of(residuals.data, release, r, r, settings.evidence.too_alike);
  EXPECT_NEAR(decoys.own, 0.5 * r.squaredNorm(), 1e-6 * decoys.own);
  EXPECT_EQ(decoys.exchanged, 0.0);  // no other marker moved
  // Cosine of exp(-t) and exp(t - T) over T = 6 s: T exp(-T) / (1 - exp(-2 T)) x 2.
  const double cosine = 2.0 * 6.0 * std::exp(-6.0) / (1.0 - std::exp(-12.0));
  EXPECT_NEAR(decoys.reversed / decoys.own, cosine * cosine, 0.1 * cosine * cosine);
  EXPECT_TRUE(decoys.lose(settings.levels.clear_margin));
}

// What was fitted dies out at marker 3, what is in the data is at its neighbour.
TEST(Decoys, WinWhereTheChangeIsInTheWrongPlace) {
  Residuals measured, fitted;
  const Eigen::VectorXd r = measured.after(
      [](int, double t, int marker, const Vec3&) { return marker == 1 ? dying(t) : Vec3::Zero(); });
  const Eigen::VectorXd change = fitted.after([](int, double t, int marker, const Vec3&) {
    return marker == 2 ? dying(t) : marker == 1 ? Vec3(0.1 * dying(t)) : Vec3::Zero();
  });
  EXPECT_FALSE(decoys_of(measured.data, release, r, change, settings.evidence.too_alike)
                   .lose(settings.levels.clear_margin));
}

TEST(Decoys, OfAConstantSayNothingBackwards) {
  Residuals residuals;
  const Eigen::VectorXd r = residuals.after([](int, double, int marker, const Vec3&) {
    return marker == 2 ? Vec3(1e-3, 0, 0) : Vec3::Zero();
  });
  const Decoys decoys = decoys_of(residuals.data, release, r, r, settings.evidence.too_alike);
  EXPECT_EQ(decoys.reversed, 0.0);
  EXPECT_TRUE(decoys.lose(settings.levels.clear_margin));
}

}  // namespace
}  // namespace pedicel::discrepancy
