// Standing as drawn: the drawn shape carries no net force on any element, and where supports and
// welds leave a choice, their loads are those of beam theory.
#include "plugins/cosserat/solver/standing.h"

#include <gtest/gtest.h>

#include "plugins/cosserat/solver/direct_solver.h"
#include "tests/unit/cosserat/random_plants.h"
#include "tests/unit/cosserat/step_potential.h"

namespace pedicel::cosserat::cases {
namespace {

const Vec3 gravity(0, 0, -9.81);

double largest_force(const RodModel& model) {
  const RodState state = drawn_state(model);
  StepPotential step(model);
  BlockSystem system(model);
  step.prepare(state, {1e3, gravity, {}, {}}, nullptr);  // inertia weighs nothing
  step.linearise(model, state, system);
  double largest = 0.0;
  for (int e = 0; e < model.size(); ++e) largest = std::max(largest, system.right_side(e).norm());
  return largest;
}

// Weights are 0.01 N to 0.1 N; what is left is rounding. (Some random plants are too limp to
// stand.)
TEST(Standing, DrawnShapeIsAnEquilibrium) {
  int standing = 0;
  for (int seed = 0; seed < 20; ++seed) {
    Random random(seed);
    RodModel model = random_plant(random, 10, false);
    EXPECT_GT(largest_force(model), 1e-3);
    if (!stand_as_drawn(model, gravity).solvable) continue;
    EXPECT_LT(largest_force(model), 1e-9) << "seed " << seed;
    ++standing;
  }
  EXPECT_GT(standing, 10);
}

TEST(Standing, WithASupportAndAWeldToo) {
  int standing = 0;
  for (int seed = 0; seed < 20; ++seed) {
    Random random(seed);
    RodModel model = random_plant(random, 10, true);
    if (!stand_as_drawn(model, 2.0 * gravity).solvable) continue;
    ASSERT_TRUE(stand_as_drawn(model, gravity).solvable);  // again, as after a change of the model
    EXPECT_LT(largest_force(model), 1e-9) << "seed " << seed;
    ++standing;
  }
  EXPECT_GT(standing, 10);
}

constexpr int parts = 40;  // elements of each straight piece of the beams below
const Material stiff{1.0e9, 0.3, 600.0, 0.0};

// A straight piece from the end of `parent` to a point; comes back with its last element.
int add_piece(RodModel& model, int parent, const Vec3& end, const Section& section) {
  const Vec3 start = parent < 0 ? model.root.position : model.elements[parent].drawn_position;
  for (int i = 1; i <= parts; ++i)
    parent = add_element(model, parent, start + (end - start) * i / parts, section);
  return parent;
}

void add_prop(RodModel& model, int element, double rotation_stiffness) {
  Support prop;
  prop.element = element;
  prop.position = model.elements[element].drawn_position;
  prop.position_stiffness = 1.0e6;
  prop.rotation_stiffness.setConstant(rotation_stiffness);
  model.supports.push_back(prop);
}

// What a support does to the plant at its point, W.
Vec6 reaction(const RodModel& model, const Support& support) {
  const Element& element = model.elements[support.element];
  const Quat& q = element.drawn_rotation;
  const Vec3 phi = log_map(support.rotation.conjugate() * q);
  Vec6 all;
  all << support.position_stiffness * (support.position - element.drawn_position),
      -(q * support.rotation_stiffness.cwiseProduct(phi));
  return all;
}

// Beam theory leaves out shear and the length of the axis: errors of (r/L)^2, here below 1e-4,
// times numbers near ten. Elements that bend at their joints add O(1/parts^2) = 6e-4 times numbers
// of order one, and the props, which give way by 1e-4 of what the beams do, 1e-4.
constexpr double beam_theory = 3.0e-3;

// A horizontal beam of two equal spans of weight W each, clamped, propped in the middle and at its
// end. The equations of three moments, 2 M_0 + M_1 = -W l/4 and M_0 + 4 M_1 = -W l/2, give
// M_0 = -W l/14, M_1 = -3 W l/28 and so the reactions 8/7 W and 11/28 W.
TEST(Standing, BeamOnTwoPropsSharesItsWeightByThreeMoments) {
  const Section section = circle_section(0.003, stiff);
  RodModel model;
  const int middle = add_piece(model, -1, Vec3(0.25, 0, 0), section);
  const int end = add_piece(model, middle, Vec3(0.5, 0, 0), section);
  add_prop(model, middle, 0.0);
  add_prop(model, end, 0.0);
  finish(model);
  ASSERT_TRUE(stand_as_drawn(model, gravity).solvable);
  const double weight = section.mass * 0.25 * 9.81;
  EXPECT_NEAR(reaction(model, model.supports[0]).z() / weight, 8.0 / 7.0, beam_theory);
  EXPECT_NEAR(reaction(model, model.supports[1]).z() / weight, 11.0 / 28.0, beam_theory);
  EXPECT_LT(largest_force(model), 1e-9);
}

// One span, clamped, with a prop under its end: 3/8 of its weight (Timoshenko, Strength of
// Materials, propped cantilever).
TEST(Standing, ProppedCantileverCarriesThreeEighths) {
  const Section section = circle_section(0.003, stiff);
  RodModel model;
  add_prop(model, add_piece(model, -1, Vec3(0.5, 0, 0), section), 0.0);
  finish(model);
  ASSERT_TRUE(stand_as_drawn(model, gravity).solvable);
  const double weight = section.mass * 0.5 * 9.81;
  EXPECT_NEAR(reaction(model, model.supports[0]).z() / weight, 3.0 / 8.0, beam_theory);
}

// A portal frame of equal members h = L with clamped feet. Under the weight W of its beam (that of
// its columns runs straight down) the feet push outwards with H = W L/(4 h (k + 2)), k = h/L, and
// carry moments of H h/3 that stretch the inner side (Kleinlogel, Rigid Frame Formulas): W/12 and
// W L/36.
TEST(Standing, PortalFrameThrustsByATwelfthOfItsBeam) {
  constexpr double side = 0.5;
  const Section section = circle_section(0.003, stiff);
  RodModel model;
  const int left = add_piece(model, -1, Vec3(0, 0, side), section);
  const int right = add_piece(model, left, Vec3(side, 0, side), section);
  const int foot_element = add_piece(model, right, Vec3(side, 0, 0), section);
  // A clamp there: the half segment next to it bends.
  add_prop(model, foot_element, 2.0 * section.bend1 / model.elements[foot_element].length);
  finish(model);
  ASSERT_TRUE(stand_as_drawn(model, gravity).solvable);
  const double weight = section.mass * side * 9.81;
  const Vec6 foot = reaction(model, model.supports[0]);
  EXPECT_NEAR(foot[0] / weight, -1.0 / 12.0, beam_theory / 12.0);
  EXPECT_NEAR(foot[2] / weight, 1.5, beam_theory);
  EXPECT_NEAR(foot[4] / (weight * side), -1.0 / 36.0, beam_theory / 36.0);
  EXPECT_LT(largest_force(model), 1e-9);
}

// A ring hung at its top, welded together at its bottom. Inextensible bending of half a ring with
// tension N and moment M at the cut, w its weight per length, phi from the bottom:
//   M(phi) = M - N R (1 - cos phi) + w R^2 (phi sin phi - 1 + cos phi);
// neither end turns or moves sideways: the integrals of M(phi) and M(phi) cos phi vanish, so that
// N = -w R/2 (compression) and M = N R. By symmetry the weld carries no weight.
TEST(Standing, RingPushesOnItsWeld) {
  constexpr int n = 60;
  constexpr double radius = 0.2, pi = 3.14159265358979323846;
  const Section section = circle_section(0.002, stiff);
  RodModel model;
  Weld weld;
  int* const ends[] = {&weld.a, &weld.b};
  for (int half = 0; half < 2; ++half) {
    int last = -1;
    for (int i = 1; i <= n; ++i) {
      const double angle = pi * i / n, side = half == 0 ? 1.0 : -1.0;
      last = add_element(model, last,
                         radius * Vec3(side * std::sin(angle), 0, std::cos(angle) - 1.0), section);
    }
    *ends[half] = last;
  }
  const double length = model.elements[0].length;
  weld.position_stiffness = 1000.0 * section.axial / length;
  weld.bend_stiffness = Vec3(section.bend1, section.bend2, section.twist) / length;
  model.welds.push_back(weld);
  finish(model);
  ASSERT_TRUE(stand_as_drawn(model, gravity).solvable);
  const Element &a = model.elements[weld.a], &b = model.elements[weld.b];
  const Vec3 on_a = weld.position_stiffness * (b.drawn_position - a.drawn_position);
  const Vec3 phi = log_map(model.welds[0].rest_rotation.conjugate() *
                           (a.drawn_rotation.conjugate() * b.drawn_rotation));
  const Vec3 moment_on_a = b.drawn_rotation * weld.bend_stiffness.cwiseProduct(phi);
  const double unit = section.mass * 9.81 * radius;
  EXPECT_NEAR(on_a.x() / unit, 0.5, beam_theory);
  EXPECT_NEAR(on_a.z() / unit, 0.0, 1e-6);
  EXPECT_NEAR(moment_on_a.y() / (unit * radius), 0.5, beam_theory);
  EXPECT_LT(largest_force(model), 1e-9);
}

// Three stems from one foot to one tip, each tip welded to both others: nodes of a chain and a
// cycle of welds are moved as one.
RodModel tripod(double youngs_modulus) {
  const Section section = circle_section(0.003, {youngs_modulus, 0.3, 600.0, 0.0});
  RodModel model;
  int tips[3];
  for (int i = 0; i < 3; ++i) {
    const double angle = 2.0 * i + 0.3;
    const Vec3 knee(0.05 * std::cos(angle), 0.05 * std::sin(angle), 0.1);
    tips[i] = add_piece(model, add_piece(model, -1, knee, section), Vec3(0, 0, 0.2), section);
  }
  for (const auto& [a, b] : {std::pair(2, 1), {0, 1}, {2, 0}}) {
    Weld weld;
    weld.a = tips[a];
    weld.b = tips[b];
    weld.position_stiffness = 500.0;
    weld.bend_stiffness = Vec3(0.2, 0.1, 0.3);
    model.welds.push_back(weld);
  }
  finish(model);
  return model;
}

TEST(Standing, BalancesNodesOfSeveralWelds) {
  RodModel model = tripod(1.0e8);
  EXPECT_GT(largest_force(model), 1e-4);
  ASSERT_TRUE(stand_as_drawn(model, gravity).solvable);
  EXPECT_LT(largest_force(model), 1e-9);
}

// Least elastic energy is free of stress without gravity, to first order: strains that do not fit
// each other are left in the second order of gravity g, and so an energy of order g^4 (of g^2 with
// any other choice of the loads). Halving g divides it by 16, up to the next order.
TEST(Standing, IsFreeOfStressWithoutGravityToFirstOrder) {
  const auto energy_left = [](double share) {
    RodModel model = tripod(1.0e7);
    EXPECT_TRUE(stand_as_drawn(model, share * gravity).solvable);
    RodState state = drawn_state(model);
    EXPECT_EQ(settle(model, state, Vec3::Zero()).errors, 0u);
    return energy_of(model, state, Vec3::Zero()).elastic;
  };
  EXPECT_NEAR(energy_left(1.0) / energy_left(0.5), 16.0, 2.0);
}

// In a tree the drawn shape is the equilibrium to rounding; a weld opens by force / stiffness, with
// 0.05 N at most and 200 N/m by 0.25 mm.
TEST(Standing, ResidualIsTheOpeningOfWelds) {
  for (const bool loops : {false, true}) {
    Random random(3);
    const RodModel drawn = random_plant(random, 10, loops);
    RodModel model = drawn;
    ASSERT_TRUE(stand_as_drawn(model, gravity).solvable);
    const Residual residual = settled_from(drawn, model, gravity);
    EXPECT_TRUE(residual.settled);
    if (!loops) {
      EXPECT_LT(residual.largest, 1e-9);
      continue;
    }
    const Weld& weld = model.welds[0];
    EXPECT_EQ(residual.element, weld.b);
    const double opening =
        (model.elements[weld.b].drawn_position - model.elements[weld.a].drawn_position).norm();
    EXPECT_NEAR(residual.largest, opening, 1e-9);
    EXPECT_GT(opening, 1e-7);
    EXPECT_LT(opening, 0.25e-3);
    EXPECT_NEAR(residual.rms, opening / std::sqrt(model.size()), 1e-9);
  }
}

// Not made to stand, a plant settles where it sags to.
TEST(Standing, ResidualIsTheSagOfAPlantThatWasNotMadeToStand) {
  RodModel model;
  add_piece(model, -1, Vec3(0.5, 0, 0), circle_section(0.003, stiff));
  finish(model);
  RodState state = drawn_state(model);
  settle(model, state, gravity);
  const Residual residual = settled_from(model, model, gravity);
  EXPECT_EQ(residual.element, parts - 1);
  EXPECT_EQ(residual.largest, (state.position.back() - Vec3(0.5, 0, 0)).norm());
  EXPECT_GT(residual.rms, 0.3 * residual.largest);
  EXPECT_LT(residual.rms, 0.7 * residual.largest);
}

TEST(Standing, NamesTheJointThatWouldHaveToBendTooFar) {
  RodModel model;
  const Section limp = circle_section(0.0005, {1.0e6, 0.3, 600.0, 0.0});
  add_element(model, -1, Vec3(0.2, 0, 0), limp);
  model.fruits.push_back({"fruit", 0, 0.0, 0.03, 900.0, {}});
  finish(model);
  const Standing standing = stand_as_drawn(model, gravity);
  EXPECT_FALSE(standing.solvable);
  EXPECT_EQ(standing.element, 0);
}

}  // namespace
}  // namespace pedicel::cosserat::cases
