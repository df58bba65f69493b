// Leaf blades against other plants: where a triangle and an axis are nearest, that both sides feel
// one force at one place, and that nothing goes through.
#include "plugins/cosserat/contact/blade_contact.h"

#include <gtest/gtest.h>

#include <limits>

#include "plugins/cosserat/solver/rod_system.h"
#include "tests/analytic/rod_cases.h"
#include "tests/unit/cosserat/random_plants.h"

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
    const NearestToTriangle found = nearest_to_triangle({start, along}, corners);
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
  const NearestToTriangle flat = nearest_to_triangle({{0.5, 1, 0.2}, {1, 0, 0}}, corners);
  EXPECT_NEAR(flat.along, 0.5, 1e-9);
  EXPECT_NEAR(3.0 * flat.shares[1], 1.0, 1e-9);
  const NearestToTriangle point = nearest_to_triangle({{0.5, 0.25, 1}, Vec3::Zero()}, corners);
  EXPECT_NEAR(3.0 * point.shares[1], 0.5, 1e-3);
  EXPECT_NEAR(3.0 * point.shares[2], 0.25, 1e-3);
}

// A triangle in the plane z = 0, whose normal is Z.
const Corners level_corners = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};

TEST(PartOver, IsWhereTheFootLiesInTheTriangle) {
  const Vec3 normal = normal_of(level_corners).value();
  EXPECT_NEAR((normal - Vec3::UnitZ()).norm(), 0.0, 1e-15);
  // From outside to outside, rising from -1 to 3.
  const auto across = part_over({{-1, 0.25, -1}, {4, 0, 4}}, level_corners, normal);
  ASSERT_TRUE(across);
  EXPECT_NEAR(across->at[0], 0.25, 1e-15);
  EXPECT_NEAR(across->at[1], 0.4375, 1e-15);
  EXPECT_NEAR(across->height[0], 0.0, 1e-15);
  EXPECT_NEAR(across->height[1], 0.75, 1e-15);
  EXPECT_FALSE(part_over({{-1, -0.1, 0}, {4, 0, 0}}, level_corners, normal)) << "beside";
  EXPECT_TRUE(part_over({{0.2, 0.2, 9}, Vec3::Zero()}, level_corners, normal)) << "a point";
  EXPECT_FALSE(part_over({{0.6, 0.6, 9}, Vec3::Zero()}, level_corners, normal));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(part_over({{nan, 0.2, 0.1}, {0, 0, 1}}, level_corners, normal));
  EXPECT_FALSE(normal_of({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.5, 0.01, 0)})) << "a sliver";
}

TEST(PartOver, IsWiderBelowAnEdgeThatIsShared) {
  const Vec3 normal = Vec3::UnitZ(), at_first(0.5, 0, 0);
  const Axis below{{0.5, -0.1, -0.3}, Vec3::Zero()}, above{{0.5, -0.1, 0.3}, Vec3::Zero()};
  EXPECT_TRUE(part_over(below, level_corners, normal, at_first, 1));
  EXPECT_FALSE(part_over(above, level_corners, normal, at_first, 1));
  EXPECT_TRUE(part_over(above, level_corners, normal, at_first, -1));
  EXPECT_FALSE(part_over(below, level_corners, normal, Vec3(0, 0.5, 0.5), 1)) << "other edges";
}

TEST(SideAfter, SaysWhereItCameFromOnlyIfItWentThrough) {
  const auto side = [](const Vec3& from, const Vec3& to, const Vec3& along = Vec3::Zero()) {
    const Axis was{from, along}, now{to, along};
    const auto part = part_over(now, level_corners, Vec3::UnitZ());
    return part ? side_after(was, level_corners, now, level_corners, *part) : 9;
  };
  EXPECT_EQ(side({0.2, 0.2, 0.5}, {0.2, 0.2, -0.5}), 1) << "straight through";
  EXPECT_EQ(side({0.2, 0.2, -0.5}, {0.2, 0.2, 0.5}), -1);
  EXPECT_EQ(side({0.2, 0.2, 0.5}, {0.2, 0.2, 0.1}), 1) << "not yet";
  EXPECT_EQ(side({-1.0, 0.2, 0.5}, {0.2, 0.2, -0.1}), 1) << "aslant, through it";
  EXPECT_EQ(side({-1.0, 0.2, 0.1}, {0.2, 0.2, -0.5}), -1) << "aslant, past its edge";
  EXPECT_EQ(side({0.2, 0.2, 0.5}, {0.2, 0.2, -0.5}, {0, 0, 0.3}), 1) << "an upright axis";
  EXPECT_EQ(side({0.2, 0.2, 0.5}, {0.2, 0.2, -0.1}, {0, 0, 0.3}), 1) << "it sticks in it";
  EXPECT_EQ(side({-1.0, 0.2, -0.1}, {0.2, 0.2, -0.1}, {0, 0, 0.3}), 0) << "pushed in from the rim";
}

