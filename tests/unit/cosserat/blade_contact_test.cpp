// Leaf blades against other plants: where a triangle and an axis are nearest, that both sides feel
// one force at one place, and that nothing goes through.
#include "pedicel/cosserat/contact/blade_contact.h"

#include <gtest/gtest.h>

#include "analytic/rod_cases.h"
#include "pedicel/cosserat/solver/rod_system.h"
#include "unit/cosserat/random_plants.h"

namespace pedicel::cosserat::cases {
namespace {

constexpr double blade_dt = 1.0 / 240.0, half_blade = 1.5e-4;

double apart(const Vec3& start, const Vec3& along, const std::array<Vec3, 3>& corners, double s,
             const Vec3& w) {
  return (start + s * along - w[0] * corners[0] - w[1] * corners[1] - w[2] * corners[2]).norm();
}

TEST(NearestToTriangle, IsAsNearAsADenseSearch) {
  Random random(44);
  int crossed = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec3 start = random_vector(random), along = random_vector(random, i % 7 ? 1.0 : 0.0);
    const std::array<Vec3, 3> corners = {random_vector(random), random_vector(random),
                                         random_vector(random)};
    const NearestToTriangle found = nearest_to_triangle(start, along, corners);
    EXPECT_GE(found.along, 0.0);
    EXPECT_LE(found.along, 1.0);
    EXPECT_GE(found.shares.minCoeff(), 0.0);
    EXPECT_NEAR(found.shares.sum(), 1.0, 1e-12);
    double least = 1e9;
    constexpr int n = 40;
    for (int a = 0; a <= n; ++a)
      for (int u = 0; u <= n; ++u)
        for (int v = 0; u + v <= n; ++v)
          least = std::min(least, apart(start, along, corners, a / double(n),
                                        Vec3(u, v, n - u - v) / double(n)));
    const double distance = apart(start, along, corners, found.along, found.shares);
    // e / 2 of the terms that make the place unique, of sizes up to 2 sqrt(3).
    EXPECT_LT(distance * distance, least * least + 1.0e-4 * 12.0) << "case " << i;
    crossed += least < 0.05;
  }
  EXPECT_GT(crossed, 10);
}

TEST(NearestToTriangle, OfAnAxisThatLiesFlatIsInTheMiddle) {
  const std::array<Vec3, 3> corners = {Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(0, 3, 0)};
  const NearestToTriangle flat = nearest_to_triangle({0.5, 1, 0.2}, {1, 0, 0}, corners);
  EXPECT_NEAR(flat.along, 0.5, 1e-9);
  EXPECT_NEAR(3.0 * flat.shares[1], 1.0, 1e-9);
  const NearestToTriangle point = nearest_to_triangle({0.5, 0.25, 1}, Vec3::Zero(), corners);
  EXPECT_NEAR(3.0 * point.shares[1], 0.5, 1e-3);
  EXPECT_NEAR(3.0 * point.shares[2], 0.25, 1e-3);
}

Section stiff_section() {
  return circle_section(0.002, {2.0e9, 0.3, 1000.0, 0.0});
}

void finish_with(RodModel& model, const std::string& name) {
  for (Element& element : model.elements) {
    element.radius_near = element.radius_far = 0.002;
    element.mass_damping = 10.0;
    element.damping_time = 2.0e-3;
  }
  model.name = name;
  model.organs = {name + "/stem"};
  finish(model);
}

// Between the ends of a leaf's stalk and of its two veins.
const BladeTriangle level_triangle = {BladePlace{0, 0.0}, BladePlace{1, 0.0}, BladePlace{2, 0.0}};

/// A level leaf whose two veins part, and a stem of another plant that ends above the middle of its
/// blade, where no vein is.
struct LeafUnderATip : RodSystem {
  explicit LeafUnderATip(bool with_blade, int threads = 1) : RodSystem(RodSettings{}, threads) {
    RodModel leaf;
    leaf.root.position = Vec3(-0.05, 0, 0);
    leaf.root.rotation = Quat::FromTwoVectors(Vec3::UnitZ(), Vec3::UnitX());
    add_element(leaf, -1, Vec3::Zero(), stiff_section());
    add_element(leaf, 0, Vec3(0.1, 0.06, 0), stiff_section());
    add_element(leaf, 0, Vec3(0.1, -0.06, 0), stiff_section());
    finish_with(leaf, "leaf");
    add_plant(std::move(leaf));
    RodModel stem;
    stem.root.position = Vec3(0.3, 0.01, 0.012);
    stem.root.rotation = Quat::FromTwoVectors(Vec3::UnitZ(), -Vec3::UnitX());
    for (int e = 0; e < 8; ++e)
      add_element(stem, e - 1, Vec3(0.3 - 0.03 * (e + 1), 0.01, 0.012), stiff_section());
    finish_with(stem, "stem");
    add_plant(std::move(stem));
    if (with_blade)
      add_contact_source(
          0, std::make_unique<PlantBlades>(std::vector<BladeTriangle>{level_triangle}, half_blade));
    let_plants_touch({1.0e5, 1.0e4, 0.5, 2.0e-4});
    loads(1).push_back({7, 0.0, Vec3(0, 0, -0.4), Vec3::Zero()});
  }
  void run(int steps) {
    for (int i = 0; i < steps; ++i) step(blade_dt, no_gravity);
  }
  /// m, of the tip above the blade's middle plane at its place.
  double tip_above() const {
    const auto corner = [&](int e) { return state(0).position[e]; };
    const Vec3 across = (corner(1) - corner(0)).cross(corner(2) - corner(0));
    return -across.normalized().dot(state(1).position[7] - corner(0));
  }
};

TEST(BladeContact, HoldsATipThatVeinsLetThrough) {
  LeafUnderATip through(false), held(true);
  through.run(480);
  held.run(480);
  EXPECT_LT(through.tip_above(), -0.02);
  // Less than its radius and half of a blade by what the springs give, whose stiffness a light
  // element's inertia limits: but its axis stays above.
  EXPECT_LT(held.tip_above(), 0.002 + half_blade + 2.0e-4);
  EXPECT_GT(held.tip_above(), 5.0e-4);
  EXPECT_LT(held.state(0).position[1].z(), -1.0e-4) << "the leaf bends under it";
}

TEST(BladeContact, BothSidesFeelOneForceAtOnePlace) {
  LeafUnderATip system(true);
  system.run(60);
  double largest = 0.0;
  for (int i = 0; i < 120; ++i) {
    system.step(blade_dt, no_gravity);
    Vec3 sum = Vec3::Zero(), moment = Vec3::Zero(), on_stem = Vec3::Zero();
    double margin = 0.0;
    for (int p = 0; p < 2; ++p)
      for (const ContactForce& one : system.contact_forces(p)) {
        ASSERT_TRUE(is_other_plant(one.point.collider));
        const Vec3 force = one.normal * one.point.normal_W + one.tangential_W;
        sum += force;
        moment += one.place_W.cross(force);
        if (p == 1) on_stem += force;
        margin = std::max(margin, std::abs(one.point.gap) + 2.0e-4);
      }
    EXPECT_LT(sum.norm(), 1e-12 * (1.0 + on_stem.norm()));
    // Between the two surfaces there is the gap, across which the force leads.
    EXPECT_LT(moment.norm(), (2.0 * margin + 1e-5) * on_stem.norm());
    largest = std::max(largest, on_stem.z());
  }
  EXPECT_GT(largest, 0.2);
  EXPECT_EQ(system.touched(system.contact_forces(1).front().point.collider).plant, 0);
}

// At 0.5 m/s the tip's axis is beyond the blade within a step. From 1 m/s on a light tip may stay
// there: its spring is limited by what its inertia can follow.
TEST(BladeContact, PushesBackWhatWentThroughInOneStep) {
  LeafUnderATip system(true);
  for (int e = 4; e < 8; ++e) system.edit_state(1).velocity[e] = Vec3(0, 0, -0.5 * (e - 3) / 4.0);
  system.edit_state(1).previous_dt = 0.0;
  double lowest_at_first = 1.0, lowest = 1.0;
  for (int i = 0; i < 240; ++i) {
    system.step(blade_dt, no_gravity);
    double& of = i < 24 ? lowest_at_first : lowest;
    of = std::min(of, system.tip_above());
  }
  EXPECT_LT(lowest_at_first, 0.0);
  EXPECT_GT(lowest, 0.0);
}

TEST(BladeContact, BitsDoNotDependOnThreads) {
  StateHash hashes[2];
  for (int threads = 1; threads <= 2; ++threads) {
    LeafUnderATip system(true, threads);
    system.run(120);
    system.add_to(hashes[threads - 1]);
  }
  EXPECT_EQ(hashes[0].value(), hashes[1].value());
}

// What stands in a blade as drawn stays there.
TEST(BladeContact, LeavesOutWhatOverlapsAsDrawn) {
  RodSystem system{RodSettings{}};
  RodModel leaf;
  leaf.root.rotation = Quat::FromTwoVectors(Vec3::UnitZ(), Vec3::UnitX());
  add_element(leaf, -1, Vec3(0.05, 0, 0), stiff_section());
  add_element(leaf, 0, Vec3(0.15, 0.06, 0), stiff_section());
  add_element(leaf, 0, Vec3(0.15, -0.06, 0), stiff_section());
  finish_with(leaf, "leaf");
  system.add_plant(std::move(leaf));
  RodModel stem;
  stem.root.position = Vec3(0.12, 0, -0.1);
  for (int e = 0; e < 5; ++e)
    add_element(stem, e - 1, Vec3(0.12, 0, -0.1 + 0.045 * (e + 1)), stiff_section());
  finish_with(stem, "stem");
  system.add_plant(std::move(stem));
  system.add_contact_source(
      0, std::make_unique<PlantBlades>(std::vector<BladeTriangle>{level_triangle}, half_blade));
  system.let_plants_touch({1.0e5, 1.0e4, 0.5, 2.0e-4});
  for (int i = 0; i < 60; ++i) {
    system.step(blade_dt, no_gravity);
    ASSERT_TRUE(system.contact_forces(0).empty());
  }
  EXPECT_LT((system.state(1).position[4] - system.model(1).elements[4].drawn_position).norm(),
            1e-9);
}

}  // namespace
}  // namespace pedicel::cosserat::cases
