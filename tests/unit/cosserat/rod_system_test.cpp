// Many plants: the same bits with any number of threads; states set from outside; what a step says.
#include "plugins/cosserat/solver/rod_system.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <numeric>
#include <span>

#include "plugins/cosserat/solver/joined_systems.h"
#include "plugins/plant/reference_plants.h"
#include "tests/analytic/rod_cases.h"
#include "tests/analytic/sphere_source.h"
#include "tests/unit/cosserat/extension_cases.h"
#include "tests/unit/cosserat/random_plants.h"

namespace pedicel::cosserat::cases {
namespace {

constexpr double dt = 1.0 / 240.0;

void plant_garden(RodSystem& system) {
  for (int p = 0; p < 7; ++p) {
    Random random(p);
    RodModel model = random_plant(random, 10 + p, p % 3 == 0);
    model.fruits[0].thresholds.stretch = 2e-3;
    const Vec3 tip = model.elements.back().drawn_position;
    system.add_plant(std::move(model));
    auto spheres = std::make_unique<SphereSource>();
    spheres->spheres.push_back({tip - Vec3(0, 0, 0.025), 0.02, Vec3::Zero()});
    system.add_contact_source(p, std::move(spheres));
    system.loads(p).push_back({0, 0.0, Vec3(0.01, 0, 0), Vec3::Zero()});
  }
}

std::uint64_t hash_after(const RodSettings& settings, int threads, int steps) {
  RodSystem system(settings, threads);
  plant_garden(system);
  for (int i = 0; i < steps; ++i) system.step(dt, gravity);
  StateHash hash;
  system.add_to(hash);
  return hash.value();
}

TEST(RodSystem, SameBitsWithOneAndTwoThreads) {
  for (const SolverKind kind : {SolverKind::direct, SolverKind::position_based}) {
    RodSettings settings;
    settings.solver = kind;
    const std::uint64_t one = hash_after(settings, 1, 120);
    EXPECT_EQ(one, hash_after(settings, 2, 120));
    EXPECT_EQ(one, hash_after(settings, 1, 120));
    EXPECT_NE(one, hash_after(settings, 1, 121));
  }
}

// Solved side by side, systems go as each does alone.
TEST(JoinedSystems, GoAsEachDoesAlone) {
  const RodSettings settings;
  const std::uint64_t alone = hash_after(settings, 1, 60);
  RodSystem a(settings), b(settings), c(settings);
  const std::vector<RodSystem*> all = {&a, &b, &c};
  for (RodSystem* one : all) plant_garden(*one);
  JoinedSystems joined(settings, all);
  for (int i = 0; i < 60; ++i)
    joined.step([&](int s) { all[static_cast<std::size_t>(s)]->step(dt, gravity); });
  for (RodSystem* one : all) {
    StateHash hash;
    one->add_to(hash);
    EXPECT_EQ(hash.value(), alone);
  }
}

// A world of robots and bodies alone; a plant may come later.
TEST(RodSystem, WithoutPlantsAStepDoesNothing) {
  for (const SolverKind kind : {SolverKind::direct, SolverKind::position_based})
    for (const int threads : {1, 2}) {
      RodSettings settings;
      settings.solver = kind;
      RodSystem system(settings, threads);
      StateHash before, after;
      system.add_to(before);
      system.step(dt, gravity);
      system.change_settings(settings);
      system.step(dt, gravity);
      system.add_to(after);
      EXPECT_EQ(before.value(), after.value());
      EXPECT_EQ(system.size(), 0);
      plant_garden(system);
      for (int i = 0; i < 10; ++i) system.step(dt, gravity);
      StateHash later;
      system.add_to(later);
      EXPECT_EQ(later.value(), hash_after(settings, threads, 10));
    }
}

// Many plants are stepped in beds, a few plants each, and from 8,000 elements on their rows stand
// on huge pages. Damping that a plant gets on the way takes more of them.
TEST(RodSystem, ManyPlantsMoveAsOneAlone) {
  constexpr int plants = 140;  // 8,260 elements
  const auto states_after = [](int threads, std::span<const int> numbers) {
    RodSystem system({}, threads);
    for (const int p : numbers) system.add_plant(plant::forest_plant(p));
    for (int i = 0; i < 10; ++i) system.step(dt, gravity);
    for (int p = 0; p < system.size(); ++p) {
      RodModel damped = system.model(p);
      for (Element& element : damped.elements) element.damping_time = 0.01;
      system.change_constants(p, std::move(damped));
    }
    for (int i = 0; i < 10; ++i) system.step(dt, gravity);
    std::vector<RodState> states;
    for (int p = 0; p < system.size(); ++p) states.push_back(system.state(p));
    return states;
  };
  std::vector<int> all(plants);
  std::iota(all.begin(), all.end(), 0);
  for (const int threads : {1, 2}) {
    const std::vector<RodState> together = states_after(threads, all);
    for (const int p : {0, 1, 69, 70, plants - 1}) {
      const RodState alone = states_after(1, std::array{p}).front();
      EXPECT_EQ(together[p].position, alone.position) << threads << " threads, plant " << p;
      EXPECT_EQ(together[p].velocity, alone.velocity) << threads << " threads, plant " << p;
    }
  }
}

// Plants with loops, too, whose chains differ in length. Beds share their scratch: what one plant's
// solution left there, beyond the end of a shorter chain of the next one, took part in how far that
// had moved.
TEST(RodSystem, ManyPlantsWithLoopsMoveAsOneAlone) {
  std::vector<RodModel> plants;
  for (int p = 0; p < 90; ++p) {
    Random random(p);
    plants.push_back(random_plant(random, 30 + p % 17, true));
  }
  const auto make = [&](int threads, int only) {
    auto system = std::make_unique<RodSystem>(RodSettings{}, threads);
    for (int p = 0; p < static_cast<int>(plants.size()); ++p)
      if (only < 0 || only == p) system->add_plant(plants[p]);
    return system;
  };
  for (const int threads : {1, 2}) {
    const auto together = make(threads, -1);
    for (int i = 0; i < 6; ++i) together->step(dt, gravity);
    for (const int p : {0, 1, 44, 45, 88, 89}) {
      const auto alone = make(1, p);
      for (int i = 0; i < 6; ++i) alone->step(dt, gravity);
      EXPECT_EQ(together->state(p).position, alone->state(0).position) << p;
      EXPECT_EQ(together->report(p).iterations, alone->report(0).iterations) << p;
      EXPECT_EQ(together->report(p).last_change, alone->report(0).last_change) << p;
    }
  }
}

// After a state is set the step before it is not known: the next step is of first order, as the
// first step of all is.
TEST(RodSystem, AStateThatIsSetStartsAgainAtFirstOrder) {
  RodSettings settings;
  RodSystem system(settings);
  system.add_plant(PeerCantilever::model(10));
  for (int i = 0; i < 50; ++i) system.step(dt, gravity);
  EXPECT_EQ(system.state(0).previous_dt, dt);
  RodState start = system.state(0);
  system.set_state(0, start);
  EXPECT_EQ(system.state(0).previous_dt, 0.0);
  system.step(dt, gravity);

  RodSettings euler;
  euler.integrator = Integrator::backward_euler;
  RodSystem other(euler);
  other.add_plant(PeerCantilever::model(10));
  other.set_state(0, start);
  other.step(dt, gravity);
  for (int e = 0; e < 10; ++e)
    EXPECT_EQ(system.state(0).position[e], other.state(0).position[e]) << e;
}

// Setting the same state twice gives the same bits: the solver keeps nothing of its own.
TEST(RodSystem, NothingIsRememberedOutsideTheState) {
  RodSystem system{RodSettings{}};
  plant_garden(system);
  for (int i = 0; i < 30; ++i) system.step(dt, gravity);
  const RodState saved = system.state(1);
  const auto rerun = [&] {
    system.set_state(1, saved);
    for (int i = 0; i < 30; ++i) system.step(dt, gravity);
    return system.state(1).position.back();
  };
  const Vec3 first = rerun();
  EXPECT_EQ(first, rerun());
}

// A change of dt is a restart too: BDF2's coefficients hold for equal steps only.
TEST(RodSystem, AChangeOfTheStepLengthDoesNotKick) {
  Simulation sim(PeerCantilever::model(10), settings_with(Integrator::bdf2));
  settle(sim.model, sim.state, gravity);
  const Vec3 tip = sim.tip();
  for (int i = 0; i < 60; ++i) sim.step(i % 7 == 0 ? dt / 3 : dt, gravity);
  EXPECT_LT((sim.tip() - tip).norm(), 1e-7);
}

TEST(RodSystem, TimeGoesOn) {
  for (const SolverKind kind : {SolverKind::direct, SolverKind::position_based}) {
    RodSettings settings;
    settings.solver = kind;
    RodSystem system(settings);
    system.add_plant(PeerCantilever::model(3));
    for (int i = 0; i < 24; ++i) system.step(0.125, gravity);
    EXPECT_EQ(system.state(0).time, 3.0);
  }
}

TEST(RodSystem, ADirectStepThatIsNotFinitePutsTheStateBackAndSaysSo) {
  RodSystem system{RodSettings{}};
  system.add_plant(PeerCantilever::model(5));
  system.step(dt, gravity);
  const RodState before = system.state(0);
  system.loads(0).push_back(
      {4, 0.0, Vec3(std::numeric_limits<double>::infinity(), 0, 0), Vec3::Zero()});
  system.step(dt, gravity);
  EXPECT_TRUE(system.report(0).errors & not_finite);
  EXPECT_EQ(system.state(0).position.back(), before.position.back());
  system.loads(0).clear();
  system.step(dt, gravity);
  EXPECT_EQ(system.report(0).errors, 0u);
}

// The first guess continues the acceleration too, so that a smooth swing takes little more than one
// iteration a step: 1.3; with the velocity alone 2.1.
TEST(RodSystem, ASmoothSwingTakesLittleMoreThanOneIterationAStep) {
  RodSystem system{RodSettings{}};
  system.add_plant(PeerCantilever::model(20));
  int iterations = 0;
  for (int i = 0; i < 240; ++i) {
    system.step(dt, gravity);
    iterations += system.report(0).iterations;
    EXPECT_EQ(system.report(0).errors, 0u);
  }
  EXPECT_LT(iterations / 240.0, 1.6);
}

// Absurd stiffness, steps and speeds: the direct solver stays finite too.
TEST(RodSystem, DirectSolverNeverOverflows) {
  for (int run = 0; run < 20; ++run) {
    Random random(run);
    RodModel model = random_plant(random, 15, run % 2 == 1);
    const double scale = std::pow(10.0, random.uniform(-4.0, 4.0));
    for (Element& element : model.elements) {
      element.bend_stiffness *= scale;
      element.stretch_stiffness *= scale;
    }
    Simulation sim(model);
    for (Vec3& v : sim.state.velocity) v = random_vector(random, 30.0);
    for (Vec3& omega : sim.state.angular_velocity) omega = random_vector(random, 300.0);
    for (int i = 0; i < 100; ++i) sim.step(run % 3 == 0 ? 0.1 : 0.01, gravity);
    for (const Vec3& p : sim.state.position) EXPECT_TRUE(p.allFinite()) << run;
  }
}

// A fruit that comes off in a step is reported by that step, and the plant goes on without it.
TEST(RodSystem, ReportsFruitsThatCameOff) {
  RodModel model = PeerCantilever::model(10);
  model.fruits.push_back({"fruit", 9, 0.0, 0.01, 900.0, {}});
  model.fruits[0].thresholds.force = 0.02;  // N; it weighs 0.037 N
  finish(model);
  RodSystem system{RodSettings{}};
  system.add_plant(model);
  int events = 0;
  for (int i = 0; i < 240; ++i) {
    system.step(dt, gravity);
    for (const DetachEvent& event : system.detached(0)) {
      ++events;
      EXPECT_EQ(event.cause, "force");
      EXPECT_GE(event.force, 0.02);
      EXPECT_EQ(event.time, system.state(0).time);
    }
  }
  EXPECT_EQ(events, 1);
  EXPECT_EQ(system.report(0).errors, 0u);
}

TEST(RodSettings, EveryParameterHasAKnownUnitAndADefaultInRange) {
  RodSettings settings;
  const std::vector<Parameter> parameters = parameters_of(settings);
  ASSERT_NE(find_parameter(parameters, "iterations"), nullptr);
  for (const Parameter& parameter : parameters) {
    const auto units = known_units();
    EXPECT_NE(std::find(units.begin(), units.end(), parameter.unit), units.end()) << parameter.name;
    EXPECT_FALSE(parameter.sentence.empty()) << parameter.name;
  }
  EXPECT_FALSE(check_parameters(parameters).has_value());
  settings.substeps = 0;
  EXPECT_TRUE(check_parameters(parameters).has_value());
}

TEST(RodSettings, EveryErrorHasARemedy) {
  for (const StepError error : {not_converged, not_finite, line_search_failed})
    EXPECT_FALSE(remedy(error).empty());
}

// Both systems step, of one of which each state is said to be edited each time.
void compare_what_is_left_alone(const std::vector<RodModel>& plants, int threads) {
  RodSystem left_alone(RodSettings{}, threads), edited(RodSettings{}, threads);
  for (RodSystem* const system : {&left_alone, &edited})
    for (const RodModel& plant : plants) system->add_plant(plant);
  const auto both = [&](const auto& task) {
    for (RodSystem* const system : {&left_alone, &edited}) task(*system);
  };
  const auto hash_of = [](const RodSystem& system) {
    StateHash hash;
    system.add_to(hash);
    return hash.value();
  };
  for (int i = 0; i < 40; ++i) {
    for (int p = 0; p < edited.size(); ++p) edited.edit_state(p);
    const std::vector<Vec3> before = left_alone.state(0).velocity;
    if (i == 10) both([](RodSystem& system) { system.edit_state(0).root.position.x() += 1e-3; });
    if (i == 20)
      both([](RodSystem& system) {
        RodState& state = system.edit_state(0);
        for (Vec3& velocity : state.velocity) velocity *= -1.0;
        for (Vec3& omega : state.angular_velocity) omega *= -1.0;
        state.previous_dt = 0.0;
      });
    if (i == 30) both([](RodSystem& system) { system.edit_state(0).alive.back() = 0; });
    both([](RodSystem& system) { system.step(dt, gravity); });
    ASSERT_EQ(hash_of(left_alone), hash_of(edited)) << i;
    double along = 0.0;
    for (std::size_t e = 0; e < before.size(); ++e)
      along += before[e].dot(left_alone.state(0).velocity[e]);
    EXPECT_EQ(along < 0.0, i == 20) << i;
  }
}

// A state that nobody edits is not read again: to the same bits as one that is, before and after
// the clamp moves, velocities are turned round and elements come off; plants alone, with loops and
// beside one whose joints remember more.
TEST(RodSystem, WhatIsNotEditedNeedNotBeRead) {
  Random random(4);
  const std::vector<RodModel> plants = {random_plant(random, 60, false),
                                        random_plant(random, 900, true)};
  RodModel remembers = plants.front();
  extend(remembers, random);
  for (const int threads : {1, 2}) {
    compare_what_is_left_alone({plants[0]}, threads);
    compare_what_is_left_alone(plants, threads);
    compare_what_is_left_alone({plants[0], plants[1], remembers}, threads);
  }
}

}  // namespace
}  // namespace pedicel::cosserat::cases
