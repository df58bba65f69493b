// Edits of plants, one by one: what they change, what follows, what they refuse.
#include <gmock/gmock.h>

#include "plugins/plant/stem_tree.h"
#include "tests/unit/session/edit_cases.h"

namespace pedicel::app {
namespace {

using ::testing::HasSubstr;

using Edits = EditCase;

TEST_F(Edits, AStrokeOnAStemIsItsChild) {
  const auto tree = plant::stem_tree(plant());
  EXPECT_EQ(tree[0].parent, -1);
  EXPECT_EQ(tree[1].parent, 0);
  EXPECT_TRUE(tree[1].foot_first);
  EXPECT_NEAR(tree[1].parent_at, 0.5, 1.0e-6);
}

TEST_F(Edits, BranchesFollowTheirStem) {
  run("move point p stem 1 0.03,0,0.15");
  EXPECT_NEAR((curve("branch").points[0] - Vec3(0.03, 0, 0.15)).norm(), 0.0, 1.0e-9);
  EXPECT_NEAR((curve("branch").points[2] - Vec3(0.13, 0, 0.15)).norm(), 0.0, 1.0e-9);
  run("move stem p stem 0,0.1,0");
  EXPECT_NEAR((curve("branch").points[2] - Vec3(0.13, 0.1, 0.15)).norm(), 0.0, 1.0e-9);
}

TEST_F(Edits, PointsAreInsertedAndDeleted) {
  run("taper p stem 0.004 0.002");
  run("insert point p stem 0.25");
  ASSERT_EQ(curve("stem").points.size(), 4u);
  EXPECT_NEAR((curve("stem").points[1] - Vec3(0, 0, 0.075)).norm(), 0.0, 1.0e-6);
  EXPECT_NEAR(curve("stem").radius[1], 0.0035, 1.0e-6);
  run("delete point p stem 1");
  EXPECT_EQ(curve("stem").points.size(), 3u);
  EXPECT_EQ(curve("stem").radius.size(), 3u);
  EXPECT_THAT(refusal("delete point p stem 3"), HasSubstr("expected one from 0 to 2"));
  EXPECT_THAT(refusal("move point p stem 1 0,0,0"), HasSubstr("are at one place"));
}

TEST_F(Edits, ExactValues) {
  run("set length p branch 0.2");
  EXPECT_NEAR(plant::stem_curve(plant(), "branch").length(), 0.2, 1.0e-9);
  EXPECT_EQ(curve("branch").points[0], Vec3(0, 0, 0.15)) << "its foot stays";
  run("set radius p branch 0.001 point=2");
  EXPECT_EQ(curve("branch").radius, (std::vector<double>{0.0015, 0.0015, 0.001}));
  run("set material p youngs_modulus 3e7 stem=branch");
  EXPECT_EQ(curve("branch").material.youngs_modulus, 3.0e7);
  run("set material p youngs_modulus 0 stem=branch");
  EXPECT_FALSE(curve("branch").material.youngs_modulus.has_value());
  EXPECT_THAT(refusal("set radius p stem -1"), HasSubstr("expected one above 0"));
  EXPECT_THAT(refusal("set material p youngs_modulus -5"), HasSubstr("youngs_modulus = -5"));
}

TEST_F(Edits, TheLookIsSaidAndNothingElseChanges) {
  plant::PlantFile wanted = plant();
  run("set plant look p apple");
  wanted.look = plant::Look::apple;
  EXPECT_EQ(plant(), wanted);
  run("set plant look p tomato");
  EXPECT_EQ(plant().look, plant::Look::tomato);
  EXPECT_THAT(refusal("set plant look p pear"),
              HasSubstr("look \"pear\", expected one of: tomato, apple"));
}

TEST_F(Edits, SmoothingMovesInnerPointsOnly) {
  run("move point p branch 1 0.05,0,0.25");
  run("smooth points p branch share=1");
  EXPECT_NEAR((curve("branch").points[1] - Vec3(0.05, 0, 0.15)).norm(), 0.0, 1.0e-9);
  EXPECT_EQ(curve("branch").points[0], Vec3(0, 0, 0.15));
}

TEST_F(Edits, AMirroredBranchIsOnTheOtherSide) {
  run("mirror stem p branch name=left");
  EXPECT_NEAR((curve("left").points[2] - Vec3(-0.1, 0, 0.15)).norm(), 0.0, 1.0e-9);
  EXPECT_EQ(plant().fruits.size(), 2u);
  EXPECT_EQ(plant().fruits[1].place.curve, "left");
  EXPECT_NE(plant().fruits[1].name, "berry");
  EXPECT_EQ(plant::stem_tree(plant())[2].parent, 0);
}

TEST_F(Edits, ARepeatedBranchGoesUpItsParent) {
  run("repeat stem p branch 2 0.05 angle=1.5707963267948966");
  ASSERT_EQ(plant().curves.size(), 4u);
  EXPECT_NEAR((plant().curves[2].points[2] - Vec3(0, 0.1, 0.2)).norm(), 0.0, 1.0e-9);
  EXPECT_NEAR((plant().curves[3].points[2] - Vec3(-0.1, 0, 0.25)).norm(), 0.0, 1.0e-9);
  EXPECT_EQ(plant().fruits.size(), 3u);
  EXPECT_THAT(refusal("repeat stem p branch 9 0.05"), HasSubstr("expected at most"));
}

TEST_F(Edits, AStemGoesWithWhatIsOnIt) {
  run("delete stem p stem");
  EXPECT_TRUE(plant().curves.empty());
  EXPECT_TRUE(plant().fruits.empty());
}

TEST_F(Edits, NamesAreKeptApartAndFollowed) {
  run("rename p branch twig");
  EXPECT_EQ(plant().fruits[0].place.curve, "twig");
  EXPECT_THAT(refusal("rename p twig berry"), HasSubstr("is there already"));
  EXPECT_THAT(refusal("draw stem p twig 0,0,0;0,0,1 0.001"), HasSubstr("expected a new name"));
  EXPECT_THAT(refusal("delete stem p branch"), HasSubstr("expected one of: stem, twig"));
  EXPECT_THAT(refusal("new plant p"), HasSubstr("expected a new name"));
  EXPECT_THAT(refusal("delete stem q branch"), HasSubstr("no plant \"q\""));
}

TEST_F(Edits, FruitsAndLeavesAlongAStem) {
  run("move organ p berry stem 0.9");
  EXPECT_EQ(plant().fruits[0].place.curve, "stem");
  EXPECT_EQ(plant().fruits[0].place.at, 0.9);
  run("set organ p berry stretch 0");
  EXPECT_FALSE(plant().fruits[0].detach.stretch.has_value());
  EXPECT_THAT(refusal("set organ p berry force -1"),
              HasSubstr("force = -1, expected a number > 0"));
  run("add fruit p pea stem 0.5 0.004");
  EXPECT_EQ(plant().fruits[1].density, 950.0);
  run("delete organ p pea");
  run("add leaf p leaf stem 0.4 0.05 normal=0,0,1");
  run("turn leaf p leaf 0,1,1 direction=1,0,0");
  EXPECT_EQ(plant().leaves[0].normal, Vec3(0, 1, 1));
  run("delete organ p leaf");
  EXPECT_TRUE(plant().leaves.empty());
  EXPECT_THAT(refusal("move organ p berry stem 1.2"), HasSubstr("a fraction from 0 to 1"));
  EXPECT_THAT(refusal("set organ p berry taste 1"), HasSubstr("expected one of: radius"));
}

TEST_F(Edits, TheRootMovesWithTheFootOfTheStemOnIt) {
  run("move point p stem 0 0.02,0,0");
  EXPECT_EQ(plant().root, Vec3(0.02, 0, 0));
}

TEST_F(Edits, WaypointsAreInTheOrderOfTheirTimes) {
  run("add waypoint 2 0.1,0.2");
  run("add waypoint 1 0.3,0.4");
  run("add waypoint 2 0.5,0.6");
  ASSERT_EQ(document.waypoints.size(), 2u);
  EXPECT_EQ(document.waypoints[0].time, 1.0);
  EXPECT_EQ(document.waypoints[1].joints[0], 0.5);
  EXPECT_THAT(refusal("delete waypoint 2"), HasSubstr("expected one of 2"));
}

}  // namespace
}  // namespace pedicel::app
