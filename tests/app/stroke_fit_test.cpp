#include "app/window/stroke_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"

namespace pedicel::app {
namespace {

std::vector<Vec3> arc(int count) {
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    const double t = 1.6 * i / (count - 1);
    points.push_back(0.2 * Vec3(std::cos(t), std::sin(t), 0.3 * t));
  }
  return points;
}

TEST(StrokeFit, StaysWithinTheToleranceWithFewPoints) {
  const std::vector<Vec3> stroke = arc(200);
  for (const double tolerance : {0.0005, 0.002, 0.01}) {
    const std::vector<Vec3> points = fit_stroke(stroke, {tolerance, true, 0.9, 40});
    EXPECT_LT(fit_error(stroke, points), 1.3 * tolerance) << tolerance;
    EXPECT_LE(points.size(), 12u) << tolerance;
  }
  EXPECT_GT(fit_stroke(stroke, {0.0003, true, 0.9, 40}).size(),
            fit_stroke(stroke, {0.01, true, 0.9, 40}).size());
}

TEST(StrokeFit, EndsWhereTheStrokeEnds) {
  const std::vector<Vec3> stroke = arc(50), points = fit_stroke(stroke, {});
  EXPECT_LT((points.front() - stroke.front()).norm(), 1e-12);
  EXPECT_LT((points.back() - stroke.back()).norm(), 1e-12);
}

TEST(StrokeFit, ACornerStaysSharp) {
  std::vector<Vec3> stroke;
  for (int i = 0; i <= 40; ++i) stroke.push_back(Vec3(0.005 * i, 0, 0));
  for (int i = 1; i <= 40; ++i) stroke.push_back(Vec3(0.2, 0.005 * i, 0));
  const auto nearest = [&](const std::vector<Vec3>& points) {
    double best = 1.0;
    for (const Vec3& p : points) best = std::min(best, (p - Vec3(0.2, 0, 0)).norm());
    return best;
  };
  EXPECT_LT(nearest(fit_stroke(stroke, {0.004, true, 0.9, 40})), 0.002);
  EXPECT_LT(fit_error(stroke, fit_stroke(stroke, {0.004, true, 0.9, 40})), 0.005);
}

TEST(StrokeFit, ATremblingHandGivesNoMorePoints) {
  Random random(3);
  std::vector<Vec3> stroke = arc(200);
  for (Vec3& p : stroke) p += 2e-4 * Vec3(random.normal(), random.normal(), 0);
  EXPECT_LE(fit_stroke(stroke, {0.003, true, 0.9, 40}).size(), 8u);
}

TEST(StrokeFit, TooShortIsNothing) {
  EXPECT_TRUE(fit_stroke({Vec3::Zero()}, {}).empty());
  EXPECT_TRUE(fit_stroke({Vec3::Zero(), Vec3::Zero()}, {}).empty());
}

TEST(StrokeFit, RadiiTaperBetweenTheTwoPlaces) {
  const std::vector<Vec3> points = {Vec3(0, 0, 0), Vec3(0, 0, 1), Vec3(0, 0, 2), Vec3(0, 0, 4)};
  const std::vector<double> radii = taper_radii(points, 4.0, 2.0, 0.25, 0.75);
  EXPECT_EQ(radii, (std::vector<double>{4.0, 4.0, 3.0, 2.0}));
}

}  // namespace
}  // namespace pedicel::app
