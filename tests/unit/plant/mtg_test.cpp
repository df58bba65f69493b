// Digitised plants: how their axes become curves, and a whole apple tree, also as a table of nodes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>
#include <tuple>
#include <vector>

#include "engine/io/atomic_file.h"
#include "plugins/skeleton/mtg_reader.h"
#include "plugins/skeleton/plant_source.h"
#include "tests/support/places.h"

namespace pedicel::plant {
namespace {

using ::testing::HasSubstr;

const std::string mtg_head =
    "CODE :\tFORM-A\nFEATURES:\nXX\tREAL\nMTG:\n"
    "ENTITY-CODE\t\t\tdist\tXX\tYY\tZZ\tTopDia\n";

// A trunk of three points with a gap in its digits, a branch at the second one, and a twig whose
// foot lies where it branches off.
const std::string small = mtg_head +
                          "/P1\n"
                          "^/U1\t\t\t\t0\t0\t0\t200\n"
                          "^/E1<<E5\t\t\t\t0\t0\t500\t100\n"
                          "\t+B1/E1\t\t\t100\t0\t600\t\n"
                          "\t\t+D1\t\t100\t0\t600\t30\n"
                          "\t\t^<E1\t\t100\t50\t600\t\n"
                          "\t^<E2\t\t\t200\t0\t700\t60\n"
                          "# a comment\n"
                          "^<E6\n"
                          "\t+B2\t\t\t-50\t0\t500\t50\n"
                          "^<E7\t\t\t\t0\t0\t1000\t80\n";

std::string errors_of(const std::string& text) {
  Diagnostics diagnostics;
  EXPECT_TRUE(parse_mtg(text, "t.mtg", diagnostics).empty());
  return diagnostics.text();
}

std::string table_errors_of(const std::string& text) {
  Diagnostics diagnostics;
  EXPECT_TRUE(parse_skeleton_csv(text, "t.csv", diagnostics).empty());
  return diagnostics.text();
}

PlantFile small_plant() {
  Diagnostics diagnostics;
  const auto nodes = parse_mtg(small, "t.mtg", diagnostics);
  EXPECT_EQ(nodes.size(), 8u);
  const auto plant = checked_skeleton_plant(nodes, "small", {}, diagnostics);
  EXPECT_EQ(diagnostics.text(), "");
  return plant.value_or(PlantFile{});
}

TEST(MtgReader, FollowsTheColumns) {
  Diagnostics diagnostics;
  const auto nodes = parse_mtg(small, "t.mtg", diagnostics);
  std::vector<int> parents;
  for (const SkeletonNode& node : nodes) parents.push_back(node.parent);
  // B2 hangs from E6, which has no place of its own: from E5, the digitised one above it.
  EXPECT_EQ(parents, (std::vector<int>{-1, 0, 1, 2, 3, 2, 1, 1}));
  EXPECT_EQ(nodes[5].position, Vec3(0.2, 0, 0.7));
  EXPECT_EQ(nodes[5].diameter, 0.006);
  EXPECT_EQ(nodes[5].code, "^<E2");
  EXPECT_TRUE(nodes[2].branch);
  EXPECT_FALSE(nodes[2].diameter);
  EXPECT_EQ(nodes[2].where.line, 9);
  EXPECT_EQ(nodes[2].where.column, 2);
}

TEST(MtgReader, MakesACurveOfEachAxis) {
  const PlantFile plant = small_plant();
  ASSERT_EQ(plant.curves.size(), 4u);
  EXPECT_EQ(plant.root, Vec3(0, 0, 0));
  EXPECT_EQ(plant.shape, Shape::drawn);
  const std::vector<Vec3> trunk = {{0, 0, 0}, {0, 0, 0.5}, {0, 0, 1}};
  const std::vector<Vec3> branch = {{0, 0, 0.5}, {0.1, 0, 0.6}, {0.2, 0, 0.7}};
  const std::vector<Vec3> twig = {{0.1, 0, 0.6}, {0.1, 0.05, 0.6}};
  const std::vector<Vec3> other = {{0, 0, 0.5}, {-0.05, 0, 0.5}};
  EXPECT_EQ(plant.curves[0].points, trunk);
  EXPECT_EQ(plant.curves[1].points, branch);
  EXPECT_EQ(plant.curves[2].points, twig);
  EXPECT_EQ(plant.curves[3].points, other);
  for (const PlantCurve& curve : plant.curves)
    EXPECT_EQ(curve.interpolation, Interpolation::linear);
}

TEST(MtgReader, FillsInDiameters) {
  const PlantFile plant = small_plant();
  EXPECT_EQ(plant.curves[0].radius, (std::vector<double>{0.01, 0.005, 0.004}));
  EXPECT_EQ(plant.curves[1].radius, (std::vector<double>{0.003, 0.003, 0.003}));  // from behind it
  EXPECT_EQ(plant.curves[2].radius, (std::vector<double>{0.002, 0.002}));  // 3 mm: below the least
}

TEST(MtgReader, ThePlantReadsBack) {
  const PlantFile plant = small_plant();
  Diagnostics diagnostics;
  EXPECT_EQ(parse_plant(plant_text(plant), "p", diagnostics), plant);
}

TEST(MtgReader, RefusesWithPlaceAndWords) {
  EXPECT_THAT(errors_of("CODE:\n"), HasSubstr("no line \"MTG:\""));
  EXPECT_THAT(errors_of("MTG:\n"), HasSubstr("no line \"ENTITY-CODE\""));
  EXPECT_THAT(errors_of("MTG:\n/P1\n"),
              HasSubstr("t.mtg:2:1: error: \"/P1\", expected ENTITY-CODE"));
  EXPECT_THAT(errors_of("MTG:\nENTITY-CODE\tDab\tXX\tYY\n/P1\n"),
              HasSubstr("t.mtg:2:1: error: no column ZZ beside Dab, XX, YY"));
  EXPECT_THAT(errors_of("MTG:\nENTITY-CODE\tLongUC\n/P1\t12\n"),
              HasSubstr("no column XX, YY, ZZ beside LongUC"));
  EXPECT_THAT(errors_of(mtg_head + "/P1\n"), HasSubstr("no entity has coordinates"));
  EXPECT_THAT(errors_of(mtg_head + "/P1\t\t\t\tx\t0\t0\n"),
              HasSubstr("t.mtg:6:8: error: XX: \"x\" is not a finite number"));
  EXPECT_THAT(errors_of(mtg_head + "/P1\t\t\t\t0\t\t0\n"),
              HasSubstr("t.mtg:6:1: error: the entity has 2 of 3 coordinates"));
  EXPECT_THAT(errors_of(mtg_head + "/P1\t\t\t\t0\t0\t0\t-5\n"),
              HasSubstr("TopDia is \"-5\", expected a number >= 0"));
  EXPECT_THAT(errors_of(mtg_head + "/P1\t+B1\n"), HasSubstr("t.mtg:6:5: error: a second entity"));
  EXPECT_THAT(errors_of(mtg_head + "\t\t\t3\n"), HasSubstr("no entity in the line"));
  EXPECT_THAT(errors_of(mtg_head + "/P1\n^=E1\n"),
              HasSubstr("t.mtg:7:1: error: \"^=E1\", expected"));
  EXPECT_THAT(errors_of(mtg_head + "/P1\n\t^<E1\n"),
              HasSubstr("7:2: error: \"^\" follows nothing"));
  EXPECT_THAT(errors_of(mtg_head + "/P1\n\t\t+E1\n"),
              HasSubstr("7:3: error: the entity hangs from"));
  EXPECT_THAT(errors_of(mtg_head + "/P1\t\t\t\t0\t0\t0\n/P2\t\t\t\t1\t0\t0\n"),
              HasSubstr("t.mtg:7:1: error: the entity is a second root"));
}

TEST(MtgReader, ReportsAFileThatIsNotThere) {
  Diagnostics diagnostics;
  EXPECT_FALSE(read_plant_source("no/such.mtg", 0.0, diagnostics));
  EXPECT_THAT(diagnostics.text(), HasSubstr("no/such.mtg: error: cannot be read"));
}

TEST(SkeletonTable, ReadsRowsInAnyOrder) {
  Diagnostics diagnostics;
  const auto nodes = parse_skeleton_csv(
      "x,y,z,parentid,vid,edgetype\n"
      "0.1,0,0.5,7,9,+\n0,0,1,7,8,<\n0,0,0.5,3,7,<\n0,0,0,,3,\n",
      "t.csv", diagnostics);
  EXPECT_EQ(diagnostics.text(), "");
  ASSERT_EQ(nodes.size(), 4u);
  EXPECT_EQ(nodes[1].parent, 0);
  EXPECT_EQ(nodes[2].position, Vec3(0.1, 0, 0.5));
  EXPECT_TRUE(nodes[2].branch);
  EXPECT_EQ(nodes[3].parent, 1);
  const PlantFile plant = skeleton_plant(nodes, "t", {});
  ASSERT_EQ(plant.curves.size(), 2u);
  EXPECT_EQ(plant.curves[0].points.size(), 3u);
  EXPECT_EQ(plant.curves[1].radius, (std::vector<double>{0.002, 0.002}));
}

TEST(SkeletonTable, RefusesWithPlaceAndWords) {
  const std::string columns = "x,y,z,parentid,vid,edgetype\n";
  EXPECT_THAT(table_errors_of("x,y\n"), HasSubstr("t.csv:1:1: error: a column is missing"));
  EXPECT_THAT(table_errors_of(columns), HasSubstr("no rows"));
  EXPECT_THAT(table_errors_of(columns + "0,0\n"),
              HasSubstr("t.csv:2:1: error: 2 cells, expected 6"));
  EXPECT_THAT(table_errors_of(columns + "0,a,0,,1,\n"),
              HasSubstr("t.csv:2:3: error: y: \"a\" is not a finite number"));
  EXPECT_THAT(table_errors_of(columns + "0,0,0,,1.5,\n"), HasSubstr("expected a whole number"));
  EXPECT_THAT(table_errors_of(columns + "0,0,0,,1,\n0,0,1,1,2,?\n"),
              HasSubstr("t.csv:3:11: error: edgetype: \"?\", expected <"));
  EXPECT_THAT(table_errors_of(columns + "0,0,0,,1,\n0,0,1,1,1,<\n"),
              HasSubstr("t.csv:3:1: error: node 1 appears twice"));
  EXPECT_THAT(table_errors_of(columns + "0,0,0,,1,\n0,0,1,5,2,<\n"),
              HasSubstr("t.csv:3:1: error: parent 5 is not there"));
  EXPECT_THAT(table_errors_of(columns + "0,0,0,,1,\n0,0,1,,2,<\n"),
              HasSubstr("t.csv:3:1: error: a second root"));
  EXPECT_THAT(table_errors_of(columns + "0,0,0,,1,\n0,0,1,3,2,<\n0,0,2,2,3,<\n"),
              HasSubstr("t.csv:3:1: error: node 2 is its own ancestor"));
  EXPECT_THAT(table_errors_of("id,parent,x_m,y_m,z_m,diameter_m,is_branch\n0,-1,0,0,0,-1,0\n"),
              HasSubstr("diameter_m: \"-1\", expected a number >= 0"));
}

/// Code, place, diameter and the parent's place of a node.
using Key = std::tuple<std::string, std::vector<double>, double, std::vector<double>>;

std::vector<Key> sorted_keys(const std::vector<SkeletonNode>& nodes) {
  const auto place = [](const SkeletonNode& node) {
    return std::vector<double>(node.position.begin(), node.position.end());
  };
  std::vector<Key> keys;
  for (const SkeletonNode& node : nodes)
    keys.emplace_back(node.code, place(node), node.diameter.value_or(-1.0),
                      node.parent >= 0 ? place(nodes[node.parent]) : std::vector<double>{});
  std::sort(keys.begin(), keys.end());
  return keys;
}

const std::filesystem::path apple_tree = pedicel::test::source_folder() / "plants/apple_tree.mtg";

std::vector<SkeletonNode> nodes_of_the_tree() {
  Diagnostics diagnostics;
  auto nodes = parse_mtg(io::read_file(apple_tree), "apple_tree.mtg", diagnostics);
  EXPECT_EQ(diagnostics.text(), "");
  return nodes;
}

/// The nodes as a table, whose ids count from 1.
std::string table_of(const std::vector<SkeletonNode>& nodes) {
  std::ostringstream text;
  text.precision(17);
  text << "id,parent,x_m,y_m,z_m,diameter_m,is_branch,mtg_code\n";
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const SkeletonNode& node = nodes[n];
    text << n + 1 << ',' << (node.parent < 0 ? -1 : node.parent + 1) << ',' << node.position.x()
         << ',' << node.position.y() << ',' << node.position.z() << ',' << node.diameter.value()
         << ',' << node.branch << ',' << node.code << '\n';
  }
  return text.str();
}

TEST(AppleTree, BecomesAPlant) {
  Diagnostics diagnostics;
  const auto plant = read_plant_source(apple_tree, 0.0, diagnostics);
  ASSERT_FALSE(diagnostics.has_errors()) << diagnostics.text();
  ASSERT_TRUE(plant);
  EXPECT_EQ(plant->name, "apple_tree");
  EXPECT_EQ(plant->look, Look::apple);
  EXPECT_GT(plant->curves.size(), 50u);
  EXPECT_EQ(plant->root, Vec3::Zero());
  EXPECT_EQ(plant->curves.front().points.front(), Vec3::Zero());
  double top = 0.0;
  for (const PlantCurve& curve : plant->curves) {
    for (const Vec3& point : curve.points) top = std::max(top, point.z());
    for (const double radius : curve.radius) EXPECT_GE(radius, 0.002);
  }
  EXPECT_NEAR(top, 2.226, 0.01);
  // Every branch starts at a point of a curve before it.
  for (std::size_t c = 1; c < plant->curves.size(); ++c) {
    const Vec3& foot = plant->curves[c].points.front();
    bool joined = false;
    for (std::size_t other = 0; other < c && !joined; ++other)
      for (const Vec3& point : plant->curves[other].points) joined = joined || point == foot;
    EXPECT_TRUE(joined) << plant->curves[c].name;
  }
}

TEST(AppleTree, ItsTableIsTheSamePlant) {
  const std::vector<SkeletonNode> nodes = nodes_of_the_tree();
  Diagnostics diagnostics;
  const auto table = parse_skeleton_csv(table_of(nodes), "tree.csv", diagnostics);
  EXPECT_EQ(diagnostics.text(), "");
  ASSERT_EQ(table.size(), nodes.size());
  EXPECT_EQ(sorted_keys(table), sorted_keys(nodes));
  EXPECT_EQ(skeleton_plant(table, "tree", {}), skeleton_plant(nodes, "tree", {}));
}

// The plant file's wood is the MTG's: both are drawn from one tree.
TEST(AppleTree, ItsPlantFileHasTheSameWood) {
  Diagnostics diagnostics;
  const auto drawn =
      read_plant_file(pedicel::test::source_folder() / "plants/apple_tree.plant.yaml", diagnostics);
  ASSERT_TRUE(drawn) << diagnostics.text();
  std::set<std::vector<double>> places;
  for (const PlantCurve& curve : drawn->curves)
    if (!curve.name.starts_with("stalk"))
      for (const Vec3& point : curve.points) places.insert({point.x(), point.y(), point.z()});
  std::set<std::vector<double>> digitised;
  for (const SkeletonNode& node : nodes_of_the_tree())
    digitised.insert({node.position.x(), node.position.y(), node.position.z()});
  EXPECT_EQ(places, digitised);
}

}  // namespace
}  // namespace pedicel::plant
