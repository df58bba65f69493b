// MTGs and tables as the programs of OpenAlea, Helios and their users write them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "plugins/skeleton/mtg_reader.h"

namespace pedicel::plant {
namespace {

using ::testing::HasSubstr;

// What write_mtg() of OpenAlea puts above the entities.
const std::string export_head =
    "CODE :  \tFORM-A\n\nCLASSES :\nSYMBOL\tSCALE\tDECOMPOSITION\tINDEXATION\tDEFINITION\n"
    "$\t0\tFREE\tFREE\tIMPLICIT\nP\t1\tFREE\tFREE\tEXPLICIT\nB\t2\tFREE\tFREE\tEXPLICIT\n"
    "S\t3\tFREE\tFREE\tEXPLICIT\n\nDESCRIPTION :\nLEFT\tRIGHT\tRELTYPE\tMAX\nS\tS\t<\t?\n\n"
    "FEATURES :\nNAME\tTYPE\nXX\tREAL\n\nMTG :\n";

struct Export {
  std::vector<SkeletonNode> nodes;
  std::string said;
};

Export read_export(const std::string& text, double unit = 1.0) {
  Diagnostics diagnostics;
  Export result;
  result.nodes = parse_mtg(text, "t.mtg", diagnostics, unit);
  result.said = diagnostics.text();
  return result;
}

Export read_export_table(const std::string& text) {
  Diagnostics diagnostics;
  Export result;
  result.nodes = parse_skeleton_csv(text, "t.csv", diagnostics);
  result.said = diagnostics.text();
  return result;
}

std::vector<int> parents_of(const std::vector<SkeletonNode>& nodes) {
  std::vector<int> list;
  for (const SkeletonNode& node : nodes) list.push_back(node.parent);
  return list;
}

// A branch without a place stands in the column of the segment that carries it; its own segments
// stand one column further on, and the stem goes on in the first column.
TEST(MtgExports, ABranchInTheColumnOfItsCarrierLeavesTheStemWhole) {
  const Export read = read_export(export_head +
                                  "ENTITY-CODE\t\t\t\tXX\tYY\tZZ\tradius\n"
                                  "/P1\n\t/B1\n"
                                  "\t\t/S1\t\t0\t0\t0\t0.01\n"
                                  "\t\t^<S2\t\t0\t0\t0.2\t0.01\n"
                                  "\t\t^+B2\n"
                                  "\t\t\t/S1\t0.1\t0\t0.3\t0.005\n"
                                  "\t\t\t^<S2\t0.2\t0\t0.4\t0.005\n"
                                  "\t\t^+B3\n"
                                  "\t\t\t/S1\t-0.1\t0\t0.3\t0.005\n"
                                  "\t\t^<S3\t\t0\t0\t0.6\t0.008\n");
  EXPECT_EQ(read.said, "");
  EXPECT_EQ(parents_of(read.nodes), (std::vector<int>{-1, 0, 1, 2, 1, 1}));
  EXPECT_TRUE(read.nodes[2].branch);
  EXPECT_FALSE(read.nodes[3].branch);
  EXPECT_TRUE(read.nodes[4].branch);
  EXPECT_FALSE(read.nodes[5].branch);
  EXPECT_EQ(*read.nodes[5].diameter, 0.016);
  const PlantFile plant = skeleton_plant(read.nodes, "t", {});
  ASSERT_EQ(plant.curves.size(), 3u);
  EXPECT_EQ(plant.curves[0].points.size(), 3u);
}

// The sign for a branch may stand on an axis that has no place itself.
TEST(MtgExports, ABranchWithoutAPlacePassesItsSignOn) {
  const Export read = read_export(export_head +
                                  "ENTITY-CODE\t\tXX\tYY\tZZ\n"
                                  "/P1/B1/S1\t\t0\t0\t0\n"
                                  "^<S2\t\t0\t0\t0.2\n"
                                  "\t+B2\n"
                                  "\t^/S1\t0.1\t0\t0.3\n"
                                  "^<S3\t\t0\t0\t0.6\n");
  EXPECT_EQ(read.said, "");
  EXPECT_EQ(parents_of(read.nodes), (std::vector<int>{-1, 0, 1, 1}));
  EXPECT_TRUE(read.nodes[2].branch);
  EXPECT_FALSE(read.nodes[3].branch);
}

TEST(MtgExports, PlacesMayBeXYZ) {
  const Export read = read_export(
      export_head + "ENTITY-CODE\tX\tY\tZ\tdiam\n/S1\t0\t0\t0\t2\n^<S2\t0\t0\t50\t2\n", 0.01);
  EXPECT_EQ(read.said, "");
  ASSERT_EQ(read.nodes.size(), 2u);
  EXPECT_EQ(read.nodes[1].position.z(), 0.5);
  EXPECT_EQ(*read.nodes[1].diameter, 0.02);
}

// A turtle's places as Python prints them; entities without a label have their number.
TEST(MtgExports, PlacesMayStandInOneColumn) {
  for (const char* form : {"(0.1, 0.2, 0.3)", "Vector3(0.1,0.2,0.3)", "[0.1 0.2 0.3]"}) {
    const Export read = read_export(export_head +
                                    "ENTITY-CODE\tTopPosition\tBottomPosition\tdiameter\n"
                                    "/S1\t(0, 0, 0.1)\t(0, 0, 0)\t0.01\n^<12\t" +
                                    std::string(form) + "\tNone\t\n");
    EXPECT_EQ(read.said, "") << form;
    ASSERT_EQ(read.nodes.size(), 3u) << form;
    EXPECT_EQ(read.nodes[0].position, Vec3(0, 0, 0));
    EXPECT_EQ(read.nodes[2].position, Vec3(0.1, 0.2, 0.3));
    EXPECT_EQ(read.nodes[2].parent, 1);
  }
  EXPECT_THAT(read_export(export_head + "ENTITY-CODE\tposition\n/S1\t(0, 1)\n").said,
              HasSubstr("t.mtg:20:5: error: position: \"(0, 1)\", expected three numbers such as"));
}

TEST(MtgExports, LengthsAndAnglesAloneAreRefused) {
  EXPECT_THAT(
      read_export(export_head + "ENTITY-CODE\tLength\tDiameter\tAlpha\n/S1\t1\t1\t30\n").said,
      HasSubstr("no column XX, YY, ZZ beside Length, Diameter, Alpha, expected the "
                "coordinates XX, YY and ZZ, or X, Y and Z, or TopPosition"));
}

TEST(TableExports, ATableWithoutEdgesGoesOnWithTheFirstChild) {
  const Export read = read_export_table(
      "id,parent,x,y,z,radius\n1,-1,0,0,0,0.01\n2,1,0,0,0.1,0.01\n3,2,0,0,0.2,0.01\n"
      "4,2,0.1,0,0.2,0.005\n");
  EXPECT_EQ(read.said, "");
  ASSERT_EQ(read.nodes.size(), 4u);
  EXPECT_EQ(skeleton_plant(read.nodes, "t", {}).curves.size(), 2u);
}

// to_dataframe() of OpenAlea: plant and axes are rows, too, which have no place.
TEST(TableExports, RowsWithoutAPlaceArePassedOver) {
  const Export read = read_export_table(
      "vid,label,edge_type,XX,YY,ZZ,parent,complex,scale,order\n0,,,,,,,,0,\n1,P1,/,,,,,0,1,0\n"
      "2,S1,/,0.0,0.0,0.0,,1,2,0\n3,S2,<,0.0,0.0,0.1,2.0,1,2,0\n4,S3,+,0.1,0.0,0.2,3.0,1,2,1\n");
  EXPECT_THAT(read.said, HasSubstr("t.csv:1:1: warning: 2 rows without a place are passed over"));
  EXPECT_EQ(parents_of(read.nodes), (std::vector<int>{-1, 0, 1}));
  EXPECT_TRUE(read.nodes[2].branch);
}

// Helios' cylinders: one name for three columns, and the row before as the parent of a branch.
TEST(TableExports, CylindersOfHeliosHangWhereTheyBegin) {
  const std::string rest = "\t0.0002\t1\t0\t0.004\n";
  const Export read = read_export_table(
      "radius (m)\tlength (m)\tstart_point\taxis_direction\tparent\textension\tbranch\t"
      "branch_order\tposition_in_branch\tmad\tSurfCov\tadded\tUnmodRadius (m)\n"
      "0.0040\t0.1000\t0\t0\t0\t0\t0\t1\t0\t0\t1\t0\t1" +
      rest + "0.0040\t0.1000\t0\t0\t0.1000\t0\t0\t1\t1\t0\t1\t0\t2" + rest +
      "0.0040\t0.1000\t0\t0\t0.2000\t0\t0\t1\t2\t0\t1\t0\t3" + rest +
      "0.0020\t0.1000\t0\t0\t0.1000\t1\t0\t0\t3\t0\t2\t1\t1" + rest);
  EXPECT_THAT(read.said, HasSubstr("t.csv:5:1: warning: a branch is said to hang from a cylinder"));
  EXPECT_THAT(read.said, ::testing::Not(HasSubstr("error")));
  EXPECT_EQ(parents_of(read.nodes), (std::vector<int>{-1, 0, 1, 2, 1}));
  EXPECT_TRUE(read.nodes[4].branch);
  EXPECT_NEAR(read.nodes[4].position.x(), 0.1, 1.0e-12);
}

TEST(TableExports, TheNamesOfMtgsAreKnown) {
  const Export read = read_export_table(
      "id,parent_id,link,XX,YY,ZZ,diameter\n1,,/,0,0,0,0.01\n2,1,<,0,0,0.1,0.01\n"
      "3,2,+,0.1,0,0.2,0.005\n4,3,/,0.2,0,0.2,0.005\n");
  EXPECT_EQ(read.said, "");
  ASSERT_EQ(read.nodes.size(), 4u);
  EXPECT_TRUE(read.nodes[2].branch);
  EXPECT_FALSE(read.nodes[3].branch);
}

}  // namespace
}  // namespace pedicel::plant
