// Contact and friction as energies, and what they do in a step.
#include "cosserat/contact_terms.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "analytic/rod_cases.h"
#include "analytic/sphere_source.h"
#include "unit/cosserat/random_plants.h"

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

// The friction limit and the direction are frozen at the iterate: there the force is exactly the
// slope of the frozen potential, sticking or sliding.
TEST(ContactTerms, ForceIsMinusTheSlopeOfThePotential) {
  for (const double friction : {0.0, 0.2, 50.0}) {
    Random random(5);
    const RodModel model = random_plant(random, 8, false);
    const RodState start = random_state(model, random, 1e-3, 0.1);
    RodState state = start;
    for (Vec3& p : state.position) p += random_vector(random, 3e-4);
    SphereSource source = touching_spheres(model, state, random);
    source.friction = friction;
    ContactSource* pointer = &source;
    ContactTerms terms;
    terms.find(model, start, state, 1e-3, {&pointer, 1});
    ASSERT_GT(terms.size(), 3);
    std::vector<Mat6> diagonal(model.size(), Mat6::Zero());
    std::vector<Vec6> right_side(model.size(), Vec6::Zero());
    for (const ElementBlock& block : terms.blocks())
      if (block.element >= 0) block.add_to(diagonal[block.element], right_side[block.element]);
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
    EXPECT_LT(worst, 1e-5 * largest) << friction;
    for (const Mat6& block : diagonal) {
      const Eigen::SelfAdjointEigenSolver<Mat6> eigen(block);
      EXPECT_GE(eigen.eigenvalues().minCoeff(), -1e-12 * eigen.eigenvalues().maxCoeff());
    }
  }
}

// Against the spring of any stiffness matrix: hessian = across I + (along - across) axis axis^T.
TEST(PointSpring, IsThatOfItsStiffnessMatrix) {
  Random random(7);
  for (const double across : {0.0, 3.0}) {
    const Vec3 arm = random_vector(random, 1.0), force = random_vector(random, 1.0);
    const Vec3 axis = random_vector(random, 1.0).normalized();
    constexpr double along = 5.0;
    DiagonalBlocks expected(1);
    add_point_spring(expected, 0, arm,
                     across * Mat3::Identity() + (along - across) * axis * axis.transpose(), force);
    Mat6 diagonal = Mat6::Zero();
    Vec6 right_side = Vec6::Zero();
    point_spring(0, arm, axis, along, across, force).add_to(diagonal, right_side);
    EXPECT_LT((diagonal - expected.diagonal(0)).norm(), 1e-14);
    EXPECT_LT((right_side - expected.right_side(0)).norm(), 1e-14);
    for (const ElementBlock& block : expected.packed()) {
      block.add_to(diagonal, right_side);
      EXPECT_EQ(block.element, 0);
    }
    EXPECT_LT((diagonal - 2.0 * expected.diagonal(0)).norm(), 1e-14);
  }
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
