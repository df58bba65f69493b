// Contact and friction as energies, and what they do in a step.
#include "plugins/cosserat/solver/contact_terms.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "plugins/cosserat/lanes/lane_kernels.h"
#include "plugins/cosserat/model/rotation.h"
#include "tests/analytic/rod_cases.h"
#include "tests/analytic/sphere_source.h"
#include "tests/unit/cosserat/random_plants.h"

namespace pedicel::cosserat::cases {
namespace {

// Places a sphere so that it overlaps each of some shapes of a plant.
SphereSource touching_spheres(const RodModel& model, const RodState& state, Random& random) {
  SphereSource source;
  for (int s = 0; s < static_cast<int>(model.shapes.size()); s += 2) {
    const CollisionShape& shape = model.shapes[s];
    const Vec3 place =
        point_on(model, state, shape.element, 0.4 * model.elements[shape.element].length);
    Vec3 side = random_vector(random).cross(state.orientation[shape.element] * Vec3::UnitZ());
    side.normalize();
    const double radius = 0.01;
    source.spheres.push_back({place + side * (radius + shape.radius_near - 0.0005), radius,
                              random_vector(random, 2e-3)});
  }
  return source;
}

// A plant of which every other shape was pressed by a sphere in the step before, so that what
// touches it now rubs: with contacts found at an iterate.
struct Rubbed {
  explicit Rubbed(double friction) {
    for (Vec3& p : state.position) p += random_vector(random, 3e-4);
    source = touching_spheres(model, state, random);
    source.friction = friction;
    terms.find(model, start, state, 1e-3, {&pointer, 1});
    terms.finish(model, state);
    terms.find(model, start, state, 1e-3, {&pointer, 1});
    source.find(model, state, 1e-3, points);
  }
  Random random{5};
  RodModel model = random_plant(random, 8, false);
  RodState start = random_state(model, random, 1e-3, 0.1);
  RodState state = start;
  SphereSource source;
  ContactSource* pointer = &source;
  ContactTerms terms;
  std::vector<ContactPoint> points;
};

TEST(ContactLists, FollowEachOtherInOrder) {
  const auto of_shape = [](int shape) {
    ContactPoint point;
    point.shape = shape;
    return point;
  };
  ContactLists lists;
  for (int round = 0; round < 2; ++round) {  // lists keep nothing but their room
    EXPECT_EQ(lists.size(), 0u);
    lists.last().push_back(of_shape(0));
    const std::size_t first = lists.add(3);
    lists.list(first + 2).push_back(of_shape(3));
    lists.list(first).push_back(of_shape(1));  // the one in between stays empty
    lists.list(first).push_back(of_shape(2));
    lists.last().push_back(of_shape(4));
    ASSERT_EQ(lists.size(), 5u);
    for (int i = 0; i < 5; ++i) EXPECT_EQ(lists[i].shape, i);
    lists.clear();
  }
}

// The friction limit and the direction are frozen at the iterate: there the force is exactly the
// slope of the frozen potential, sticking or sliding; with every instruction set.
TEST(ContactTerms, ForceIsMinusTheSlopeOfThePotential) {
  for (const std::string& set : available_instruction_sets()) {
    use_instruction_set(set);
    for (const double friction : {0.0, 0.2, 50.0}) {
      const Rubbed rubbed(friction);
      const RodModel& model = rubbed.model;
      const RodState& state = rubbed.state;
      const ContactTerms& terms = rubbed.terms;
      ASSERT_GT(terms.size(), 3);
      std::vector<Mat6> diagonal(model.size(), Mat6::Zero());
      std::vector<Vec6> right_side(model.size(), Vec6::Zero());
      const auto [elements, blocks] = terms.blocks();
      for (std::size_t i = 0; i < blocks.size(); ++i)
        if (elements[i] >= 0) blocks[i].add_to(diagonal[elements[i]], right_side[elements[i]]);
      EXPECT_NEAR(terms.energy(), terms.potential(model, state), 1e-15);
      double largest = 0.0, worst = 0.0;
      constexpr double step =
          1e-8;  // small against the overlap: the potential has a kink at its edge
      for (int e = 0; e < model.size(); ++e) {
        for (int i = 0; i < 6; ++i) {
          const double slope = (terms.potential(model, nudged(state, e, i, step)) -
                                terms.potential(model, nudged(state, e, i, -step))) /
                               (2 * step);
          largest = std::max(largest, std::abs(slope));
          worst = std::max(worst, std::abs(right_side[e][i] + slope));
        }
      }
      EXPECT_LT(worst, 1e-5 * largest) << friction << " " << set;
      for (const Mat6& block : diagonal) {
        const Eigen::SelfAdjointEigenSolver<Mat6> eigen(block);
        EXPECT_GE(eigen.eigenvalues().minCoeff(), -1e-12 * eigen.eigenvalues().maxCoeff());
      }
    }
  }
  use_instruction_set("");
}

// Each block is that of a spring on the touching point (add_point_spring()) of stiffness k along
// the normal; across it none without friction, k where it sticks and less where it slides.
TEST(ContactTerms, BlocksAreThoseOfSpringsOnTheTouchingPoints) {
  for (const std::string& set : available_instruction_sets()) {
    use_instruction_set(set);
    for (const double friction : {0.0, 0.2, 50.0}) {
      const Rubbed rubbed(friction);
      const double k = rubbed.source.stiffness;
      ASSERT_EQ(rubbed.points.size(), static_cast<std::size_t>(rubbed.terms.size()));
      int pushing = 0;
      for (std::size_t i = 0; i < rubbed.points.size(); ++i) {
        const ContactPoint& point = rubbed.points[i];
        const ElementBlock& block = rubbed.terms.blocks().values[i];
        const int element = rubbed.terms.blocks().elements[i];
        EXPECT_EQ(element >= 0, point.gap < point.margin);
        if (element < 0) continue;
        ++pushing;
        ASSERT_EQ(element, rubbed.model.shapes[point.shape].element);
        Mat6 found = Mat6::Zero();
        Vec6 right_side = Vec6::Zero();
        block.add_to(found, right_side);
        const Vec3& n = point.normal_W;
        const Vec3 arm =
            -point.back * third_axis(rubbed.state.orientation[element]) - point.radius * n;
        const Mat3 hessian = found.topLeftCorner<3, 3>();
        DiagonalBlocks expected(rubbed.model.size());
        add_point_spring(expected, element, arm, hessian, right_side.head<3>());
        EXPECT_LT((found - expected.diagonal(element)).norm(), 1e-12 * k);
        EXPECT_LT((right_side - expected.right_side(element)).norm(), 1e-12 * k);
        EXPECT_LT((hessian * n - k * n).norm(), 1e-12 * k);
        EXPECT_NEAR(n.dot(right_side.head<3>()), k * (point.margin - point.gap), 1e-12 * k);
        const Vec3 across = hessian * n.unitOrthogonal();
        EXPECT_LT((across - across.norm() * n.unitOrthogonal()).norm(), 1e-12 * k);
        if (friction == 0.0)
          EXPECT_LT(across.norm(), 1e-12 * k);
        else if (friction == 50.0)
          EXPECT_NEAR(across.norm(), k, 1e-12 * k);
        else
          EXPECT_LT(across.norm(), 0.9 * k);
      }
      EXPECT_GT(pushing, 3);
    }
  }
  use_instruction_set("");
}

// A soft, well damped rod's tip is pressed on a sphere so large that it is a floor (radius 1 km),
// and then pulled sideways.
struct Pulled {
  Vec3 tip;
  ContactForce force;
};

Pulled pull(double sideways, double friction, double seconds) {
  constexpr double radius = PeerCantilever::radius, floor = 1000.0, press = 0.05;
  RodModel model = PeerCantilever::model(10);
  for (Element& element : model.elements) {
    element.radius_near = element.radius_far = radius;
    element.mass_damping = 20.0;
    element.damping_time = 0.05;
  }
  finish(model);
  model.shapes.erase(model.shapes.begin(), model.shapes.end() - 1);  // the last segment only
  Simulation sim(model);
  SphereSource source;
  source.friction = friction;
  const double below = floor + radius + source.margin;
  source.spheres.push_back({Vec3(PeerCantilever::length, 0, -below), floor, no_gravity});
  sim.contacts.push_back(&source);
  sim.loads.push_back({9, 0.0, Vec3(0, 0, -press), no_gravity});
  for (int i = 0; i < 480; ++i) sim.step(1.0 / 240.0, no_gravity);
  const int steps = static_cast<int>(240 * seconds);
  for (int i = 0; i < steps; ++i) {
    sim.loads[0].force_W.y() = sideways * std::min(1.0, (i + 1) / 24.0);
    sim.step(1.0 / 240.0, no_gravity);
  }
  EXPECT_EQ(sim.solver->contact_forces().size(), 1u);
  return {sim.tip(), sim.solver->contact_forces().at(0)};
}

// Below the limit the tip gives way by the spring's F / k, 10 um at 1000 N/m and 10 mN, and by
// rolling, r (F r) / (GJ / L) = 37 um, and does not creep; without friction the rod's own 3EI/L^3
// would let it go 170 mm.
TEST(ContactTerms, FrictionHoldsBelowItsLimitWithoutCreeping) {
  const Pulled early = pull(0.01, 0.5, 2.0), late = pull(0.01, 0.5, 6.0);
  EXPECT_NEAR(late.force.normal, 0.05, 0.001);
  EXPECT_FALSE(late.force.slipping);
  EXPECT_LT(late.tip.y(), 6e-5);
  EXPECT_NEAR(late.tip.y(), early.tip.y(), 1e-7);
  EXPECT_NEAR(late.force.tangential_W.y(), -0.01, 1e-4);
}

TEST(ContactTerms, FrictionSlipsAtItsLimit) {
  const Pulled slipping = pull(0.1, 0.5, 0.3);
  EXPECT_TRUE(slipping.force.slipping);
  EXPECT_NEAR(slipping.force.tangential_W.norm() / slipping.force.normal, 0.5, 0.02);
  EXPECT_GT(slipping.tip.y(), 1e-2);
}

// A floor beneath the node before the tip. In turn the segment before the node is found to touch
// it, and the one behind.
class FloorBelowNode : public ContactSource {
 public:
  double height = 0.0, friction = 0.5;

