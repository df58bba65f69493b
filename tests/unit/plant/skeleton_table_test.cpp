// Skeletons and cylinders as other programs write them: what is read, in which unit, and what is
// said of what is not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plugins/skeleton/mtg_reader.h"
#include "plugins/skeleton/skeleton.h"

namespace pedicel::plant {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

struct Outcome {
  std::vector<SkeletonNode> nodes;
  std::string said;

  std::vector<int> parents() const {
    std::vector<int> list;
    for (const SkeletonNode& node : nodes) list.push_back(node.parent);
    return list;
  }
};

Outcome read(const std::string& text, double unit = 0.0) {
  Diagnostics diagnostics;
  Outcome outcome;
  outcome.nodes = parse_skeleton_csv(text, "t.csv", diagnostics, unit);
  outcome.said = diagnostics.text();
  return outcome;
}

const std::string header = "x,y,z,parentid,vid,edgetype\n";
const std::string three = "0,0,0,,1,\n0,0,0.1,1,2,<\n0.05,0,0.15,2,3,+\n";

/// Three nodes: a stem of two and a branch.
void expect_three(const std::string& text, double unit = 0.0) {
  const Outcome outcome = read(text, unit);
  EXPECT_EQ(outcome.said, "") << text;
  ASSERT_THAT(outcome.parents(), ElementsAre(-1, 0, 1)) << text;
  EXPECT_NEAR((outcome.nodes[2].position - Vec3(0.05, 0, 0.15)).norm(), 0.0, 1e-15) << text;
  EXPECT_FALSE(outcome.nodes[1].branch);
  EXPECT_TRUE(outcome.nodes[2].branch);
}

TEST(SkeletonWays, ReadsEveryWayOfWritingTheTable) {
  expect_three(header + three);
  expect_three("\xEF\xBB\xBF" + header + three);
  expect_three("X,Y,Z,ParentID,VID,EdgeType\n" + three);
  expect_three("\"x\",\"y\",\"z\",\"parentid\",\"vid\",\"edgetype\"\n" + three);
  expect_three("x;y;z;parentid;vid;edgetype\n0;0;0;;1;\n0;0;0,1;1;2;<\n0,05;0;0,15;2;3;+\n");
  expect_three(
      "vid\tparent_id\tx\ty\tz\tis_branch\n1\t-1\t0\t0\t0\t0\n2\t1\t0\t0\t0.1\t0\n"
      "3\t2\t0.05\t0\t0.15\t1\n");
  expect_three(
      "vid,parent_id,x,y,z,is_branch\n1,-1,0,0,0,FALSE\n2,1,0,0,0.1,False\n"
      "3,2,0.05,0,0.15,True\n");
  expect_three(
      "vid,parent_id,x,y,z,is_branch\n1,-1,0,0,0,0.0\n2,1,0,0,0.1,0.0\n3,2,0.05,0,0.15,1.0\n");
  expect_three(
      "x / mm,y / mm,z / mm,parentid,vid,edgetype\n0,0,0,,1,\n0,0,100,1,2,<\n"
      "50,0,150,2,3,+\n");
  expect_three("# a tomato\r\n" + header +
               "0,0,0,nan,1.0,\r\n0,0,0.1,1.0,2.0,<\r\n"
               "0.05,0,0.15,2.0,3.0,+\r\n");
}

TEST(SkeletonWays, FindsTheRoot) {
  expect_three(header + "0,0,0,1,1,<\n0,0,0.1,1,2,<\n0.05,0,0.15,2,3,+\n");   // names itself
  expect_three(header + "0,0,0,0,1,<\n0,0,0.1,1,2,<\n0.05,0,0.15,2,3,+\n");   // names nobody
  expect_three(header + "0.05,0,0.15,2,3,+\n0,0,0.1,1,2,<\n0,0,0,-1,1,<\n");  // stands last
  // A node may be called -1.
  expect_three(header + "0,0,0,,-1,\n0,0,0.1,-1,2,<\n0.05,0,0.15,2,3,+\n");
  EXPECT_THAT(read(header + "0,0,0,0,1,<\n0,0,0.1,1,2,<\n0,0,0.2,0,3,<\n").said,
              HasSubstr("t.csv:2:1: error: parent 0 is not there"));
  EXPECT_THAT(read(header + "0,0,0,0,1,<\n0,0,0.1,1,2,<\n0,0,0.2,0,3,<\n").said,
              HasSubstr("(and 1 more like it, the last in line 4)"));
  EXPECT_THAT(read(header + "0,0,0,,1,<\n0,0,0.1,9,2,<\n").said,
              HasSubstr("t.csv:3:1: error: parent 9 is not there"));
  EXPECT_THAT(read(header + "0,0,0,,1,<\n0,0,0.1,,2,<\n").said,
              HasSubstr("t.csv:3:1: error: a second root, expected one row without a parent (the "
                        "first is in line 2)"));
  EXPECT_THAT(read(header + "0,0,0,2,1,<\n0,0,0.1,1,2,<\n").said, HasSubstr("is its own ancestor"));
}

TEST(SkeletonWays, TakesIdsOfAnySize) {
  expect_three(header +
               "0,0,0,,10000000000,<\n0,0,0.1,10000000000,9007199254740993,<\n"
               "0.05,0,0.15,9007199254740993,9007199254740992,+\n");
  EXPECT_THAT(read(header + "0,0,0,,1,\n0,0,1,1,two,<\n").said,
              HasSubstr("t.csv:3:9: error: vid: \"two\" is not a finite number"));
  EXPECT_THAT(read(header + "0,0,0,,1,\n0,0,1,1,,<\n0,0,2,1,2,<\n").said,
              HasSubstr("t.csv:3:1: error: vid is empty, expected the number of the node"));
}

// TomatoWUR writes the points, and beside them the edges between them: one less, both in rows.
TEST(SkeletonWays, ReadsPointsWithEdgesBesideThem) {
  const Outcome outcome = read(header +
                               "0,0,0,0.0,1.0,<\n"
                               "0,0,0.1,1.0,2.0,<\n"
                               "0,0,0.2,1.0,3.0,+\n"
                               "0.1,0,0.1,,,\n");
  EXPECT_THAT(outcome.said, HasSubstr("t.csv:1:1: warning: the last row has a point and no edge"));
  ASSERT_THAT(outcome.parents(), ElementsAre(-1, 0, 1, 1));
  EXPECT_EQ(outcome.nodes[2].position, Vec3(0, 0, 0.2));
  EXPECT_EQ(outcome.nodes[3].position, Vec3(0.1, 0, 0.1));
  EXPECT_TRUE(outcome.nodes[3].branch);
  EXPECT_THAT(read(header + "0,0,0,0,1,<\n0,0,1,0,1,<\n0,0,2,,,\n").said,
              HasSubstr("point 1 hangs from two"));
}

TEST(SkeletonWays, ReadsLengthsInTheUnitThatIsSaid) {
  const std::string in_cm = "0,0,0,,1,\n0,0,10,1,2,<\n5,0,15,2,3,+\n";
  expect_three(header + in_cm, 0.01);
  expect_three("# unit: cm\n" + header + in_cm);
  expect_three("x (cm),y (cm),z (cm),parentid,vid,edgetype\n" + in_cm);
  expect_three("x_cm,y_cm,z_cm,parentid,vid,edgetype\n" + in_cm);
  expect_three(header + "cm,cm,cm,,,\n" + in_cm);
  EXPECT_THAT(read("# unit: cm\n" + header + in_cm, 0.001).said,
              HasSubstr("t.csv:1:1: error: the file says that it is in cm, and mm was asked for"));
  EXPECT_THAT(read("x_cm,y_cm,z_cm,parentid,vid,edgetype\n" + in_cm, 1.0).said,
              HasSubstr("column \"x_cm\" is in cm, and m was asked for"));
  EXPECT_THAT(read("x (s),y,z,parentid,vid,edgetype\n" + in_cm).said,
              HasSubstr("column \"x (s)\" is in \"s\", expected m, cm or mm"));
  const Outcome wide =
      read("x,y,z,parentid,vid,edgetype,diameter_mm\n0,0,0,,1,<,4\n0,0,1,1,2,<,\n");
  EXPECT_EQ(wide.said, "");
  EXPECT_DOUBLE_EQ(wide.nodes[0].diameter.value_or(0), 0.004);
  EXPECT_FALSE(wide.nodes[1].diameter);
  EXPECT_DOUBLE_EQ(read("x,y,z,parentid,vid,edgetype,radius\n0,0,0,,1,<,0.4\n0,0,1,1,2,<,\n", 0.01)
                       .nodes[0]
                       .diameter.value_or(0),
                   0.008);
}

TEST(SkeletonWays, DropsNoColumnInSilence) {
  EXPECT_EQ(
      read("x,y,z,parentid,vid,edgetype,colour,age\n0,0,0,,1,<,red,3\n0,0,1,1,2,<,red,4\n").said,
      "t.csv:1:1: warning: columns that are not read: colour, age");
  EXPECT_THAT(read("x,y,z,parentid,vid,edgetype,X\n").said,
              HasSubstr("t.csv:1:29: error: column \"X\" says the same as \"x\""));
  EXPECT_THAT(read("x,y,parentid\n").said,
              HasSubstr("t.csv:1:1: error: a column is missing (z, vid), expected x,y,z"));
}

TEST(SkeletonWays, SaysTheSameFaultOnce) {
  std::string text = header + "0,0,0,,1,\n";
  for (int i = 2; i < 500; ++i) text += "0,0,wide,1," + std::to_string(i) + ",<\n";
  EXPECT_EQ(
      read(text).said,
      "t.csv:3:5: error: z: \"wide\" is not a finite number (and 497 more like it, the last in "
      "line 500)");
}

TEST(SkeletonWays, NodesAtOnePlaceAreSaidToBe) {
  const auto said = [](const std::string& rows) {
    Diagnostics diagnostics;
    const auto nodes = parse_skeleton_csv(header + rows, "t.csv", diagnostics);
    EXPECT_FALSE(checked_skeleton_plant(nodes, "t", {}, diagnostics));
    return diagnostics.text();
  };
  const std::string text = said("0,0,0,,1,<\n0,0,0,1,2,<\n0,0,0,2,3,<\n");
  EXPECT_THAT(text, HasSubstr("all 3 nodes lie at one place, expected them apart"));
  EXPECT_THAT(text, ::testing::Not(HasSubstr("under curves")));
}

TEST(Cylinders, AreAPlant) {
  const Outcome qsm = read(
      "id,parent_id,start_x,start_y,start_z,end_x,end_y,end_z,radius,length,branch_order\n"
      "1,0,0,0,0,0,0,0.1,0.004,0.1,0\n2,1,0,0,0.1,0,0,0.2,0.003,0.1,0\n");
  EXPECT_EQ(qsm.said, "t.csv:1:1: warning: columns that are not read: length");
  ASSERT_THAT(qsm.parents(), ElementsAre(-1, 0, 1));
  EXPECT_EQ(qsm.nodes[0].position, Vec3(0, 0, 0));
  EXPECT_EQ(qsm.nodes[2].position, Vec3(0, 0, 0.2));
  EXPECT_DOUBLE_EQ(*qsm.nodes[2].diameter, 0.006);
  const PlantFile plant = skeleton_plant(qsm.nodes, "q", {});
  ASSERT_EQ(plant.curves.size(), 1u);
  EXPECT_EQ(plant.curves[0].points.size(), 3u);
}

// A branch begins on the side of its parent, nearer to that one's start than to its end.
TEST(Cylinders, BranchesHangFromTheNearerEnd) {
  const Outcome qsm = read(
      "ID;parentID;branchID;branchOrder;startX;startY;startZ;endX;endY;endZ;radius\n"
      "0;-1;0;0;0;0;0;0;0;1;0.05\n1;0;0;0;0;0;1;0;0;2;0.04\n"
      "2;1;1;1;0.04;0;1.2;1;0;1.5;0.02\n3;2;1;1;1;0;1.5;2;0;1.5;0.01\n");
  EXPECT_THAT(qsm.said, HasSubstr("columns that are not read: branchOrder"));
  // Root, two ends of the stem, the branch's start and its two ends.
  ASSERT_THAT(qsm.parents(), ElementsAre(-1, 0, 1, 1, 3, 4));
  EXPECT_TRUE(qsm.nodes[3].branch);
  EXPECT_EQ(qsm.nodes[3].position, Vec3(0.04, 0, 1.2));
  EXPECT_EQ(skeleton_plant(qsm.nodes, "q", {}).curves.size(), 2u);
}

// TreeQSM's text has no ids (its rows are counted from 1), an axis and a length in place of an end.
TEST(Cylinders, ReadsTreeQsm) {
  const Outcome qsm = read(
      "radius (m)\tlength (m)\tstart_point_x\tstart_point_y\tstart_point_z\taxis_direction_x\t"
      "axis_direction_y\taxis_direction_z\tparent\textension\tbranch\tbranch_order\t"
      "position_in_branch\n"
      "0.05\t1\t0\t0\t0\t0\t0\t1\t0\t2\t1\t0\t1\n"
      "0.04\t0.5\t0\t0\t1\t0\t0\t1\t1\t0\t1\t0\t2\n"
      "0.02\t0.5\t0\t0\t1\t1\t0\t0\t1\t0\t2\t1\t1\n");
  ASSERT_THAT(qsm.parents(), ElementsAre(-1, 0, 1, 1)) << qsm.said;
  EXPECT_EQ(qsm.nodes[2].position, Vec3(0, 0, 1.5));
  EXPECT_EQ(qsm.nodes[3].position, Vec3(0.5, 0, 1));
  EXPECT_FALSE(qsm.nodes[2].branch);
  EXPECT_TRUE(qsm.nodes[3].branch);
}

TEST(Cylinders, ReadsArchi) {
  const Outcome qsm = read(
      "startX,startY,startZ,endX,endY,endZ,cyl_ID,parent_ID,extension_ID,radius_cyl,length,volume\n"
      "0,0,0,0,0,1,1,0,2,0.05,1,0.01\n0,0,1,0,0,2,2,1,0,0.04,1,0.01\n");
  ASSERT_THAT(qsm.parents(), ElementsAre(-1, 0, 1)) << qsm.said;
  EXPECT_DOUBLE_EQ(*qsm.nodes[0].diameter, 0.1);
}

TEST(Cylinders, NameWhatIsMissing) {
  EXPECT_THAT(
      read("id,parent,start_x,start_y,start_z,radius\n").said,
      HasSubstr("a column is missing (end_x, end_y, end_z), expected id,parent_id,start_x"));
}

TEST(MtgWays, ReadsTheUnitThatIsSaid) {
  const auto parse = [](const std::string& text, double unit, std::string& said) {
    Diagnostics diagnostics;
    auto nodes = parse_mtg(text, "t.mtg", diagnostics, unit);
    said = diagnostics.text();
    return nodes;
  };
  std::string said;
  const std::string body =
      "MTG:\nENTITY-CODE\t\tXX\tYY\tZZ\tTopDia\n/P1\n^/S1\t\t0\t0\t0\t20\n"
      "^<S2\t\t0\t0\t15\t10\n";
  EXPECT_EQ(parse(body, 0.0, said).back().position, Vec3(0, 0, 0.015));  // mm
  const auto cm = parse(body, 0.01, said);
  EXPECT_EQ(cm.back().position, Vec3(0, 0, 0.15));
  EXPECT_DOUBLE_EQ(*cm.front().diameter, 0.02);  // tenths of the unit
  EXPECT_EQ(parse("UNIT:\tm\n" + body, 0.0, said).back().position, Vec3(0, 0, 15));
  EXPECT_EQ(parse("# unit: cm\n" + body, 0.0, said).back().position, Vec3(0, 0, 0.15));
  EXPECT_TRUE(parse("UNIT:\tm\n" + body, 0.01, said).empty());
  EXPECT_THAT(said, HasSubstr("t.mtg:1:1: error: the file says that it is in m, and cm was asked"));
  EXPECT_TRUE(parse("UNIT:\tfurlong\n" + body, 0.0, said).empty());
  EXPECT_THAT(said, HasSubstr("unit is \"furlong\", expected m, cm, mm or a number of metres"));
}

TEST(MtgWays, ReadsOlderHeadersAndOtherLineEnds) {
  Diagnostics diagnostics;
  const auto nodes = parse_mtg(
      "MTG "
      ":\r\nTOPO\t\tXX\tYY\tZZ\tradius\r\n/P1\r\n^/S1\t\t0\t0\t0\t1,5\r\n^<S2\t\t0\t0\t0,5\tNA\r\n",
      "t.mtg", diagnostics);
  EXPECT_EQ(diagnostics.text(), "");
  ASSERT_EQ(nodes.size(), 2u);
  EXPECT_EQ(nodes[1].position, Vec3(0, 0, 0.0005));
  EXPECT_DOUBLE_EQ(nodes[0].diameter.value_or(0), 0.003);
  EXPECT_FALSE(nodes[1].diameter);
  EXPECT_EQ(
      parse_mtg("MTG:\rENTITY-CODE\t\tXX\tYY\tZZ\r/P1\r^/S1\t\t0\t0\t0\r", "t", diagnostics).size(),
      1u);
}

TEST(SkeletonTable, CommentsAloneAreNoTable) {
  for (const char* text : {"#N/A", "#", "# a\n# b", "#a\r\n", ""}) {
    Diagnostics diagnostics;
    EXPECT_TRUE(parse_skeleton_csv(text, "t.csv", diagnostics).empty()) << text;
    EXPECT_TRUE(diagnostics.has_errors()) << text;
  }
}

}  // namespace
}  // namespace pedicel::plant
