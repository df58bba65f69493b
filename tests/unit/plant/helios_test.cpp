// Plant structures of Helios: where shoots and petioles lie, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "plugins/skeleton/helios_reader.h"

namespace pedicel::plant {
namespace {

using ::testing::HasSubstr;

std::string helios_internode(const std::string& length, const std::string& more = "") {
  return "<phytomer><internode><internode_length>" + length +
         "</internode_length><internode_radius>0.004</internode_radius>" + more +
         "</internode></phytomer>\n";
}

std::string helios_shoot(int id, int parent, int node, const std::string& rotation,
                         const std::string& phytomers) {
  return "<shoot ID=\"" + std::to_string(id) + "\"><shoot_type_label> stem </shoot_type_label>" +
         "<parent_shoot_ID> " + std::to_string(parent) + " </parent_shoot_ID><parent_node_index> " +
         std::to_string(node) +
         " </parent_node_index><parent_petiole_index> 0 </parent_petiole_index><base_rotation> " +
         rotation + " </base_rotation>\n" + phytomers + "</shoot>\n";
}

std::string helios_file(const std::string& shoots) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<helios>\n<plant_instance ID=\"0\">\n"
         "<base_position> 1 2 0 </base_position>\n<plant_age> 30 </plant_age>\n" +
         shoots + "</plant_instance>\n</helios>\n";
}

constexpr const char* helios_petiole =
    "<petiole><petiole_length>0.05</petiole_length><petiole_radius>0.002</petiole_radius>"
    "<petiole_pitch>90</petiole_pitch><petiole_curvature>0</petiole_curvature>"
    "<current_leaf_scale_factor>0.5</current_leaf_scale_factor><petiole_taper>0.25</petiole_taper>"
    "<petiole_length_segments>1</petiole_length_segments><leaf><leaf_scale>0.1</leaf_scale></leaf>"
    "</petiole>";

std::vector<SkeletonNode> helios_read(const std::string& text, std::string* said = nullptr,
                                      double unit = 0.0) {
  Diagnostics diagnostics;
  auto nodes = parse_helios_xml(text, "t.xml", diagnostics, unit);
  EXPECT_FALSE(diagnostics.has_errors()) << diagnostics.text();
  if (said) *said = diagnostics.text();
  return nodes;
}

std::string helios_errors(const std::string& text) {
  Diagnostics diagnostics;
  EXPECT_TRUE(parse_helios_xml(text, "t.xml", diagnostics).empty());
  EXPECT_TRUE(diagnostics.has_errors());
  return diagnostics.text();
}

void expect_at(const SkeletonNode& node, double x, double y, double z) {
  EXPECT_NEAR((node.position - Vec3(x, y, z)).norm(), 0.0, 1.0e-9)
      << node.position.transpose() << ", expected " << x << " " << y << " " << z;
}

TEST(Helios, InternodesStandOnEachOther) {
  std::string said;
  const auto nodes =
      helios_read(helios_file(helios_shoot(0, -1, 0, "0 0 0",
                                           helios_internode("0.1",
                                                            "<internode_length_segments>2</"
                                                            "internode_length_segments>") +
                                               helios_internode("0.2"))),
                  &said);
  ASSERT_EQ(nodes.size(), 4u);
  expect_at(nodes[0], 1, 2, 0);
  expect_at(nodes[1], 1, 2, 0.05);
  expect_at(nodes[3], 1, 2, 0.3);
  EXPECT_EQ(nodes[3].parent, 2);
  EXPECT_EQ(nodes[3].diameter, 0.008);
  EXPECT_THAT(said,
              HasSubstr("t.xml:3:1: warning: the file does not hold the shoots' gravitropic"));
}

// Every internode but a shoot's first is turned by 1.25 times its pitch away from the petiole
// below it, which points along x here: the first petiole of a plant lies in the plane of -y.
TEST(Helios, PitchTurnsAwayFromThePetioleBelow) {
  const auto nodes = helios_read(helios_file(
      helios_shoot(0, -1, 0, "0 0 0",
                   helios_internode("0.1", helios_petiole) +
                       helios_internode("0.1", "<internode_pitch>24</internode_pitch>"))));
  ASSERT_EQ(nodes.size(), 4u);
  expect_at(nodes[2], 1, 1.95, 0.1);  // the petiole's tip
  EXPECT_TRUE(nodes[2].branch);
  EXPECT_NEAR(*nodes[2].diameter, 2 * 0.5 * 0.002 * 0.75, 1.0e-12);
  const double angle = 30.0 * M_PI / 180.0;
  expect_at(nodes[3], 1, 2 + 0.1 * std::sin(angle), 0.1 + 0.1 * std::cos(angle));
  EXPECT_EQ(nodes[3].parent, 1);
  EXPECT_FALSE(nodes[3].branch);
}

// A second internode's petiole is turned around it by the angle between leaves.
TEST(Helios, PetiolesAreTurnedByThePhyllotacticAngle) {
  const auto nodes = helios_read(helios_file(helios_shoot(
      0, -1, 0, "0 0 0",
      helios_internode("0.1", helios_petiole) +
          helios_internode("0.1",
                           "<internode_phyllotactic_angle>90</internode_phyllotactic_angle>" +
                               std::string(helios_petiole)))));
  ASSERT_EQ(nodes.size(), 5u);
  expect_at(nodes[4], 1.05, 2, 0.2);
}

// A branch leaves the node that it hangs from, leaning to the petiole there by its base's pitch.
TEST(Helios, ABranchLeansToThePetioleBelowIt) {
  const auto nodes = helios_read(
      helios_file(helios_shoot(0, -1, 0, "0 0 0",
                               helios_internode("0.1", helios_petiole) + helios_internode("0.1")) +
                  helios_shoot(1, 0, 0, "60 0 0", helios_internode("0.2"))));
  ASSERT_EQ(nodes.size(), 5u);
  const double angle = 60.0 * M_PI / 180.0;
  expect_at(nodes[4], 1, 2 - 0.2 * std::sin(angle), 0.1 + 0.2 * std::cos(angle));
  EXPECT_EQ(nodes[4].parent, 1);
  EXPECT_TRUE(nodes[4].branch);
  EXPECT_EQ(skeleton_plant(nodes, "t", {}).curves.size(), 3u);
}

TEST(Helios, PlacesOfOlderFilesAreTakenAsTheyStand) {
  std::string said;
  const auto nodes =
      helios_read(helios_file(helios_shoot(
                      0, -1, 0, "0 0 0",
                      helios_internode("0.1",
                                       "<internode_vertices>1 2 0;1.01 2 0.1</internode_vertices>"
                                       "<internode_radii>0.005;0.003</internode_radii>") +
                          helios_internode("0.1",
                                           "<internode_vertices>1.03 2 0.2</internode_vertices>"
                                           "<internode_radii>0.002</internode_radii>"))),
                  &said, 0.01);
  EXPECT_EQ(said, "");
  ASSERT_EQ(nodes.size(), 3u);
  expect_at(nodes[2], 0.0103, 0.02, 0.002);
  EXPECT_NEAR(*nodes[1].diameter, 0.00006, 1.0e-12);
  EXPECT_NEAR(*nodes[2].diameter, 0.00004, 1.0e-12);
}

TEST(Helios, SavedBendsTurnTheSegments) {
  const auto nodes = helios_read(helios_file(helios_shoot(
      0, -1, 0, "90 0 0",
      helios_internode("0.1") +
          helios_internode("0.2",
                           "<internode_length_segments>2</internode_length_segments>"
                           "<curvature_perturbations>30;0</curvature_perturbations>"))));
  ASSERT_EQ(nodes.size(), 4u);
  expect_at(nodes[1], 1, 1.9, 0);
  const double angle = 30.0 * M_PI / 180.0;  // upwards
  expect_at(nodes[3], 1, 1.9 - 0.2 * std::cos(angle), 0.2 * std::sin(angle));
}

TEST(Helios, RefusesWithPlaceAndWords) {
  EXPECT_THAT(helios_errors("<robot name=\"r\"/>"),
              HasSubstr("t.xml:1:1: error: <robot> as the first element, expected <helios>"));
  EXPECT_THAT(helios_errors("<helios>"), HasSubstr("expected XML"));
  EXPECT_THAT(helios_errors("<helios></helios>"), HasSubstr("no <plant_instance> in <helios>"));
  EXPECT_THAT(helios_errors(helios_file("")), HasSubstr("t.xml:3:1: error: no <shoot>"));
  EXPECT_THAT(helios_errors(helios_file(helios_shoot(0, 3, 0, "0 0 0", helios_internode("1")))),
              HasSubstr("t.xml:6:1: error: shoot 0 hangs from shoot 3, expected one that stands"));
  EXPECT_THAT(helios_errors(helios_file(helios_shoot(0, -1, 0, "0 0 0", helios_internode("1")) +
                                        helios_shoot(1, 0, 1, "0 0 0", helios_internode("1")))),
              HasSubstr("shoot 1 hangs from phytomer 1, expected one of the 1 of shoot 0"));
  EXPECT_THAT(helios_errors(helios_file(helios_shoot(0, -1, 0, "0 0", helios_internode("1")))),
              HasSubstr("<base_rotation> has 2 numbers, expected 3"));
  EXPECT_THAT(helios_errors(helios_file(helios_shoot(0, -1, 0, "0 0 0", helios_internode("-1")))),
              HasSubstr("<internode_length> is \"-1\", expected a number >= 0"));
  EXPECT_THAT(helios_errors(helios_file(helios_shoot(
                  0, -1, 0, "0 0 0",
                  "<phytomer><internode><internode_length>1</internode_length></internode>"
                  "</phytomer>"))),
              HasSubstr("no <internode_radius> in <internode>, expected it"));
  EXPECT_THAT(
      helios_errors(helios_file(helios_shoot(0, -1, 0, "0 0 0",
                                             helios_internode("1",
                                                              "<internode_length_segments>0</"
                                                              "internode_length_segments>")))),
      HasSubstr("<internode_length_segments> is 0, expected a number from 1 to 1000"));
  EXPECT_THAT(helios_errors(helios_file(helios_shoot(
                  0, -1, 0, "0 0 0", helios_internode("1e308") + helios_internode("1e308")))),
              HasSubstr("the plant goes on without end"));
  std::string deep;
  for (int i = 0; i < 100; ++i) deep += "<a>";
  EXPECT_THAT(helios_errors(deep), HasSubstr("more than 50 levels deep"));
}

TEST(Helios, IsToldByItsFirstElement) {
  EXPECT_TRUE(is_helios_xml("<?xml version=\"1.0\"?>\n<!-- a -->\n<helios>\n"));
  EXPECT_FALSE(is_helios_xml("<?xml version=\"1.0\"?>\n<robot><helios/></robot>"));
}

}  // namespace
}  // namespace pedicel::plant
