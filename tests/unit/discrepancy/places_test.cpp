#include "plugins/discrepancy/data/places.h"

#include <gtest/gtest.h>

#include "tests/unit/discrepancy/made_data.h"

namespace pedicel::discrepancy {
namespace {

TEST(Places, MarkersInTheirOrderFromTheFoot) {
  const MadeData made;
  const auto chains = chains_of(made.experiment);
  ASSERT_EQ(chains.size(), 2u);
  EXPECT_TRUE(chains[0].rooted);
  EXPECT_EQ(chains[0].parent, -1);
  EXPECT_EQ(chains[0].markers, (std::vector<int>{0, 1, 2, 3}));
  EXPECT_NEAR(chains[0].arc[2], 0.45, 1e-12);
  EXPECT_FALSE(chains[1].rooted);
  EXPECT_EQ(chains[1].parent, 0);
  EXPECT_NEAR(chains[1].parent_arc, 0.3, 1e-12);
  EXPECT_EQ(chains[1].markers, (std::vector<int>{4, 5}));
}

// Curves drawn from the tip are read from the foot all the same.
TEST(Places, CurvesDrawnTowardsTheRoot) {
  MadeData made;
  for (plant::PlantCurve& curve : made.experiment.plant().curves)
    std::swap(curve.points[0], curve.points[1]);
  const auto chains = chains_of(made.experiment);
  EXPECT_TRUE(chains[0].rooted);
  EXPECT_NEAR(chains[0].foot.norm(), 0.0, 1e-12);
  EXPECT_EQ(chains[0].markers, (std::vector<int>{3, 2, 1, 0}));
  EXPECT_NEAR(chains[0].arc[1], 0.15, 1e-12) << "at 0.75 from the tip";
  EXPECT_NEAR(chains[1].parent_arc, 0.3, 1e-12);
  EXPECT_NEAR(chains[1].foot.z(), 0.3, 1e-12);
}

}  // namespace
}  // namespace pedicel::discrepancy
