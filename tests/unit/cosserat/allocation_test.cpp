// A step does not allocate once warm. This program counts every call of the global operator new;
// it is a program of its own because of that.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "analytic/rod_cases.h"
#include "analytic/sphere_source.h"
#include "cosserat/rod_system.h"
#include "unit/cosserat/random_plants.h"

namespace {
std::atomic<long> allocations{0};

void* counted(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}
}  // namespace

void* operator new(std::size_t size) {
  return counted(size);
}
void* operator new[](std::size_t size) {
  return counted(size);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace pedicel::cosserat::cases {
namespace {

long allocations_of_a_warm_run(const RodSettings& settings, int threads, bool supports) {
  RodSystem system(settings, threads);
  for (int p = 0; p < 3; ++p) {
    Random random(p);
    RodModel model = random_plant(random, 15, supports);
    model.welds.clear();  // plants with welds go through a general sparse factorisation
    const Vec3 middle = 0.5 * (model.drawn_start(0) + model.elements[0].drawn_position);
    const Vec3 side = model.elements[0].drawn_rotation * Vec3::UnitX();
    system.add_plant(std::move(model));
    auto spheres = std::make_unique<SphereSource>();  // overlaps the first segment for good
    spheres->spheres.push_back({middle + 0.0225 * side, 0.02, Vec3::Zero()});
    system.add_contact_source(p, std::move(spheres));
    system.loads(p).push_back({0, 0.0, Vec3(0.01, 0, 0), Vec3::Zero()});
  }
  for (int i = 0; i < 100; ++i) system.step(1.0 / 240.0, gravity);
  EXPECT_GT(system.contact_forces(0).size(), 0u);
  const long before = allocations;
  for (int i = 0; i < 100; ++i) system.step(1.0 / 240.0, gravity);
  return allocations - before;
}

TEST(Allocation, TheCounterCounts) {
  const long before = allocations;
  const std::vector<int> something(100);
  EXPECT_EQ(allocations - before, 1);
  EXPECT_EQ(something.size(), 100u);
}

TEST(Allocation, NoneInAWarmStep) {
  for (const SolverKind kind : {SolverKind::direct, SolverKind::position_based}) {
    for (const bool supports : {false, true}) {
      RodSettings settings;
      settings.solver = kind;
      EXPECT_EQ(allocations_of_a_warm_run(settings, 1, supports), 0);
      EXPECT_EQ(allocations_of_a_warm_run(settings, 2, supports), 0);
    }
  }
}

}  // namespace
}  // namespace pedicel::cosserat::cases
