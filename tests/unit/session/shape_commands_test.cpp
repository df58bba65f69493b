// Kinds of control points and cuts: the shapes that they make, what stays, what is refused.
#include <gmock/gmock.h>

#include "plugins/plant/point_kind.h"
#include "tests/unit/session/edit_cases.h"

namespace pedicel::app {
namespace {

using plant::PointKind;
using ::testing::HasSubstr;

class Kinds : public EditCase {
 protected:
  Kinds() {
    run("draw stem p bow 0,0,0.3;0.1,0,0.35;0.2,0,0.3;0.3,0,0.4;0.4,0,0.3 "
        "0.004,0.003,0.003,0.002,0.001");
  }
  std::vector<PointKind> kinds() const {
    std::vector<PointKind> all;
    for (const auto& one : plant::control_points(curve("bow"))) all.push_back(one.kind);
    return all;
  }
  int index_of(const Vec3& place) const {
    const auto& points = curve("bow").points;
    for (std::size_t i = 0; i < points.size(); ++i)
      if ((points[i] - place).norm() < 1e-9) return static_cast<int>(i);
    return -1;
  }
  /// rad, by which the stem turns within 3 mm on both sides of a place.
  double turn_at(const Vec3& place) const {
    const geometry::Curve drawn = plant::stem_curve(plant(), "bow");
    const double arc = drawn.control_arc(index_of(place)), reach = 0.003;
    const Vec3 a = drawn.tangent(arc - reach), b = drawn.tangent(arc + reach);
    return std::atan2(a.cross(b).norm(), a.dot(b));
  }
  /// m, of the drawn stem from the straight line between two of its points.
  double bulge(const Vec3& from, const Vec3& to) const {
    const geometry::Curve drawn = plant::stem_curve(plant(), "bow");
    const double a = drawn.control_arc(index_of(from)), b = drawn.control_arc(index_of(to));
    double most = 0.0;
    for (int i = 1; i < 20; ++i) {
      const Vec3 off = drawn.point(a + i * (b - a) / 20) - from;
      const Vec3 along = (to - from).normalized();
      most = std::max(most, (off - off.dot(along) * along).norm());
    }
    return most;
  }
  const Vec3 second{0.1, 0, 0.35}, middle{0.2, 0, 0.3}, fourth{0.3, 0, 0.4}, tip{0.4, 0, 0.3};
  const double chords_turn = std::atan(1.0) + std::atan(0.5);  // rad, of the straight lines there
};

TEST_F(Kinds, ADrawnStemIsSmooth) {
  EXPECT_EQ(kinds(), std::vector<PointKind>(5, PointKind::smooth));
  EXPECT_LT(turn_at(middle), 0.4);
}

TEST_F(Kinds, ACornerTurnsAtOncePiecesStayCurved) {
  const double before = bulge(second, middle);
  run("set point kind p bow 2 corner");
  EXPECT_EQ(kinds()[2], PointKind::corner);
  EXPECT_EQ(kinds().size(), 5u);
  EXPECT_NEAR(turn_at(middle), chords_turn, 0.25);
  EXPECT_GT(bulge(second, middle), 0.2 * before);
  EXPECT_EQ(curve("bow").radius.size(), curve("bow").points.size());
}

// Ends have no direction of their own that could curve the pieces beside the only inner point.
TEST_F(Kinds, TheMiddleOfThreePointsIsSmoothOrLinear) {
  run("draw stem p elbow 0,0,0.2;0,0.1,0.25;0.05,0.2,0.2 0.002");
  run("set point kind p elbow 1 linear");
  const auto straight = curve("elbow").points;
  run("set point kind p elbow 2 smooth");
  EXPECT_EQ(curve("elbow").points.size(), 3u);
  run("set point kind p elbow 1 corner");
  EXPECT_EQ(curve("elbow").points, straight);
  EXPECT_EQ(plant::point_kind(curve("elbow"), 2), PointKind::linear);
}

TEST_F(Kinds, LinearIsStraightToTheNeighbours) {
  run("set point kind p bow 2 linear");
  EXPECT_EQ(kinds()[2], PointKind::linear);
  EXPECT_LT(bulge(second, middle), 1e-9);
  EXPECT_LT(bulge(middle, fourth), 1e-9);
  EXPECT_GT(bulge(fourth, tip), 1e-3) << "the rest is curved as before";
  EXPECT_NEAR(turn_at(middle), chords_turn, 1e-6);
}

TEST_F(Kinds, SmoothAgainIsAsItWas) {
  const plant::PlantCurve drawn = curve("bow");
  for (const char* kind : {"corner", "linear"}) {
    run("set point kind p bow 2 " + std::string(kind));
    run("set point kind p bow " + std::to_string(index_of(middle)) + " smooth");
    EXPECT_EQ(curve("bow"), drawn) << kind;
  }
}

TEST_F(Kinds, SettingTheSameTwiceIsSettingItOnce) {
  run("set point kind p bow 2 corner");
  const plant::PlantCurve once = curve("bow");
  run("set point kind p bow " + std::to_string(index_of(middle)) + " corner");
  EXPECT_EQ(curve("bow").points.size(), once.points.size());
}

TEST_F(Kinds, ACornerIsMovedAndDeletedWithThePointsThatHoldIt) {
  run("set point kind p bow 2 corner");
  const int at = index_of(middle);
  run("move point p bow " + std::to_string(at) + " 0.2,0,0.2");
  EXPECT_EQ(kinds()[2], PointKind::corner);
  EXPECT_EQ(index_of({0.2, 0, 0.2}), at);
  for (const int beside : {at - 1, at + 1})
    EXPECT_LT((curve("bow").points[beside] - Vec3(0.2, 0, 0.2)).norm(), 0.002);
  run("set radius p bow 0.006 point=" + std::to_string(at));
  EXPECT_EQ(curve("bow").radius[at - 1], 0.006) << "no bump beside it";
  EXPECT_THAT(refusal("set point kind p bow " + std::to_string(at - 1) + " smooth"),
              HasSubstr("holds the corner at " + std::to_string(at)));
  run("delete point p bow " + std::to_string(at));
  EXPECT_EQ(curve("bow").points.size(), 4u);
}

TEST_F(Kinds, OnePointOfAStraightStemIsMadeSmooth) {
  run("set interpolation p bow linear");
  EXPECT_EQ(kinds(), std::vector<PointKind>(5, PointKind::linear));
  run("set point kind p bow 2 smooth");
  EXPECT_EQ(curve("bow").interpolation, plant::Interpolation::smooth);
  EXPECT_EQ(kinds()[2], PointKind::smooth);
  EXPECT_EQ(kinds()[1], PointKind::corner);
  EXPECT_LT(bulge({0, 0, 0.3}, second), 1e-9) << "away from it all is straight";
  EXPECT_LT(turn_at(middle), 0.5 * chords_turn);
}

TEST_F(Kinds, CornersOfAStrokeAreSeenAsCorners) {
  run("draw stem p hook 0,0,0;0.1,0,0;0.1985,0,0;0.2,0,0;0.2,0,0.0015;0.2,0,0.1 0.003");
  EXPECT_EQ(plant::point_kind(curve("hook"), 3), PointKind::corner);
  EXPECT_EQ(plant::held_point(curve("hook"), 2), 3);
  EXPECT_EQ(plant::control_points(curve("hook")).size(), 4u);
}

TEST_F(Kinds, PointsThatHappenToBeNearStay) {
  run("draw stem p odd 0,0,0;0.001,0,0;0.1,0,0.02;0.2,0,0.1 0.003");
  run("move point p odd 2 0.1,0,0.05");
  EXPECT_EQ(curve("odd").points.size(), 4u);
  EXPECT_EQ(curve("odd").points[1], Vec3(0.001, 0, 0));
}

TEST_F(Kinds, WhatIsImpossibleIsRefused) {
  EXPECT_THAT(refusal("set point kind p bow 0 corner"), HasSubstr("is an end"));
  EXPECT_THAT(refusal("set point kind p bow 9 corner"), HasSubstr("expected one from 0 to 4"));
  EXPECT_THAT(refusal("set point kind p bow 2 round"), HasSubstr("one of: smooth, corner, linear"));
}

using Cuts = EditCase;

TEST_F(Cuts, WhatLiesBeyondGoesWithAllThatIsOnIt) {
  run("draw stem p twig 0,0,0.24;0,0.05,0.26 0.001");
  run("add fruit p low stem 0.2 0.01");
  run("add fruit p high stem 0.9 0.01");
  run("add leaf p leaf stem 0.6 0.05");
  run("add mass p stem 0.8 0.1");
  run("taper p stem 0.004 0.002");
  run("trim stem p stem 0.7");
  EXPECT_NEAR(plant::stem_curve(plant(), "stem").length(), 0.21, 1e-6);
  EXPECT_NEAR((curve("stem").points.back() - Vec3(0, 0, 0.21)).norm(), 0.0, 1e-9);
  EXPECT_NEAR(curve("stem").radius.back(), 0.0026, 1e-9);
  EXPECT_EQ(plant().curve_index("twig"), -1) << "it hung beyond the cut";
  EXPECT_GE(plant().curve_index("branch"), 0) << "it hangs below";
  ASSERT_EQ(plant().fruits.size(), 2u);  // berry is on the branch
  EXPECT_EQ(plant().fruits[1].name, "low");
  EXPECT_NEAR(plant().fruits[1].place.at * 0.21, 0.2 * 0.3, 1e-9) << "where it was drawn";
  EXPECT_NEAR(plant().leaves[0].place.at * 0.21, 0.6 * 0.3, 1e-9);
  EXPECT_TRUE(plant().masses.empty());
}

TEST_F(Cuts, AStemThatIsDrawnFromItsTipKeepsItsFoot) {
  run("draw stem p back 0.1,0,0.25;0.05,0,0.25;0,0,0.25 0.001");
  run("add fruit p near back 0.8 0.005");
  run("add fruit p far back 0.1 0.005");
  run("trim stem p back 0.5");
  EXPECT_NEAR((curve("back").points.front() - Vec3(0.05, 0, 0.25)).norm(), 0.0, 1e-6);
  EXPECT_NEAR((curve("back").points.back() - Vec3(0, 0, 0.25)).norm(), 0.0, 1e-9);
  ASSERT_EQ(plant().fruits.size(), 2u);
  EXPECT_EQ(plant().fruits[1].name, "near");
  EXPECT_NEAR(plant().fruits[1].place.at, 0.6, 1e-6);
}

TEST_F(Cuts, WhatIsImpossibleIsRefused) {
  EXPECT_THAT(refusal("trim stem p stem 0.001"), HasSubstr("or: delete stem"));
  EXPECT_THAT(refusal("trim stem p stem 0.999"), HasSubstr("from its tip"));
  EXPECT_THAT(refusal("trim stem p stem 1.5"), HasSubstr("a fraction from 0 to 1"));
  EXPECT_THAT(refusal("trim stem p stalk 0.5"), HasSubstr("no stem \"stalk\""));
}

}  // namespace
}  // namespace pedicel::app