  void begin_step(const RodModel&, const RodState&, double) override { behind_ = !behind_; }
  void find(const RodModel& model, const RodState& state, double,
            std::vector<ContactPoint>& found) override {
    ContactPoint point;
    point.shape = behind_ ? 9 : 8;
    point.back = behind_ ? model.elements[9].length : 0.0;
    point.radius = PeerCantilever::radius;
    point.normal_W = Vec3::UnitZ();
    point.gap = point_on(model, state, point.shape, point.back).z() - point.radius - height;
    point.friction = friction;
    point.stiffness = 1000.0;
    found.push_back(point);
  }

 private:
  bool behind_ = false;
};

// m, by which 0.2 N across move a node that is pressed on the floor with 1 N, in 5 s.
double node_moves(double friction) {
  RodModel model = PeerCantilever::model(10);
  for (Element& element : model.elements) {
    element.mass_damping = 20.0;
    element.damping_time = 0.05;
  }
  finish(model);
  Simulation sim(model);
  FloorBelowNode floor;
  floor.friction = friction;
  floor.height = sim.state.position[8].z() - PeerCantilever::radius;
  sim.contacts.push_back(&floor);
  sim.loads.push_back({8, 0.0, Vec3(0, 0, -1.0), no_gravity});
  for (int i = 0; i < 240; ++i) sim.step(1.0 / 240.0, no_gravity);
  sim.loads[0].force_W.y() = 0.2;
  for (int i = 0; i < 1200; ++i) sim.step(1.0 / 240.0, no_gravity);
  const double tangential = sim.solver->contact_forces().at(0).tangential_W.y();
  EXPECT_NEAR(-tangential, friction > 0.0 ? 0.2 : 0.0, 0.01);
  return sim.state.position[8].y();
}

// Where friction began anew on each segment, nothing held the node. It gives way by the spring's
// 0.2 mm, and by what the two segments roll on in turn.
TEST(ContactTerms, FrictionHoldsOnANode) {
  EXPECT_LT(node_moves(0.5), 0.01 * node_moves(0.0));
}

// A floor that moves takes the tip along: surface motion is what friction works against.
TEST(ContactTerms, AMovingSurfaceCarriesThePlant) {
  for (const SolverKind kind : {SolverKind::direct, SolverKind::position_based}) {
    RodModel model = PeerCantilever::model(10);
    for (Element& element : model.elements) element.mass_damping = 5.0;
    finish(model);
    model.shapes.erase(model.shapes.begin(), model.shapes.end() - 1);
    RodSettings settings;
    settings.solver = kind;
    settings.iterations = 20;
    Simulation sim(model, settings);
    SphereSource source;
    source.spheres.push_back({Vec3(PeerCantilever::length, 0, -1000.0), 1000.0, no_gravity});
    sim.contacts.push_back(&source);
    sim.loads.push_back({9, 0.0, Vec3(0, 0, -0.05), no_gravity});
    for (int i = 0; i < 240; ++i) sim.step(1.0 / 240.0, no_gravity);
    source.spheres[0].motion = Vec3(0, 0.02 / 240.0, 0);  // 20 mm/s, for a second
    const double before = sim.tip().y();
    for (int i = 0; i < 240; ++i) sim.step(1.0 / 240.0, no_gravity);
    EXPECT_NEAR(sim.tip().y() - before, 0.02, 0.002) << static_cast<int>(kind);
  }
}

// Something that is found on one side of the tip and then on the other: no step converges.
class Flicker : public ContactSource {
 public:
  std::vector<std::pair<double, double>> covered;

