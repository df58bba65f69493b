// Strokes to curves: within the tolerance, with few points, corners kept, radii as asked.
#include "plugins/plant/stroke_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>

#include "engine/core/check.h"
#include "engine/core/random.h"
#include "engine/geometry/curve.h"
#include "engine/geometry/curve_distance.h"

namespace pedicel::plant {
namespace {

constexpr double pi = 3.14159265358979323846;

std::vector<StrokeSample> along(int count, const std::function<Vec3(double)>& path) {
  std::vector<StrokeSample> stroke;
  for (int i = 0; i <= count; ++i) stroke.push_back({path(static_cast<double>(i) / count), 1.0});
  return stroke;
}

double largest_error(const FittedStroke& fitted, const std::vector<StrokeSample>& stroke) {
  const auto curve = geometry::Curve::smooth(fitted.points, fitted.radius);
  double largest = 0.0;
  for (const StrokeSample& sample : stroke)
    largest = std::max(largest, geometry::closest_on_curve(curve, sample.position).distance);
  return largest;
}

Vec3 half_circle(double t) {
  return {0.2 * std::cos(pi * t), 0.0, 0.2 * std::sin(pi * t)};
}

TEST(StrokeFit, AStraightStrokeHasTwoPoints) {
  const auto stroke = along(50, [](double t) { return Vec3(0.1 * t, 0, 0.3 * t); });
  const FittedStroke fitted = fit_stroke(stroke, {});
  EXPECT_EQ(fitted.points.size(), 2u);
  EXPECT_EQ(fitted.points.back(), stroke.back().position);
}

TEST(StrokeFit, EveryToleranceIsKept) {
  const auto stroke = along(120, half_circle);
  std::size_t before = 0;
  for (const auto& [tolerance, most] : std::map<double, std::size_t, std::greater<>>{
           {0.02, 6}, {0.005, 10}, {0.001, 18}, {0.0003, 36}}) {
    StrokeOptions options;
    options.tolerance = tolerance;
    const FittedStroke fitted = fit_stroke(stroke, options);
    EXPECT_LE(largest_error(fitted, stroke), tolerance * 1.001);
    EXPECT_NEAR(fitted.largest_error, largest_error(fitted, stroke), 1.0e-9);
    EXPECT_GE(fitted.points.size(), before) << tolerance;
    EXPECT_LE(fitted.points.size(), most) << tolerance;
    before = fitted.points.size();
  }
}

// The pixels of a mouse's path are noise: least squares runs through its middle.
TEST(StrokeFit, NoiseIsNotFollowed) {
  Random random(3);
  auto stroke = along(200, half_circle);
  for (StrokeSample& sample : stroke)
    sample.position += 0.0005 * Vec3(random.normal(), 0, random.normal());
  StrokeOptions options;
  options.tolerance = 0.003;
  const FittedStroke fitted = fit_stroke(stroke, options);
  EXPECT_LE(fitted.points.size(), 14u);
  const auto curve = geometry::Curve::smooth(fitted.points, fitted.radius);
  EXPECT_NEAR(curve.length(), 0.2 * pi, 0.01);
}

TEST(StrokeFit, ACornerStaysSharp) {
  const auto stroke = along(
      100, [](double t) { return t < 0.5 ? Vec3(0, 0, 0.4 * t) : Vec3(0.4 * (t - 0.5), 0, 0.2); });
  StrokeOptions options;
  const FittedStroke fitted = fit_stroke(stroke, options);
  ASSERT_EQ(fitted.corners.size(), 1u);
  EXPECT_NEAR((fitted.points[fitted.corners[0]] - Vec3(0, 0, 0.2)).norm(), 0.0, 1.0e-3);
  EXPECT_LE(largest_error(fitted, stroke), options.tolerance);
  options.corners = false;
  EXPECT_TRUE(fit_stroke(stroke, options).corners.empty());
}

TEST(StrokeFit, RadiiFollowLengthAndPressure) {
  auto stroke = along(60, half_circle);
  StrokeOptions options;
  options.radius_from = 0.004;
  options.radius_to = 0.001;
  FittedStroke fitted = fit_stroke(stroke, options);
  EXPECT_DOUBLE_EQ(fitted.radius.front(), 0.004);
  EXPECT_DOUBLE_EQ(fitted.radius.back(), 0.001);
  for (std::size_t i = 1; i < fitted.radius.size(); ++i)
    EXPECT_LT(fitted.radius[i], fitted.radius[i - 1]);
  for (StrokeSample& sample : stroke) sample.pressure = 0.5;
  options.use_pressure = true;
  fitted = fit_stroke(stroke, options);
  EXPECT_DOUBLE_EQ(fitted.radius.front(), 0.002);
}

TEST(StrokeFit, WhatIsNoStrokeIsRefused) {
  EXPECT_THROW(fit_stroke({}, {}), UsageError);
  EXPECT_THROW(fit_stroke({{Vec3(1, 2, 3), 1.0}, {Vec3(1, 2, 3), 1.0}}, {}), UsageError);
  StrokeOptions none;
  none.tolerance = 0.0;
  EXPECT_THROW(fit_stroke(along(5, half_circle), none), UsageError);
}

// Scribbles of all kinds end, and hold their tolerance.
TEST(StrokeFit, Scribbles) {
  for (int seed = 1; seed <= 20; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    std::vector<StrokeSample> stroke = {{Vec3::Zero(), 1.0}};
    Vec3 way(0.01, 0, 0);
    for (int i = 0; i < 80; ++i) {
      way += 0.0015 * Vec3(random.normal(), random.normal(), random.normal());
      way = 0.01 * way.normalized();
      stroke.push_back({stroke.back().position + way, random.uniform()});
    }
    StrokeOptions options;
    options.tolerance = 0.004;
    const FittedStroke fitted = fit_stroke(stroke, options);
    EXPECT_LE(largest_error(fitted, stroke), 1.001 * options.tolerance) << seed;
    EXPECT_LT(fitted.points.size(), stroke.size()) << seed;
    EXPECT_EQ(fitted.points.size(), fitted.radius.size());
  }
}

}  // namespace
}  // namespace pedicel::plant
