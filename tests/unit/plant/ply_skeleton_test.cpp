// Skeletons as PLY: which way the tree goes, thickness, units, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vector>

#include "plugins/skeleton/ply_reader.h"

namespace pedicel::plant {
namespace {

using ::testing::HasSubstr;

constexpr const char* ply_vertices =
    "property float x\nproperty float y\nproperty float z\nproperty float radius\n";
constexpr const char* ply_ends = "property int vertex1\nproperty int vertex2\n";

std::string ply_head(int vertices, int edges, const std::string& comment = "") {
  return "ply\nformat ascii 1.0\n" + comment + "element vertex " + std::to_string(vertices) + "\n" +
         ply_vertices + "element edge " + std::to_string(edges) + "\n" + ply_ends + "end_header\n";
}

// A stem of three places with a branch at the second one; edges in any direction and order.
const std::string ply_small = ply_head(5, 4) +
                              "0 0 0.3 0.002\n0 0 0 0.004\n0.1 0 0.15 0.001\n0 0 0.1 0.003\n"
                              "0 0.01 0.5 0.001\n"
                              "3 0\n1 3\n3 2\n4 0\n";

std::vector<SkeletonNode> ply_nodes(const std::string& text, double unit = 0.0) {
  Diagnostics diagnostics;
  auto nodes = parse_ply_skeleton(text, "t.ply", diagnostics, unit);
  EXPECT_EQ(diagnostics.text(), "");
  return nodes;
}

std::string ply_errors(const std::string& text, double unit = 0.0) {
  Diagnostics diagnostics;
  EXPECT_TRUE(parse_ply_skeleton(text, "t.ply", diagnostics, unit).empty());
  EXPECT_TRUE(diagnostics.has_errors());
  return diagnostics.text();
}

TEST(PlySkeleton, TheLongestWayFromTheLowestPlaceIsTheStem) {
  const auto nodes = ply_nodes(ply_small);
  ASSERT_EQ(nodes.size(), 5u);
  std::vector<int> parents;
  for (const SkeletonNode& node : nodes) parents.push_back(node.parent);
  EXPECT_EQ(parents, (std::vector<int>{-1, 0, 1, 2, 1}));
  EXPECT_NEAR(nodes[3].position.z(), 0.5, 1.0e-7);
  EXPECT_NEAR(nodes[4].position.x(), 0.1, 1.0e-7);
  EXPECT_TRUE(nodes[4].branch);
  EXPECT_FALSE(nodes[2].branch);
  EXPECT_DOUBLE_EQ(*nodes[0].diameter, 0.008);
  EXPECT_EQ(nodes[0].where.line, 13);
  EXPECT_EQ(skeleton_plant(nodes, "t", {}).curves.size(), 2u);
}

TEST(PlySkeleton, EdgesThatAllLeadAwayFromAPlaceMakeItTheRoot) {
  // The root hangs above its branches.
  const auto nodes = ply_nodes(ply_head(4, 3) +
                               "0 0 1 0.01\n0 0 0.8 0.01\n0.2 0 0.5 0.01\n-0.1 0 0.6 0.01\n"
                               "0 1\n1 2\n1 3\n");
  ASSERT_EQ(nodes.size(), 4u);
  EXPECT_EQ(nodes[0].position.z(), 1.0);
  const auto other = ply_nodes(ply_head(4, 3) +
                               "0 0 1 0.01\n0 0 0.8 0.01\n0.2 0 0.5 0.01\n-0.1 0 0.6 0.01\n"
                               "1 0\n2 1\n3 1\n");
  EXPECT_EQ(other[0].position.z(), 1.0);
}

TEST(PlySkeleton, PiecesThatRepeatTheirPlacesHangTogether) {
  const auto nodes = ply_nodes(ply_head(4, 3) +
                               "0 0 0 0.01\n0 0 1 0.01\n0 0 1 0.01\n0 0 2 0.01\n"
                               "0 1\n2 3\n3 2\n");
  ASSERT_EQ(nodes.size(), 3u);
  EXPECT_EQ(nodes[2].position.z(), 2.0);
}

TEST(PlySkeleton, UnitsAreTheCallersOrTheFiles) {
  const std::string rows = "0 0 0 2\n0 0 500 1\n0 1\n";
  EXPECT_EQ(ply_nodes(ply_head(2, 1, "comment unit: mm\n") + rows)[1].position.z(), 0.5);
  EXPECT_EQ(ply_nodes(ply_head(2, 1) + rows, 0.01)[1].position.z(), 5.0);
  EXPECT_DOUBLE_EQ(*ply_nodes(ply_head(2, 1) + rows, 0.001)[0].diameter, 0.004);
  EXPECT_THAT(ply_errors(ply_head(2, 1, "comment unit: mm\n") + rows, 0.01),
              HasSubstr("t.ply:3:1: error: the file says that it is in mm, and cm was asked for"));
}

TEST(PlySkeleton, ARadiusThatIsMissingIsAskedFor) {
  const auto text = [](const std::string& comment, const std::string& of_edge) {
    return "ply\nformat ascii 1.0\n" + comment +
           "element vertex 2\nproperty double x\nproperty double y\nproperty double z\n"
           "element edge 1\n" +
           ply_ends + of_edge + "end_header\n0 0 0\n0 0 1\n0 1" +
           (of_edge.empty() ? "" : " 0.006") + "\n";
  };
  EXPECT_THAT(ply_errors(text("", "")),
              HasSubstr("t.ply:3:1: error: no radius, expected a property radius or diameter"));
  EXPECT_DOUBLE_EQ(*ply_nodes(text("comment radius: 0.004\n", ""))[0].diameter, 0.008);
  EXPECT_DOUBLE_EQ(*ply_nodes(text("", "property float diameter\n"))[1].diameter, double(0.006));
  EXPECT_THAT(ply_errors(text("comment radius: thin\n", "")),
              HasSubstr("radius is \"thin\", expected a number > 0"));
}

template <class Number>
void append(std::string& bytes, Number value) {
  const char* from = reinterpret_cast<const char*>(&value);
  bytes.append(from, sizeof value);
}

std::string binary_ply() {
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\ncomment some program\nelement vertex 3\n"
      "property double x\nproperty double y\nproperty double z\nproperty uchar red\n"
      "property float radius\nelement face 1\nproperty list uchar int vertex_indices\n"
      "element edge 2\nproperty uint vertex1\nproperty uint vertex2\nend_header\n";
  for (int v = 0; v < 3; ++v) {
    append(bytes, 0.0);
    append(bytes, 0.25 * v);
    append(bytes, 0.5 * v);
    append(bytes, std::uint8_t{200});
    append(bytes, 0.5f);
  }
  append(bytes, std::uint8_t{3});
  for (const int v : {0, 1, 2}) append(bytes, std::int32_t{v});
  for (const unsigned v : {0u, 1u, 1u, 2u}) append(bytes, std::uint32_t{v});
  return bytes;
}

TEST(PlySkeleton, BinaryFilesAreReadAndMayNotBeCutOff) {
  const std::string bytes = binary_ply();
  const auto nodes = ply_nodes(bytes);
  ASSERT_EQ(nodes.size(), 3u);
  EXPECT_EQ(nodes[2].position, Vec3(0, 0.5, 1));
  EXPECT_EQ(nodes[2].diameter, 1.0);
  const std::size_t body = bytes.find("end_header\n") + 11;
  for (std::size_t size = body; size < bytes.size(); ++size)
    EXPECT_THAT(ply_errors(bytes.substr(0, size)), HasSubstr("the file ends within"));
}

TEST(PlySkeleton, RefusesWithPlaceAndWords) {
  const std::string four = "0 0 0 1\n0 0 1 1\n0 1 1 1\n1 1 1 1\n";
  EXPECT_THAT(ply_errors("plyx\n"), HasSubstr("t.ply:1:1: error: no PLY file"));
  EXPECT_THAT(ply_errors("ply\nformat ascii 1.0\n"), HasSubstr("the header does not end"));
  EXPECT_THAT(ply_errors("ply\nformat text 1.0\nend_header\n"),
              HasSubstr("t.ply:2:1: error: format is \"text\", expected ascii"));
  EXPECT_THAT(ply_errors("ply\nformat ascii 1.0\nelement vertex -1\nend_header\n"),
              HasSubstr("t.ply:3:1: error: an element's count is \"-1\""));
  EXPECT_THAT(ply_errors("ply\nformat ascii 1.0\nelement vertex 1\nproperty half x\nend_header\n"),
              HasSubstr("t.ply:4:1: error: type \"half\", expected char"));
  EXPECT_THAT(ply_errors(ply_head(4, 0) + four), HasSubstr("a cloud of points (no edges)"));
  EXPECT_THAT(ply_errors("ply\nformat ascii 1.0\nelement vertex 1\nelement face 2\n"
                         "property list uchar int vertex_indices\nend_header\n"),
              HasSubstr("a surface (faces and no edges), expected a skeleton: element edge"));
  EXPECT_THAT(ply_errors(ply_head(4, 3) + four + "0 1\n1 2\n2 0\n"),
              HasSubstr("t.ply:18:1: error: edge 2 (vertices 2 and 0) closes a ring"));
  EXPECT_THAT(ply_errors(ply_head(4, 2) + four + "0 1\n2 3\n"),
              HasSubstr("does not hang together with vertex 0, expected one tree"));
  EXPECT_THAT(
      ply_errors(ply_head(4, 1) + four + "0 4\n"),
      HasSubstr("t.ply:16:1: error: an edge ends at vertex 4, expected a number from 0 to 3"));
  EXPECT_THAT(ply_errors(ply_head(4, 1) + four + "1 1\n"), HasSubstr("joins vertex 1 to itself"));
  EXPECT_THAT(ply_errors(ply_head(4, 1) + four + "0 b\n"),
              HasSubstr("t.ply:16:1: error: \"b\", expected a number"));
  EXPECT_THAT(ply_errors(ply_head(4, 1) + "0 0 0 -1\n" + four.substr(8) + "0 1\n"),
              HasSubstr("t.ply:12:1: error: a radius or diameter of -1"));
  EXPECT_THAT(ply_errors(ply_head(900000, 1) + four),
              HasSubstr("the file ends within 900000 rows"));
  EXPECT_THAT(ply_errors(ply_head(2000000000, 1) + four), HasSubstr("expected at most 1000000"));
}

TEST(PlySkeleton, VerticesWithoutAnEdgeAreLeftOut) {
  Diagnostics diagnostics;
  const auto nodes =
      parse_ply_skeleton(ply_head(3, 1) + "0 0 0 1\n0 0 1 1\n5 5 5 1\n0 1\n", "t.ply", diagnostics);
  EXPECT_EQ(nodes.size(), 2u);
  EXPECT_THAT(diagnostics.text(), HasSubstr("warning: 1 vertex without an edge is left out"));
}

}  // namespace
}  // namespace pedicel::plant
