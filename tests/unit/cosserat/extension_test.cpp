// Joint laws, drag and drift in the rows of eight: gradients, passivity, the same bits whatever
// stands beside a plant, and frames turned about their third axis.
#include <gtest/gtest.h>

#include <functional>

#include "plugins/cosserat/lanes/lane_kernels.h"
#include "plugins/cosserat/model/turn_frame.h"
#include "plugins/cosserat/solver/direct_solver.h"
#include "plugins/cosserat/solver/rod_system.h"
#include "tests/support/rod_tips.h"
#include "tests/unit/cosserat/extension_cases.h"
#include "tests/unit/cosserat/step_potential.h"

namespace pedicel::cosserat::cases {
namespace {

constexpr double dt = 1.0 / 240.0;
const Vec3 gravity(0, 0, -9.81);

// As RodEnergy's: the force is minus the slope of the potential, sliders slipping or not, and
// Newton's matrix is positive definite. The drag's axis is part of the linearisation, not of the
// potential, so that the slope is taken with it kept.
TEST(Extension, ForceIsMinusTheSlopeOfThePotential) {
  for (int run = 0; run < 6; ++run) {
    Random random(300 + run);
    RodModel model = random_plant(random, 9, run % 2 == 1);
    extend(model, random, run < 3 ? 0.1 : 1.0);
    RodState start = random_state(model, random, 2e-3, 0.2);
    start_memory(model, start);
    for (Vec3& z : start.joint_memory) z = random_vector(random, 0.1);
    RodState state = start;
    for (int e = 0; e < model.size(); ++e) {
      state.position[e] += random_vector(random, 1e-3);
      state.orientation[e] = state.orientation[e] * exp_map(random_vector(random, 0.1));
    }
    StepPotential step(model);
    BlockSystem system(model);
    const RodHistory history = random_history(model, start, random, dt);
    step.prepare(start, {dt, gravity, {}, {}}, run < 3 ? &history : nullptr, &model);
    const double energy = step.linearise(model, state, system);
    EXPECT_NEAR(energy, step.potential(model, state), 1e-12 * std::abs(energy));
    double largest = 0.0, worst = 0.0;
    for (int e = 0; e < model.size(); ++e)
      for (int i = 0; i < 6; ++i) {
        const double slope = (step.potential(model, nudged(state, e, i, 1e-6)) -
                              step.potential(model, nudged(state, e, i, -1e-6))) /
                             2e-6;
        largest = std::max(largest, std::abs(slope));
        worst = std::max(worst, std::abs(system.right_side(e)[i] + slope));
      }
    EXPECT_LT(worst, 2e-6 * largest) << "run " << run;
    EXPECT_EQ(system.negative_eigenvalues(), 0) << "run " << run;
  }
}

// joint_response() is the same law in plain numbers: its moment is the slope of its energy.
TEST(Extension, MomentIsTheSlopeOfTheEnergy) {
  Random random(9);
  RodModel model = random_plant(random, 12, false);
  extend(model, random);
  RodState state = random_state(model, random, 0.0, 0.3);
  start_memory(model, state);
  for (int e = 0; e < model.size(); ++e) {
    const Vec3 phi = random_vector(random, 0.4);
    const JointResponse response = joint_response(model, state, e, phi);
    for (int i = 0; i < 3; ++i) {
      const Vec3 d = 1e-6 * Vec3::Unit(i);
      const double slope = (joint_response(model, state, e, phi + d).energy -
                            joint_response(model, state, e, phi - d).energy) /
                           2e-6;
      EXPECT_NEAR(response.moment[i], slope, 1e-6 * (response.moment.norm() + 1e-3)) << e;
    }
  }
}

// From the settled shape, where all memories start, nothing moves.
TEST(Extension, TheSettledShapeIsAnEquilibrium) {
  Random random(5);
  RodModel model = random_plant(random, 20, false);
  extend(model, random, 0.3);
  model.stiffness_drift = 0.0;
  for (SegmentAir& air : model.air) air.gust.setZero();
  for (JointLaw& law : model.laws)
    for (JointBranch& branch : law.branches)
      if (!branch.plastic && branch.from_unloaded) {  // those do move
        branch.from_unloaded = false;
        law.anchored += branch.share;
      }
  RodState state = drawn_state(model);
  EXPECT_EQ(settle(model, state, gravity).errors, 0u);
  const RodState settled = state;
  RodSystem system(RodSettings{});
  system.add_plant(model);
  system.set_state(0, state);
  for (int i = 0; i < 100; ++i) system.step(dt, gravity);
  EXPECT_GT((settled.position.back() - model.elements.back().drawn_position).norm(), 1e-3);
  for (int e = 0; e < model.size(); ++e)
    EXPECT_LT((system.state(0).position[e] - settled.position[e]).norm(), 1e-6) << e;
}

// Each dissipative law alone only takes energy (backward Euler, which adds none of its own).
TEST(Extension, EnergyNeverGrows) {
  const std::function<void(JointLaw&, double)> laws[] = {
      [](JointLaw& law, double) { add_relaxation(law, 0.4, 0.02, RelaxationStart::unloaded); },
      [](JointLaw& law, double) { add_structural_damping(law, 0.2); },
      [](JointLaw& law, double k) { add_friction(law, 0.4, 0.4 * k * 0.03); },
      [](JointLaw& law, double k) { add_yield(law, k * 0.1); },
      [](JointLaw& law, double) { law.term("material_nonlinearity") = 5.0; },
  };
  for (int kind = 0; kind < 6; ++kind) {
    Random random(40 + kind);
    RodModel model = random_plant(random, 12, false);
    for (Element& element : model.elements) element.damping_time = element.mass_damping = 0.0;
    if (kind < 5) {
      model.laws.resize(model.elements.size());
      for (int e = 0; e < model.size(); ++e)
        laws[kind](model.laws[e], model.elements[e].bend_stiffness.head<2>().minCoeff());
    } else {
      model.air.assign(model.elements.size(), {0.2, Vec3::Zero(), Vec3::Zero()});
    }
    RodSettings settings;
    settings.integrator = Integrator::backward_euler;
    settings.newton_iterations = 50;
    settings.tolerance = 1e-12;
    DirectSolver solver(settings, model);
    RodState state = drawn_state(model);
    start_memory(model, state);
    for (int e = 0; e < model.size(); ++e) {
      state.velocity[e] = random_vector(random, 1.0);
      state.angular_velocity[e] = random_vector(random, 20.0);
    }
    const double first = energy_of(model, state, Vec3::Zero()).total();
    double before = first;
    for (int i = 0; i < 400; ++i) {
      solver.step(model, state, {1e-3, Vec3::Zero(), {}, {}});
      const double now = energy_of(model, state, Vec3::Zero()).total();
      ASSERT_LE(now, before + 1e-7 * first) << "kind " << kind << " step " << i;
      before = now;
    }
    EXPECT_LT(before, 0.9 * first) << kind;
  }
}

std::vector<RodModel> extended_garden(int plants) {
  std::vector<RodModel> garden;
  for (int p = 0; p < plants; ++p) {
    Random random(1);  // the same plant, each with laws of its own
    garden.push_back(random_plant(random, 30, false));
    Random own(60 + p);
    if (p % 4 != 3) extend(garden.back(), own, 0.2);
  }
  return garden;
}

// Plants with laws, plants without and plants with other laws share packs.
TEST(Extension, APlantAloneMovesAsItDoesAmongOthers) {
  const std::vector<RodModel> plants = extended_garden(8);
  const std::vector<Vec3> together = tips_after(plants, 1, 120);
  EXPECT_EQ(together, tips_after(plants, 2, 120));
  for (std::size_t p = 0; p < plants.size(); ++p)
    EXPECT_EQ(together[p], tips_after({plants[p]}, 1, 120)[0]) << p;
  EXPECT_GT((together[0] - together[3]).norm(), 1e-4);
  EXPECT_EQ(together[3], together[7]) << "plain ones";
}

// Slipping is a switch, and chaos follows from it: fewer steps than RodRows' test.
TEST(Extension, InstructionSetsAgree) {
  const std::vector<RodModel> plants = extended_garden(4);
  const std::vector<Vec3> best = tips_after(plants, 1, 60);
  for (const std::string& name : available_instruction_sets()) {
    use_instruction_set(name);
    const std::vector<Vec3> tips = tips_after(plants, 1, 60);
    for (std::size_t p = 0; p < plants.size(); ++p)
      EXPECT_LT((tips[p] - best[p]).norm(), 1e-9) << name << " plant " << p;
  }
  use_instruction_set("");
}

// A state that is put back goes on as it did: the memory is in it.
TEST(Extension, AStateThatIsPutBackGoesOnAsBefore) {
  RodSystem system(RodSettings{});
  system.add_plant(extended_garden(1)[0]);
  for (int i = 0; i < 30; ++i) system.step(dt, gravity);
  const RodState saved = system.state(0);
  Vec3 tips[2];
  for (Vec3& tip : tips) {
    system.set_state(0, saved);
    for (int i = 0; i < 30; ++i) system.step(dt, gravity);
    tip = system.state(0).position.back();
  }
  EXPECT_EQ(tips[0], tips[1]);
}

TEST(Extension, ThePositionBasedSolverRefusesThem) {
  Random random(2);
  RodModel model = random_plant(random, 5, false);
  model.stiffness_drift = 1e-3;
  model.name = "fern";
  RodSettings settings;
  settings.solver = SolverKind::position_based;
  RodSystem system(settings);
  try {
    system.add_plant(model);
    FAIL() << "not refused";
  } catch (const std::exception& error) {
    EXPECT_NE(std::string(error.what()).find("plant \"fern\""), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("only the direct solver"), std::string::npos);
  }
}

// A plant whose frames are turned is the same plant. Sections with two equal extents: all of it;
// rotations by any angle, on elements that carry supports and welds too.
TEST(TurnFrame, ThePlantMovesAsBefore) {
  Random random(11);
  RodModel model = random_plant(random, 15, true);
  for (Element& element : model.elements) {
    element.section = circle_section(0.003, {1.0e7, 0.3, 600.0, 0.0});
  }
  for (Support& support : model.supports) support.rotation_stiffness = Vec3(0.1, 0.1, 0.3);
  for (Weld& weld : model.welds) weld.bend_stiffness = Vec3(0.2, 0.2, 0.1);
  finish(model);
  model.elements[4].rest_strain = Vec3(0.01, -0.02, 0.005);
  RodModel turned = model;
  for (int e = 0; e < model.size(); ++e) turn_frame(turned, e, random.uniform(-3.0, 3.0));
  RodSystem system(RodSettings{});
  system.add_plant(model);
  system.add_plant(turned);
  for (int i = 0; i < 100; ++i) system.step(dt, gravity);
  EXPECT_GT((system.state(0).position.back() - model.elements.back().drawn_position).norm(), 1e-4);
  for (int e = 0; e < model.size(); ++e)
    EXPECT_LT((system.state(0).position[e] - system.state(1).position[e]).norm(), 1e-8) << e;
}

}  // namespace
}  // namespace pedicel::cosserat::cases