  void cover(double from, double to) override { covered.emplace_back(from, to); }
  void find(const RodModel& model, const RodState&, double,
            std::vector<ContactPoint>& found) override {
    side_ = -side_;
    ContactPoint point;
    point.shape = static_cast<int>(model.shapes.size()) - 1;
    point.radius = PeerCantilever::radius;
    point.normal_W = side_ * Vec3::UnitY();
    point.gap = -0.02;
    point.stiffness = 20.0;
    found.push_back(point);
  }

 private:
  double side_ = 1.0;
};

// Such a step is taken again in two halves: what touches covers half of its way in each and all of
// it afterwards, the clamp moves evenly, time ends where it should, and the forces told are those
// of both halves, each with half of the spring.
TEST(ContactTerms, AStepThatDoesNotConvergeIsTakenInHalves) {
  Simulation sim(PeerCantilever::model(5));
  Flicker source;
  sim.contacts.push_back(&source);
  constexpr double dt = 1.0 / 240.0;
  sim.step(dt, gravity);
  sim.state.root.position.x() += 1e-3;
  source.covered.clear();
  const StepReport report = sim.step(dt, gravity);
  EXPECT_TRUE(report.errors & not_converged);
  const std::vector<std::pair<double, double>> halves{{0.0, 0.5}, {0.5, 1.0}, {0.0, 1.0}};
  EXPECT_EQ(source.covered, halves);
  EXPECT_DOUBLE_EQ(sim.state.time, 2 * dt);
  EXPECT_DOUBLE_EQ(sim.state.root.position.x(), 1e-3);
  EXPECT_DOUBLE_EQ(sim.state.previous_root.position.x(), 1e-3);
  ASSERT_EQ(sim.solver->contact_forces().size(), 2u);
  for (const ContactForce& force : sim.solver->contact_forces())
    EXPECT_DOUBLE_EQ(force.point.stiffness, 10.0);
  // Alone again, its steps are whole ones and converge.
  sim.contacts.clear();
  for (int i = 0; i < 120; ++i) sim.step(dt, gravity);
  EXPECT_EQ(sim.step(dt, gravity).errors, static_cast<unsigned>(none));
  EXPECT_EQ(source.covered.size(), halves.size());
}

}  // namespace
}  // namespace pedicel::cosserat::cases
