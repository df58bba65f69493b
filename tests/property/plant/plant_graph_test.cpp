#include "plugins/plant/plant_graph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/core/random.h"
#include "plugins/plant/plant_builder.h"

// The authoring pipeline on random drawings: a stem and branches that start on curves drawn before
// them, some of them drawn from tip to base, some with a gap below `connect`.
namespace pedicel::plant {
namespace {

constexpr double connect_below = 0.008;  // m

/// A curve of gentle turns from `start`: a random walk of directions, radius of curvature above
/// about 0.15 m.
PlantCurve random_curve(Random& random, const std::string& name, const Vec3& start,
                        Vec3 direction) {
  PlantCurve curve;
  curve.name = name;
  Vec3 at = start;
  curve.points.push_back(at);
  const int pieces = random.integer(2, 5);
  for (int i = 0; i < pieces; ++i) {
    const Vec3 turn(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    direction = (direction + 0.25 * turn).normalized();
    at += random.uniform(0.05, 0.1) * direction;
    curve.points.push_back(at);
  }
  curve.radius = {random.uniform(0.002, 0.006)};
  return curve;
}

PlantFile random_plant(Random& random) {
  PlantFile plant;
  plant.name = "random";
  plant.shape = Shape::rest;
  plant.material = {2.0e7, 0.35, 700.0, 0.01};
  plant.connect = connect_below;
  plant.distance = random.uniform(0.012, 0.04);
  plant.curves.push_back(random_curve(random, "stem", Vec3::Zero(), Vec3::UnitZ()));
  const int branches = random.integer(1, 6);
  for (int b = 0; b < branches; ++b) {
    const int below = random.integer(0, b);
    const auto curves = make_curves(plant);
    const Vec3 foot = curves[below].point(random.uniform(0.2, 1.0) * curves[below].length());
    const Vec3 away = Vec3(random.normal(), random.normal(), 0.5 * random.normal()).normalized();
    const double gap = random.uniform() < 0.3 ? random.uniform(0.0, 0.5 * connect_below) : 0.0;
    PlantCurve branch =
        random_curve(random, "branch_" + std::to_string(b), foot + gap * away, away);
    if (random.uniform() < 0.3) std::reverse(branch.points.begin(), branch.points.end());
    plant.curves.push_back(std::move(branch));
  }
  return plant;
}

class RandomDrawing : public testing::TestWithParam<int> {
 protected:
  RandomDrawing() : random_(static_cast<std::uint64_t>(GetParam())), plant_(random_plant(random_)) {
    Diagnostics diagnostics;
    graph_ = connect(plant_, make_curves(plant_), diagnostics);
    EXPECT_TRUE(graph_) << diagnostics.text();
    if (graph_) simplify(*graph_, plant_.distance);
  }

  Random random_;
  PlantFile plant_;
  std::optional<PlantGraph> graph_;
};

TEST_P(RandomDrawing, IsATree) {
  ASSERT_TRUE(graph_);
  std::vector<char> curve_is_there(plant_.curves.size(), 0);
  for (std::size_t n = 0; n < graph_->nodes.size(); ++n) {
    const GraphNode& node = graph_->nodes[n];
    curve_is_there[node.curve] = 1;
    // One root, and every other node hangs on an earlier one: connected and free of cycles.
    EXPECT_EQ(node.parent < 0, n == 0);
    EXPECT_LT(node.parent, static_cast<int>(n));
    for (const int child : node.children)
      EXPECT_EQ(graph_->nodes[child].parent, static_cast<int>(n));
  }
  EXPECT_EQ(std::count(curve_is_there.begin(), curve_is_there.end(), 1),
            static_cast<long>(plant_.curves.size()));
}

TEST_P(RandomDrawing, KeepsEveryKeyNode) {
  ASSERT_TRUE(graph_);
  for (const GraphNode& node : graph_->nodes)
    if (node.parent < 0 || node.children.size() != 1) {
      EXPECT_TRUE(node.kept);
    }
}

// Path length from a kept node to the kept node above it. Between two nodes that are no key nodes
// it is at least `distance`; below a kept node that is none, a key node is at least half of it
// away; between key nodes any length may be. No gap is longer than `distance`, half of it (a node
// that went) and one sample.
TEST_P(RandomDrawing, SpacesItsNodesByTheRule) {
  ASSERT_TRUE(graph_);
  const double step = sampling_step(make_curves(plant_), plant_.connect, plant_.distance);
  for (int n = 1; n < static_cast<int>(graph_->nodes.size()); ++n) {
    if (!graph_->nodes[n].kept) continue;
    const int above = graph_->kept_parent(n);
    double path = 0.0;
    for (int at = n; at != above; at = graph_->nodes[at].parent)
      path +=
          (graph_->nodes[at].position - graph_->nodes[graph_->nodes[at].parent].position).norm();
    const bool key = graph_->nodes[n].is_key(), key_above = graph_->nodes[above].is_key();
    if (!key) {
      EXPECT_GE(path, plant_.distance * (1 - 1e-6));
    }
    if (key && !key_above) {
      EXPECT_GE(path, 0.5 * plant_.distance * (1 - 1e-6));
    }
    EXPECT_LE(path, 1.5 * plant_.distance + 2.0 * step + plant_.connect);
  }
}

// A chord of length d across an arc of radius R is shorter than it by (d/R)^2/24: with R > 2 d that
// is 1 % at most.
TEST_P(RandomDrawing, KeepsItsLength) {
  ASSERT_TRUE(graph_);
  double sampled = 0.0;
  for (const GraphNode& node : graph_->nodes)
    if (node.parent >= 0) sampled += (node.position - graph_->nodes[node.parent].position).norm();
  EXPECT_NEAR(graph_->kept_length() / sampled, 1.0, 0.01);
}

TEST_P(RandomDrawing, BuildsRodsThatCoverEveryPlaceExactly) {
  Diagnostics diagnostics;
  const auto built = build_plant(plant_, {}, diagnostics);
  ASSERT_TRUE(built) << diagnostics.text();
  const auto curves = make_curves(plant_);
  for (int i = 0; i < 10; ++i) {
    const int curve = random_.integer(0, static_cast<int>(plant_.curves.size()) - 1);
    const double at = random_.uniform();
    const PlacedPoint place = built->locate(curve, at);
    const cosserat::Element& element = built->model.elements[place.element];
    const double share = place.back / element.length;
    const Vec3 found =
        (1.0 - share) * element.drawn_position + share * built->model.drawn_start(place.element);
    // Off the drawn curve by at most the arc's height over its chord, and at a joint by the gap
    // that the joining segment bridges.
    EXPECT_LT((found - curves[curve].point(at * curves[curve].length())).norm(),
              0.15 * plant_.distance + connect_below);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomDrawing, testing::Range(1, 61));

TEST(PlantGraph, SamplesFinerThanTheClosestCurvesAndNotBelowTheFloor) {
  PlantFile plant;
  plant.curves.resize(2);
  plant.curves[0].points = {{0, 0, 0}, {0, 0, 0.2}};
  plant.curves[1].points = {{0.004, 0, 0}, {0.004, 0, 0.2}};
  for (PlantCurve& curve : plant.curves) {
    curve.interpolation = Interpolation::linear;
    curve.radius = {0.001};
  }
  EXPECT_LT(sampling_step(make_curves(plant), 0.01, 0.1), 0.004);
  plant.curves[1].points = {{0, 0, 0.1}, {0.1, 0, 0.1}};  // they touch
  EXPECT_DOUBLE_EQ(sampling_step(make_curves(plant), 0.01, 0.1), 0.0025);
  EXPECT_DOUBLE_EQ(sampling_step(make_curves(plant), 0.2, 0.1), 0.025);
}

TEST(PlantGraph, NamesACurveThatReachesNothingAndByHowMuch) {
  Diagnostics diagnostics;
  const auto plant = parse_plant(R"(format: pedicel-plant
version: 1
name: gap
material: {youngs_modulus: 2.0e7, poisson_ratio: 0.35, density: 700, damping_time: 0.01}
sampling: {connect: 0.01, distance: 0.02}
root: [0, 0, 0]
curves:
  - {name: stem, interpolation: linear, points: [[0, 0, 0], [0, 0, 0.2]], radius: 0.003}
  - {name: lost, interpolation: linear, points: [[0.03, 0, 0.1], [0.1, 0, 0.1]], radius: 0.003}
)",
                                 "gap.plant.yaml", diagnostics);
  ASSERT_TRUE(plant) << diagnostics.text();
  EXPECT_FALSE(build_plant(*plant, {}, diagnostics));
  EXPECT_EQ(
      diagnostics.text(),
      "gap.plant.yaml:9:5: error: curve \"lost\" reaches nothing: its nearer end is 30 mm from "
      "the plant, expected less than connect = 10 mm");
}

}  // namespace
}  // namespace pedicel::plant
