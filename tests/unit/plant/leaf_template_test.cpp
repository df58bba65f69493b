// Leaf templates: what is read and refused, and what grows from them.
#include "plugins/plant/leaf_template.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "engine/core/check.h"
#include "engine/core/random.h"
#include "plugins/cosserat/model/rod_state.h"
#include "plugins/cosserat/solver/direct_solver.h"
#include "plugins/cosserat/solver/standing.h"
#include "tests/support/places.h"

namespace pedicel::plant::cases {
namespace {

using cosserat::RodModel;
using cosserat::RodState;
using testing::HasSubstr;

const Vec3 gravity(0, 0, -9.81);
const std::filesystem::path leaves = pedicel::test::source_folder() / "assets/leaves";

const std::string good =
    "format: pedicel-leaf\n"
    "version: 1\n"
    "name: kite\n"
    "areal_density: 0.25\n"
    "material: {youngs_modulus: 2e8, poisson_ratio: 0.35, density: 950, damping_time: 0.01}\n"
    "petiole_radius: 0.012\n"
    "vein_radius: 0.005\n"
    "vertices: [[0, 0], [0.4, 0], [1, 0], [0.6, 0.3]]\n"
    "edges: [{ends: [0, 1]}, {ends: [1, 2], radius: 0.006}, {ends: [1, 3]}, {ends: [3, 2]}]\n"
    "triangles: [[1, 2, 3]]\n";

std::optional<LeafTemplate> parsed(const std::string& text, std::string& errors) {
  Diagnostics diagnostics;
  auto leaf = parse_leaf_template(text, "kite.leaf.yaml", diagnostics);
  errors = diagnostics.text();
  return leaf;
}

LeafTemplate shipped(const std::string& name) {
  Diagnostics diagnostics;
  const auto leaf = read_leaf_template(leaves / (name + ".leaf.yaml"), diagnostics);
  if (!leaf) throw UsageError(diagnostics.text());
  return *leaf;
}

TEST(LeafTemplate, ReadsWhatTheFileSays) {
  std::string errors;
  const auto leaf = parsed(good, errors);
  ASSERT_TRUE(leaf) << errors;
  EXPECT_EQ(leaf->name, "kite");
  EXPECT_EQ(leaf->areal_density, 0.25);
  EXPECT_EQ(leaf->material.youngs_modulus, 2.0e8);
  EXPECT_EQ(leaf->vertices[3], Eigen::Vector2d(0.6, 0.3));
  EXPECT_EQ(leaf->edges[3], (std::array<int, 2>{3, 2}));
  // At the foot the petiole's radius, elsewhere the veins', where the edge has none of its own.
  EXPECT_EQ(leaf->edge_radius, (std::vector<double>{0.012, 0.006, 0.005, 0.005}));
  EXPECT_EQ(leaf->triangles, (std::vector<std::array<int, 3>>{{1, 2, 3}}));
}

// Each rule: what is replaced in the good file, by what, and the words that name place and fault.
struct Refusal {
  std::string from, to, words;
};

TEST(LeafTemplate, RefusesEachFaultAtItsPlace) {
  const std::vector<Refusal> refusals = {
      {"pedicel-leaf", "pedicel-plant", ":1:9: error: format is"},
      {"version: 1", "version: 2", ":2:10: error: version is 2, expected 1"},
      {"name: kite\n", "", "missing key \"name\""},
      {"name: kite\n", "name: kite\ncolour: green\n", ":4:1: error: unknown key \"colour\""},
      {"areal_density: 0.25", "areal_density: 0", ":4:16: error: areal_density is"},
      {"2e8", "-1", ":5:28: error: youngs_modulus is"},
      {"poisson_ratio: 0.35", "poisson_ratio: 0.6", "error: poisson_ratio is"},
      {"density: 950", "density: 0", "error: density is"},
      {"damping_time: 0.01", "damping_time: -1", "error: damping_time is"},
      {"petiole_radius: 0.012", "petiole_radius: 0", ":6:17: error: petiole_radius is"},
      {"vein_radius: 0.005", "vein_radius: nan", ":7:14: error: vein_radius is"},
      {"[0.6, 0.3]", "[0.6]", ":8:38: error: vertex 3 has 1 numbers, expected [x, y]"},
      {"[[0, 0], ", "[[0.1, 0], ", ":8:12: error: vertex 0 is the foot"},
      {"[1, 0]", "[0.9, 0]", "the largest x is 0.900000, expected 1"},
      {"[0.6, 0.3]]\nedges: [", "[0.6, 0.3], [0, 0]]\nedges: [{ends: [0, 4]}, ",
       ":9:9: error: the edge has no length"},
      {"[[0, 0], [0.4, 0], [1, 0], [0.6, 0.3]]", "[]", ":8:11: error: vertices holds 0"},
      {"{ends: [3, 2]}", "{ends: [3, 4]}", "error: a vertex of ends is"},
      {"{ends: [3, 2]}", "{ends: [3, -1]}", "error: a vertex of ends is"},
      {"{ends: [3, 2]}", "{ends: [3]}", ":9:79: error: ends has 1 vertices, expected 2"},
      {"{ends: [3, 2]}", "{ends: [3, 3]}", ":9:79: error: ends names a vertex twice"},
      {"{ends: [3, 2]}", "{ends: [3, 1]}", ":9:72: error: the edge from vertex 3 to vertex 1 is"},
      {"{ends: [3, 2]}", "{radius: 0.01}", "missing key \"ends\""},
      {"radius: 0.006", "radius: 0", "error: radius is"},
      {"{ends: [1, 3]}, {ends: [3, 2]}", "{ends: [0, 2]}",
       ":8:38: error: no edges lead from the foot to vertex 3"},
      {"[[1, 2, 3]]", "[[1, 2]]", ":10:13: error: a triangle has 2 vertices, expected 3"},
      {"[[1, 2, 3]]", "[[1, 2, 2]]", ":10:13: error: a triangle names a vertex twice"},
      {"[[1, 2, 3]]", "[[1, 2, 7]]", ":10:20: error: a vertex of a triangle is"},
      {"[[1, 2, 3]]", "[[1, 3, 2]]", ":10:13: error: the triangle is flat or clockwise"},
      {"[[1, 2, 3]]", "[[0, 1, 2]]", ":10:13: error: the triangle is flat or clockwise"},
      {"[[1, 2, 3]]", "[[1, 2, 3", "not valid YAML"},
  };
  for (const Refusal& refusal : refusals) {
    std::string text = good, errors;
    const auto at = text.find(refusal.from);
    ASSERT_NE(at, std::string::npos) << refusal.from;
    text.replace(at, refusal.from.size(), refusal.to);
    EXPECT_FALSE(parsed(text, errors)) << refusal.to;
    EXPECT_THAT(errors, HasSubstr(refusal.words));
    EXPECT_THAT(errors, HasSubstr("kite.leaf.yaml"));
    EXPECT_EQ(std::count(errors.begin(), errors.end(), '\n') +
                  (errors.empty() || errors.back() == '\n' ? 0 : 1),
              1)
        << errors;
  }
}

TEST(LeafTemplate, ReportsAMissingFileAsAFault) {
  Diagnostics diagnostics;
  EXPECT_FALSE(read_leaf_template(leaves / "no_such.leaf.yaml", diagnostics));
  EXPECT_THAT(diagnostics.text(), HasSubstr("no_such.leaf.yaml"));
}

TEST(LeafTemplate, IsFoundInTheFirstFolderThatHasIt) {
  const std::filesystem::path own = std::filesystem::path(testing::TempDir()) / "own_leaves";
  std::filesystem::create_directories(own);
  std::ofstream(own / "ovate.leaf.yaml") << good;
  EXPECT_EQ(find_leaf_template("ovate", {own, leaves}), own / "ovate.leaf.yaml");
  EXPECT_EQ(find_leaf_template("apple", {own / "absent", own, leaves}), leaves / "apple.leaf.yaml");
  EXPECT_FALSE(find_leaf_template("fern", {own, leaves}));
  std::filesystem::remove_all(own);
}

void expect_axes(const Mat3& axes) {
  EXPECT_LT((axes.transpose() * axes - Mat3::Identity()).norm(), 1e-12);
  EXPECT_NEAR(axes.determinant(), 1.0, 1e-12);
}

TEST(LeafFrame, PointsTheMidribAlongDirectionElseTangent) {
  Random random(5);
  for (int i = 0; i < 100; ++i) {
    const Vec3 normal(random.normal(), random.normal(), random.normal());
    const Vec3 direction(random.normal(), random.normal(), random.normal());
    const Mat3 axes = leaf_frame(normal, direction, Vec3::UnitX(), i);
    expect_axes(axes);
    EXPECT_LT((axes.col(2) - normal.normalized()).norm(), 1e-12);
    if (normal.cross(direction).norm() < 0.11 * normal.norm() * direction.norm()) continue;
    EXPECT_NEAR(axes.col(1).dot(direction), 0.0, 1e-12);
    EXPECT_GT(axes.col(0).dot(direction), 0.0);
    EXPECT_EQ(leaf_frame(normal, std::nullopt, direction, i), axes);
  }
}

// On an upright stem with level leaves the next leaf stands a golden angle on: 2 pi (1 - 1 / g)
// with the golden ratio g.
TEST(LeafFrame, TurnsByTheGoldenAngleWhereTheTangentSaysNothing) {
  const double golden = 2.0 * M_PI * (2.0 - 0.5 * (1.0 + std::sqrt(5.0)));
  for (int number = 0; number < 8; ++number) {
    const Mat3 a = leaf_frame(Vec3::UnitZ(), std::nullopt, Vec3(0.01, 0, 1), number);
    const Mat3 b = leaf_frame(Vec3::UnitZ(), std::nullopt, Vec3(0.01, 0, 1), number + 1);
    expect_axes(b);
    const Vec3 turned = Eigen::AngleAxisd(golden, Vec3::UnitZ()) * Vec3(a.col(0));
    EXPECT_LT((b.col(0) - turned).norm(), 1e-5);
  }
}

// An upright stem of 12 cm in four segments with one leaf of 8 cm on its top.
struct Grown {
  RodModel model;
  std::vector<BladeTriangle> blades;
  int stem = 4;
  Mat3 axes;
  LeafTemplate leaf;
};

Grown grown(const std::string& name) {
  Grown plant;
  plant.leaf = shipped(name);
  plant.model.organs = {"plant/stem", "plant/leaf_1"};
  plant.model.root.rotation = Quat::Identity();
  const cosserat::Section stem = cosserat::circle_section(0.004, {5.0e8, 0.35, 900.0, 0.01});
  for (int e = 0; e < plant.stem; ++e) {
    cosserat::add_element(plant.model, e - 1, Vec3(0, 0, 0.03 * (e + 1)), stem);
    plant.model.elements.back().radius_near = plant.model.elements.back().radius_far = 0.004;
    plant.model.elements.back().damping_time = 0.01;
  }
  plant.axes = leaf_frame(Vec3(0.2, 0.1, 1), Vec3(1, 0.4, 0.3), Vec3::UnitZ(), 0);
  grow_leaf(plant.model, plant.stem - 1, Vec3(0, 0, 0.12), plant.axes, 0.08, plant.leaf, 1,
            plant.blades);
  cosserat::finish(plant.model);
  return plant;
}

class ShippedLeaf : public testing::TestWithParam<std::string> {};

TEST_P(ShippedLeaf, HasOneElementAnEdgeAndOneWeldALoop) {
  const Grown plant = grown(GetParam());
  const auto edges = plant.leaf.edges.size(), vertices = plant.leaf.vertices.size();
  EXPECT_EQ(plant.leaf.name, GetParam());
  EXPECT_GE(edges, 9u);
  EXPECT_LE(edges, 25u);
  EXPECT_EQ(plant.model.size(), plant.stem + static_cast<int>(edges));
  EXPECT_EQ(plant.model.welds.size(), edges - (vertices - 1));
  for (int e = 0; e < plant.model.size(); ++e) {
    EXPECT_LT(plant.model.elements[e].parent, e);
    EXPECT_EQ(plant.model.elements[e].organ, e < plant.stem ? 0 : 1);
    EXPECT_GT(plant.model.elements[e].radius_far, 0.0);
  }
  for (const cosserat::Weld& weld : plant.model.welds) {
    EXPECT_LT(
        (plant.model.elements[weld.a].drawn_position - plant.model.elements[weld.b].drawn_position)
            .norm(),
        1e-12);
    EXPECT_GT(weld.bend_stiffness.minCoeff(), 0.0);
  }
}

// Volume of the edges' cylinders times density, and the blade's area times its areal density.
TEST_P(ShippedLeaf, HasTheMassOfItsEdgesAndItsBlade) {
  const Grown plant = grown(GetParam());
  const LeafTemplate& leaf = plant.leaf;
  constexpr double size = 0.08;
  double expected = 0.0, found = 0.0, area = 0.0;
  for (std::size_t e = 0; e < leaf.edges.size(); ++e)
    expected += leaf.material.density * M_PI * std::pow(size * leaf.edge_radius[e], 2) * size *
                (leaf.vertices[leaf.edges[e][0]] - leaf.vertices[leaf.edges[e][1]]).norm();
  for (const auto& [a, b, c] : leaf.triangles) {
    const Eigen::Vector2d u = leaf.vertices[b] - leaf.vertices[a];
    const Eigen::Vector2d v = leaf.vertices[c] - leaf.vertices[a];
    area += 0.5 * size * size * (u.x() * v.y() - u.y() * v.x());
  }
  expected += leaf.areal_density * area;
  for (int e = plant.stem; e < plant.model.size(); ++e) found += plant.model.elements[e].mass;
  EXPECT_NEAR(found, expected, 1e-12);
  // A blade covers a good part of its own square: a leaf, not a twig.
  EXPECT_GT(area, 0.2 * size * size);
}

TEST_P(ShippedLeaf, IsDrawnWhereItsTemplateSays) {
  const Grown plant = grown(GetParam());
  const RodState state = cosserat::drawn_state(plant.model);
  ASSERT_EQ(plant.blades.size(), plant.leaf.triangles.size());
  for (std::size_t t = 0; t < plant.blades.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const PlacedPoint& corner = plant.blades[t].corners[i];
      const Eigen::Vector2d& vertex = plant.leaf.vertices[plant.leaf.triangles[t][i]];
      const Vec3 expected =
          Vec3(0, 0, 0.12) + 0.08 * (plant.axes * Vec3(vertex.x(), vertex.y(), 0));
      const Vec3 found = cosserat::point_on(plant.model, state, corner.element, corner.back);
      EXPECT_LT((found - expected).norm(), 1e-12);
    }
  }
}

double largest_distance(const RodModel& model, const RodState& state) {
  double largest = 0.0;
  for (int e = 0; e < model.size(); ++e)
    largest = std::max(largest, (state.position[e] - model.elements[e].drawn_position).norm());
  return largest;
}

// The welds carry their share of the leaf's weight, and the tree's own statics balance it exactly.
TEST_P(ShippedLeaf, StandsAsDrawnForASecond) {
  Grown plant = grown(GetParam());
  const cosserat::Standing standing = cosserat::stand_as_drawn(plant.model, gravity);
  ASSERT_TRUE(standing.solvable);
  EXPECT_LT(standing.largest_rest_bend, 0.5);
  RodState state = cosserat::drawn_state(plant.model);
  EXPECT_TRUE(cosserat::is_stable(plant.model, state, gravity));
  cosserat::DirectSolver solver({}, plant.model);
  double largest = 0.0;
  for (int step = 0; step < 240; ++step) {
    EXPECT_EQ(solver.step(plant.model, state, {1.0 / 240, gravity, {}, {}}).errors, 0u);
    largest = std::max(largest, largest_distance(plant.model, state));
  }
  EXPECT_LT(largest, 1e-6);
}

TEST_P(ShippedLeaf, SwingsBackFromALoad) {
  Grown plant = grown(GetParam());
  ASSERT_TRUE(cosserat::stand_as_drawn(plant.model, gravity).solvable);
  RodState state = cosserat::drawn_state(plant.model);
  cosserat::DirectSolver solver({}, plant.model);
  const std::vector<cosserat::Load> pull = {
      {plant.blades[0].corners[1].element, 0.0, Vec3(0, 0, -0.01), Vec3::Zero()}};
  for (int step = 0; step < 120; ++step)
    solver.step(plant.model, state, {1.0 / 240, gravity, pull, {}});
  EXPECT_GT(largest_distance(plant.model, state), 1e-3);
  for (int step = 0; step < 960; ++step)
    solver.step(plant.model, state, {1.0 / 240, gravity, {}, {}});
  EXPECT_LT(largest_distance(plant.model, state), 1e-5);
}

// A loop's weld holds: under a load the two ends of it stay together within a thousandth of what
// an edge gives way, here far below a micrometre.
TEST_P(ShippedLeaf, KeepsItsLoopsClosed) {
  Grown plant = grown(GetParam());
  ASSERT_TRUE(cosserat::stand_as_drawn(plant.model, gravity).solvable);
  RodState state = cosserat::drawn_state(plant.model);
  const std::vector<cosserat::Load> pull = {
      {plant.model.size() - 1, 0.0, Vec3(0.01, 0.01, -0.01), Vec3::Zero()}};
  cosserat::settle(plant.model, state, gravity, pull);
  EXPECT_GT(largest_distance(plant.model, state), 1e-4);
  for (const cosserat::Weld& weld : plant.model.welds)
    EXPECT_LT((state.position[weld.a] - state.position[weld.b]).norm(), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(All, ShippedLeaf, testing::Values("ovate", "apple", "tomato"),
                         [](const auto& tested) { return tested.param; });

TEST(GrowLeaf, RefusesASizeOfZero) {
  RodModel model;
  std::vector<BladeTriangle> blades;
  EXPECT_THROW(
      grow_leaf(model, -1, Vec3::Zero(), Mat3::Identity(), 0.0, shipped("ovate"), 0, blades),
      UsageError);
}

// From the root clamp, with every edge at the foot: no weld needs an element that is not there.
TEST(GrowLeaf, GrowsFromTheRoot) {
  std::string errors;
  auto leaf = parsed(good, errors);
  ASSERT_TRUE(leaf) << errors;
  leaf->triangles.push_back({0, 1, 3});
  leaf->edges.push_back({3, 0});
  leaf->edge_radius.push_back(0.005);
  RodModel model;
  model.organs = {"leaf"};
  std::vector<BladeTriangle> blades;
  grow_leaf(model, -1, Vec3::Zero(), Mat3::Identity(), 0.1, *leaf, 0, blades);
  cosserat::finish(model);
  ASSERT_EQ(model.size(), 5);
  EXPECT_EQ(model.elements[0].parent, -1);
  EXPECT_EQ(model.elements[1].parent, -1);
  EXPECT_EQ(model.welds.size(), 2u);
  const RodState state = cosserat::drawn_state(model);
  const PlacedPoint& foot = blades.back().corners[0];
  EXPECT_LT(cosserat::point_on(model, state, foot.element, foot.back).norm(), 1e-12);
}

}  // namespace
}  // namespace pedicel::plant::cases
