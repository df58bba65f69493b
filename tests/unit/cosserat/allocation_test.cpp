// A step does not allocate once warm, in trees and in plants with loops. This program counts every
// call of the global operator new; it is a program of its own because of that.
#include <gtest/gtest.h>

#include "plugins/cosserat/contact/plant_blades.h"
#include "plugins/cosserat/solver/rod_system.h"
#include "tests/analytic/rod_cases.h"
#include "tests/analytic/sphere_source.h"
#include "tests/support/allocation_counter.h"
#include "tests/unit/cosserat/extension_cases.h"

namespace pedicel::cosserat::cases {
namespace {

// Three plants, each with a load and a sphere that overlaps its first segment for good; the last
// element of each comes off before the counted steps where `breaks`.
long allocations_of_a_warm_run(const RodSettings& settings, int threads, bool loops, bool breaks,
                               bool extended = false) {
  RodSystem system(settings, threads);
  for (int p = 0; p < 3; ++p) {
    Random random(p);
    RodModel model = random_plant(random, 15, loops);
    if (extended) extend(model, random);
    const Vec3 middle = 0.5 * (model.drawn_start(0) + model.elements[0].drawn_position);
    const Vec3 side = model.elements[0].drawn_rotation * Vec3::UnitX();
    system.add_plant(std::move(model));
    auto spheres = std::make_unique<SphereSource>();
    spheres->spheres.push_back({middle + 0.0225 * side, 0.02, Vec3::Zero()});
    system.add_contact_source(p, std::move(spheres));
    system.loads(p).push_back({0, 0.0, Vec3(0.01, 0, 0), Vec3::Zero()});
  }
  for (int i = 0; i < 100; ++i) system.step(1.0 / 240.0, gravity);
  EXPECT_GT(system.contact_forces(0).size(), 0u);
  if (breaks)
    for (int p = 0; p < 3; ++p) system.edit_state(p).alive.back() = 0;
  const long before = allocations();
  for (int i = 0; i < 100; ++i) system.step(1.0 / 240.0, gravity);
  return allocations() - before;
}

TEST(Allocation, TheCounterCounts) {
  struct alignas(64) Wide {
    double values[8];
  };
  const long before = allocations();
  const std::vector<int> something(100);
  const std::vector<Wide> wide(100);
  EXPECT_EQ(allocations() - before, 2);
  EXPECT_EQ(something.size(), wide.size());
}

TEST(Allocation, NoneInAWarmStep) {
  for (const SolverKind kind : {SolverKind::direct, SolverKind::position_based}) {
    for (const bool loops : {false, true}) {
      RodSettings settings;
      settings.solver = kind;
      EXPECT_EQ(allocations_of_a_warm_run(settings, 1, loops, false), 0);
      EXPECT_EQ(allocations_of_a_warm_run(settings, 2, loops, false), 0);
    }
  }
}

TEST(Allocation, NoneWithLawsAndWind) {
  for (const bool loops : {false, true})
    for (const int threads : {1, 2})
      EXPECT_EQ(allocations_of_a_warm_run({}, threads, loops, false, true), 0);
}

// Enough for several beds a thread, whose rows stand on huge pages.
TEST(Allocation, NoneInARowOfManyPlants) {
  for (const int threads : {1, 2}) {
    RodSystem system({}, threads);
    int elements = 0;
    for (int p = 0; p < 140; ++p) {
      Random random(p);
      elements += system.model(system.add_plant(random_plant(random, 60, false))).size();
    }
    ASSERT_GE(elements, 8000);
    for (int i = 0; i < 20; ++i) system.step(1.0 / 240.0, gravity);
    const long before = allocations();
    for (int i = 0; i < 20; ++i) system.step(1.0 / 240.0, gravity);
    EXPECT_EQ(allocations() - before, 0) << threads << " threads";
  }
}

// With loops the element takes its weld with it: the symbolic phase of the factorisation lasts.
TEST(Allocation, NoneWhenAnElementComesOff) {
  for (const bool loops : {false, true})
    for (const bool extended : {false, true})
      EXPECT_EQ(allocations_of_a_warm_run({}, 1, loops, true, extended), 0);
}

// A leaf's blade that another plant's stem lies on.
TEST(Allocation, NoneWhereAStemLiesOnABlade) {
  const Section section = circle_section(0.002, {2.0e9, 0.3, 1000.0, 0.0});
  const auto finished = [](RodModel model) {
    for (Element& element : model.elements) {
      element.radius_near = element.radius_far = 0.002;
      element.mass_damping = 10.0;
    }
    finish(model);
    return model;
  };
  RodModel leaf, stem;
  leaf.root.rotation = Quat::FromTwoVectors(Vec3::UnitZ(), Vec3::UnitX());
  add_element(leaf, -1, Vec3(0.05, 0, 0), section);
  add_element(leaf, 0, Vec3(0.15, 0.06, 0), section);
  add_element(leaf, 0, Vec3(0.15, -0.06, 0), section);
  stem.root.position = Vec3(0.35, 0.01, 0.01);
  stem.root.rotation = Quat::FromTwoVectors(Vec3::UnitZ(), -Vec3::UnitX());
  for (int e = 0; e < 8; ++e)
    add_element(stem, e - 1, Vec3(0.35 - 0.03 * (e + 1), 0.01, 0.01), section);
  RodSystem system{RodSettings{}};
  system.add_plant(finished(std::move(leaf)));
  system.add_plant(finished(std::move(stem)));
  const BladeTriangle triangle = {BladePlace{0, 0.0}, BladePlace{1, 0.0}, BladePlace{2, 0.0}};
  system.add_contact_source(
      0, std::make_unique<PlantBlades>(std::vector<BladeTriangle>{triangle}, 1.5e-4));
  system.let_plants_touch({1.0e5, 1.0e4, 0.5, 2.0e-4});
  system.loads(1).push_back({7, 0.0, Vec3(0, 0, -0.3), Vec3::Zero()});
  for (int i = 0; i < 200; ++i) system.step(1.0 / 240.0, Vec3::Zero());
  EXPECT_FALSE(system.contact_forces(0).empty());
  // It swings on, so that candidates are looked for anew.
  system.loads(1)[0].force_W.z() = -0.1;
  const long before = allocations();
  for (int i = 0; i < 200; ++i) system.step(1.0 / 240.0, Vec3::Zero());
  EXPECT_FALSE(system.contact_forces(0).empty());
  EXPECT_EQ(allocations() - before, 0);
}

}  // namespace
}  // namespace pedicel::cosserat::cases
