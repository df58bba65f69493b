#include "engine/geometry/curve.h"

#include <gmock/gmock.h>

#include "engine/core/check.h"
#include "engine/geometry/curve_distance.h"
#include "tests/unit/geometry/support.h"

namespace pedicel::geometry {
namespace {

using testing::HasSubstr;

struct Controls {
  std::vector<Vec3> points;
  std::vector<double> radii;
};

Controls random_controls(Random& random, int count) {
  Controls controls;
  for (int i = 0; i < count; ++i) {
    controls.points.push_back(random_point(random, 0.1) + Vec3(0, 0, 0.1 * i));
    controls.radii.push_back(random.uniform(0.001, 0.01));
  }
  return controls;
}

std::string refusal(const std::vector<Vec3>& points, const std::vector<double>& radii) {
  try {
    Curve::smooth(points, radii);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "no refusal";
}

TEST(Curve, LinearFollowsItsPieces) {
  const Curve curve = Curve::linear(std::vector<Vec3>{{0, 0, 0}, {3, 0, 0}, {3, 4, 0}},
                                    std::vector<double>{0.1, 0.4, 0.0});
  EXPECT_DOUBLE_EQ(curve.length(), 7.0);
  EXPECT_LT((curve.point(1.0) - Vec3(1, 0, 0)).norm(), 1e-12);
  EXPECT_LT((curve.point(5.0) - Vec3(3, 2, 0)).norm(), 1e-12);
  EXPECT_LT((curve.tangent(1.0) - Vec3::UnitX()).norm(), 1e-12);
  EXPECT_LT((curve.tangent(3.0) - Vec3::UnitY()).norm(), 1e-12);
  EXPECT_NEAR(curve.radius(1.5), 0.25, 1e-12);
  EXPECT_NEAR(curve.radius(6.0), 0.1, 1e-12);
  EXPECT_NEAR(curve.radius(7.0), 0.0, 1e-12);
  EXPECT_LT((curve.point(99.0) - Vec3(3, 4, 0)).norm(), 1e-12);
  EXPECT_LT((curve.point(-1.0) - Vec3(0, 0, 0)).norm(), 1e-12);
}

TEST(Curve, PassesThroughItsControlPointsWithTheirRadii) {
  Random random(61);
  for (int i = 0; i < 20; ++i) {
    const Controls controls = random_controls(random, 2 + i % 6);
    for (const Curve& curve : {Curve::linear(controls.points, controls.radii),
                               Curve::smooth(controls.points, controls.radii)}) {
      ASSERT_EQ(curve.control_points(), static_cast<int>(controls.points.size()));
      for (int k = 0; k < curve.control_points(); ++k) {
        EXPECT_LT((curve.point(curve.control_arc(k)) - controls.points[k]).norm(), 1e-9);
        EXPECT_NEAR(curve.radius(curve.control_arc(k)), controls.radii[k], 1e-12);
      }
    }
  }
}

// By definition |dx/ds| = 1: chords of small steps have the step's length, and the tangent is
// theirs.
TEST(Curve, ParameterIsArcLength) {
  Random random(62);
  for (int i = 0; i < 20; ++i) {
    const Controls controls = random_controls(random, 3 + i % 5);
    const Curve curve = Curve::smooth(controls.points, controls.radii);
    const double step = 1e-4 * curve.length();
    for (double s = step; s < curve.length() - step; s += 0.0137 * curve.length()) {
      const Vec3 chord = curve.point(s + step) - curve.point(s - step);
      EXPECT_NEAR(chord.norm() / (2 * step), 1.0, 1e-4);
      EXPECT_LT((chord.normalized() - curve.tangent(s)).norm(), 1e-3);
    }
  }
}

// Twice differentiable it is not, but the tangent does not jump at control points.
TEST(Curve, SmoothHasNoCorners) {
  Random random(63);
  const Controls controls = random_controls(random, 8);
  const Curve curve = Curve::smooth(controls.points, controls.radii);
  for (int k = 1; k + 1 < curve.control_points(); ++k) {
    const double s = curve.control_arc(k), step = 1e-7;
    EXPECT_LT((curve.tangent(s + step) - curve.tangent(s - step)).norm(), 1e-4);
  }
}

TEST(Curve, SmoothThroughPointsOfALineIsTheLine) {
  const Curve curve = Curve::smooth(std::vector<Vec3>{{0, 0, 0}, {0, 0, 1}, {0, 0, 1.1}, {0, 0, 3}},
                                    std::vector<double>{1, 1, 1, 1});
  EXPECT_NEAR(curve.length(), 3.0, 1e-9);
  for (double s = 0; s < 3; s += 0.1) EXPECT_LT((curve.point(s) - Vec3(0, 0, s)).norm(), 1e-9);
}

// Many points on a circle: the spline's length tends to 2 pi r with at least second order.
TEST(Curve, SmoothThroughPointsOfACircleTendsToItsLength) {
  double error[2];
  for (int level = 0; level < 2; ++level) {
    const int n = 40 << level;
    std::vector<Vec3> points;
    for (int i = 0; i <= n; ++i) {
      const double angle = 2 * std::numbers::pi * i / n;
      points.emplace_back(std::cos(angle), std::sin(angle), 0);
    }
    const Curve curve = Curve::smooth(points, std::vector<double>(points.size(), 0.1));
    error[level] = std::abs(curve.length() - 2 * std::numbers::pi);
  }
  EXPECT_LT(error[0], 2e-3);
  EXPECT_GT(error[0] / error[1], 4.0);
}

TEST(Curve, TurnsWithItsPoints) {
  Random random(64);
  const Controls controls = random_controls(random, 5);
  const Pose pose = random_pose(random);
  std::vector<Vec3> turned;
  for (const Vec3& p : controls.points) turned.push_back(pose * p);
  const Curve a = Curve::smooth(controls.points, controls.radii);
  const Curve b = Curve::smooth(turned, controls.radii);
  EXPECT_NEAR(a.length(), b.length(), 1e-12);
  for (double s = 0; s < a.length(); s += 0.01)
    EXPECT_LT((pose * a.point(s) - b.point(s)).norm(), 1e-10);
}

TEST(Curve, SamplesHoldTheControlPointsAndTheSpacing) {
  const Curve curve = Curve::linear(std::vector<Vec3>{{0, 0, 0}, {0.3, 0, 0}, {0.3, 0.05, 0}},
                                    std::vector<double>{1, 1, 1});
  const std::vector<double> arcs = curve.sample_arcs(0.1);
  ASSERT_EQ(arcs.size(), 5u);
  EXPECT_NEAR(arcs[3], 0.3, 1e-12);
  EXPECT_NEAR(arcs[4], 0.35, 1e-12);
  EXPECT_THROW(curve.sample_arcs(0.0), UsageError);
}

TEST(Curve, RefusesBadControlPoints) {
  const Vec3 a(0, 0, 0), b(1, 0, 0);
  EXPECT_THAT(refusal({a}, {1}), HasSubstr("must have at least 2"));
  EXPECT_THAT(refusal({a, b}, {1}), HasSubstr("1 radii for 2 points: must be one per point"));
  EXPECT_THAT(refusal({a, b, b}, {1, 1, 1}), HasSubstr("points 1 and 2 of a curve coincide"));
  EXPECT_THAT(refusal({a, b}, {1, -1}),
              HasSubstr("radius 1 of a curve = -1.000000 m: must be >= 0"));
  EXPECT_THAT(refusal({a, Vec3(NAN, 0, 0)}, {1, 1}),
              HasSubstr("point 1 of a curve: must be finite"));
}

TEST(CurveDistance, AgreesWithBruteForce) {
  Random random(65);
  for (int i = 0; i < 20; ++i) {
    const Controls a = random_controls(random, 2 + i % 12), b = random_controls(random, 3 + i % 7);
    const Curve first = i % 2 ? Curve::smooth(a.points, a.radii) : Curve::linear(a.points, a.radii);
    const Curve second = Curve::smooth(b.points, b.radii);
    const CurvePair pair = closest_on_curves(first, second);
    EXPECT_NEAR((first.point(pair.first_arc) - second.point(pair.second_arc)).norm(), pair.distance,
                1e-12);
    const auto points = [](const Curve& curve) {
      std::vector<Vec3> samples;
      for (int k = 0; k <= 300; ++k) samples.push_back(curve.point(curve.length() * k / 300));
      return samples;
    };
    double best = 1e9, best_point = 1e9;
    const Vec3 p = random_point(random, 0.3);
    for (const Vec3& x : points(first)) {
      best_point = std::min(best_point, (x - p).norm());
      for (const Vec3& y : points(second)) best = std::min(best, (x - y).norm());
    }
    EXPECT_LE(pair.distance, best + 1e-9);
    EXPECT_GE(pair.distance, best - (first.length() + second.length()) / 600);
    const CurvePoint nearest = closest_on_curve(first, p);
    EXPECT_NEAR((first.point(nearest.arc) - p).norm(), nearest.distance, 1e-12);
    EXPECT_LE(nearest.distance, best_point + 1e-9);
    EXPECT_GE(nearest.distance, best_point - first.length() / 600);
  }
}

// At an inner minimum the connecting line is square to both curves.
TEST(CurveDistance, ConnectingLineIsSquareToBothCurves) {
  const std::vector<double> radii(3, 0.01);
  const Curve a = Curve::smooth(std::vector<Vec3>{{-1, 0, 0}, {0, 0, 0.3}, {1, 0, 0}}, radii);
  const Curve b =
      Curve::smooth(std::vector<Vec3>{{0.1, -1, 1}, {0.05, 0, 0.6}, {0.1, 1, 1}}, radii);
  const CurvePair pair = closest_on_curves(a, b);
  const Vec3 line = (b.point(pair.second_arc) - a.point(pair.first_arc)).normalized();
  EXPECT_NEAR(line.dot(a.tangent(pair.first_arc)), 0.0, 1e-5);
  EXPECT_NEAR(line.dot(b.tangent(pair.second_arc)), 0.0, 1e-5);
}

}  // namespace
}  // namespace pedicel::geometry