Section stiff_section(double radius = 0.002) {
  return circle_section(radius, {2.0e9, 0.3, 1000.0, 0.0});
}

void finish_with(RodModel& model, const std::string& name, double radius = 0.002) {
  for (Element& element : model.elements) {
    element.radius_near = element.radius_far = radius;
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
  struct Set {
    bool with_blade = true, two_triangles = false, stem_first = false;
    int threads = 1;
    double stem_radius = 0.002, aside = 0.01;  // m
    Set with_radius(double radius) const {
      Set set = *this;
      set.stem_radius = radius;
      return set;
    }
  };
  explicit LeafUnderATip(const Set& set)
      : RodSystem(RodSettings{}, set.threads), leaf(set.stem_first), stem(!set.stem_first) {
    for (const bool is_stem : {set.stem_first, !set.stem_first})
      add_plant(is_stem ? stem_of(set) : leaf_model());
    if (set.with_blade) add_contact_source(leaf, blades_of(set));
    let_plants_touch({1.0e5, 1.0e4, 0.5, 2.0e-4});
    loads(stem).push_back({7, 0.0, Vec3(0, 0, -0.4), Vec3::Zero()});
  }
  explicit LeafUnderATip(bool with_blade) : LeafUnderATip(Set{.with_blade = with_blade}) {}
  const int leaf, stem;

  void run(int steps) {
    for (int i = 0; i < steps; ++i) step(blade_dt, no_gravity);
  }
  /// m, of the tip above the blade's middle plane at its place.
  double tip_above() const {
    return blade_normal().dot(state(stem).position[7] - state(leaf).position[0]);
  }
  /// m, of the stem's axis above the blade, where it is lowest; 1 where none of it is over it.
  double stem_above() const {
    const auto& nodes = state(stem).position;
    double lowest = 1.0;
    for (std::size_t e = 1; e < nodes.size(); ++e)
      if (const auto part =
              part_over({nodes[e - 1], nodes[e] - nodes[e - 1]}, blade(), blade_normal()))
        lowest = std::min({lowest, part->height[0], part->height[1]});
    return lowest;
  }

 private:
  Corners blade() const {
    const auto& nodes = state(leaf).position;
    return {nodes[0], nodes[2], nodes[1]};
  }
  Vec3 blade_normal() const { return normal_of(blade()).value(); }
  static RodModel leaf_model() {
    RodModel leaf;
    leaf.root.position = Vec3(-0.05, 0, 0);
    leaf.root.rotation = Quat::FromTwoVectors(Vec3::UnitZ(), Vec3::UnitX());
    add_element(leaf, -1, Vec3::Zero(), stiff_section());
    add_element(leaf, 0, Vec3(0.1, 0.06, 0), stiff_section());
    add_element(leaf, 0, Vec3(0.1, -0.06, 0), stiff_section());
    finish_with(leaf, "leaf");
    return leaf;
  }
  static RodModel stem_of(const Set& set) {
    RodModel stem;
    stem.root.position = Vec3(0.3, set.aside, 0.012);
    stem.root.rotation = Quat::FromTwoVectors(Vec3::UnitZ(), -Vec3::UnitX());
    for (int e = 0; e < 8; ++e)
      add_element(stem, e - 1, Vec3(0.3 - 0.03 * (e + 1), set.aside, 0.012),
                  stiff_section(set.stem_radius));
    finish_with(stem, "stem", set.stem_radius);
    return stem;
  }
  static std::unique_ptr<PlantBlades> blades_of(const Set& set) {
    std::vector<BladeTriangle> triangles{level_triangle};
    if (set.two_triangles) {  // parted from the middle of a vein to the end of the other
      const BladePlace middle{1, 0.05};
      triangles = {{BladePlace{0, 0.0}, middle, BladePlace{2, 0.0}},
                   {BladePlace{1, 0.0}, middle, BladePlace{2, 0.0}}};
    }
    return std::make_unique<PlantBlades>(triangles, half_blade);
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

/// The stem's clamp moves down at a speed (m/s), past the leaf's level, so that its tip strikes the
/// blade, and then stays there, where the stem lies on the leaf.
struct StruckLeaf : LeafUnderATip {
  explicit StruckLeaf(double speed, double radius = 0.001, const LeafUnderATip::Set& set = {})
      : LeafUnderATip(set.with_radius(radius)), step_down_(speed * blade_dt) {
    loads(stem).clear();
    lift(height_ - 0.012);
  }
  /// Puts the stem higher by so much.
  void lift(double by) {
    RodState up = state(stem);
    for (Vec3& position : up.position) position.z() += by;
    up.root.position.z() += by;
    set_state(stem, up);
  }
  void go(int steps) {
    lowest = 1.0;
    for (int i = 0; i < steps; ++i) {
      const double down = std::clamp(height_ - until, 0.0, step_down_);
      edit_state(stem).root.position.z() -= down;
      height_ -= down;
      step(blade_dt, no_gravity);
      lowest = std::min(lowest, stem_above());
    }
  }
  double lowest = 1.0;  // m, of the steps of the last go()

 private:
  static constexpr double until = -0.01;
  double height_ = 0.06, step_down_;
};

// A light tip's axis is beyond the blade for several steps: its spring is limited by what its
// inertia can follow. What was on the other side goes back there.
TEST(BladeContact, PushesBackWhatWentThrough) {
  for (const double radius : {0.001, 0.0005})
    for (const double speed : {1.0, 3.0, 5.0}) {
      StruckLeaf system(speed, radius);
      system.go(120);
      EXPECT_LT(system.lowest, -3.0e-4) << speed << " m/s, " << radius << " m";
      EXPECT_GT(system.lowest, -2.0e-3) << speed << " m/s, " << radius << " m";
      system.go(240);
      EXPECT_GT(system.lowest, 0.5 * radius) << speed << " m/s, " << radius << " m";
      EXPECT_LT(system.lowest, 0.1) << "it lies on the blade";
    }
}

// Where the tip meets the blade on, beside and between two triangles, whose corners go round in
// opposite senses.
TEST(BladeContact, PushesBackWhereTwoTrianglesMeet) {
  for (int i = 0; i <= 10; ++i) {
    LeafUnderATip::Set set;
    set.two_triangles = true;
    set.aside = -0.015 + 0.003 * i;
    StruckLeaf system(3.0, 0.0005, set);
    system.go(120);
    EXPECT_LT(system.lowest, -3.0e-4) << set.aside;
    system.go(240);
    EXPECT_GT(system.lowest, 2.0e-4) << set.aside;
    EXPECT_LT(system.lowest, 0.1) << set.aside;
  }
}

// Of a state that is set the sides are those where things are: what is put under the leaf stays
// there, and what was set twice goes on to the same bits.
TEST(BladeContact, OfASetStateTheSidesAreNew) {
  StruckLeaf system(3.0);
  system.go(60);
  ASSERT_LT(system.stem_above(), 0.1);
  const RodState leaf = system.state(0), stem = system.state(1);
  system.lift(-0.05);
  system.go(120);
  EXPECT_LT(system.lowest, -0.02);
  StateHash hashes[2];
  for (StateHash& hash : hashes) {
    system.set_state(0, leaf);
    system.set_state(1, stem);
    system.go(120);
    system.add_to(hash);
  }
  EXPECT_EQ(hashes[0].value(), hashes[1].value());
}

TEST(BladeContact, BitsDoNotDependOnThreads) {
  StateHash hashes[2];
  for (int threads = 1; threads <= 2; ++threads) {
    LeafUnderATip::Set set;
    set.threads = threads;
    StruckLeaf system(5.0, 0.0005, set);
    system.go(120);
    EXPECT_LT(system.lowest, 0.0);
    system.add_to(hashes[threads - 1]);
  }
  EXPECT_EQ(hashes[0].value(), hashes[1].value());
}

TEST(BladeContact, TheOrderOfPlantsDoesNotMatter) {
  std::vector<Vec3> tips;
  for (const bool stem_first : {false, true}) {
    LeafUnderATip::Set set;
    set.stem_first = stem_first;
    StruckLeaf system(3.0, 0.0005, set);
    system.go(240);
    tips.push_back(system.state(system.stem).position.back());
  }
  EXPECT_LT((tips[0] - tips[1]).norm(), 1e-7);
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
