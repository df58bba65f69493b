#include "plugins/coupling/collider_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/core/check.h"
#include "engine/core/random.h"
#include "engine/geometry/shapes.h"
#include "plugins/cosserat/model/rod_state.h"
#include "tests/support/allocation_counter.h"
#include "tests/unit/coupling/plants.h"

namespace pedicel::coupling {
namespace {

using cosserat::ContactPoint;
using cosserat::RodModel;
using cosserat::RodState;

constexpr double dt = 0.01, radius = 0.002;

Collider box(const Vec3& size, const char* name = "box") {
  Collider collider;
  collider.name = name;
  collider.shape = std::make_shared<geometry::BoxDistance>(size);
  return collider;
}

Pose at(double x, double y, double z) {
  return {{x, y, z}, Quat::Identity()};
}

Pose turned(const Vec3& axis, double angle, const Vec3& position) {
  return {position, Quat(Eigen::AngleAxisd(angle, axis))};
}

// A level rod along x at z = 0 from x = 0 to 0.1 with a fruit at its tip.
RodModel level_rod() {
  RodModel model = straight_rod({0, 0, 0}, {0.1, 0, 0}, 5, radius);
  model.fruits.push_back({"fruit", 4, 0.0, 0.012, 950, {}});
  finish(model);
  return model;
}

std::vector<ContactPoint> contacts(ColliderSource& source, const RodModel& model,
                                   const RodState& state) {
  std::vector<ContactPoint> found;
  source.begin_step(model, state, dt);
  source.find(model, state, dt, found);
  return found;
}

TEST(ColliderSource, FindsWhereARodLiesOnABox) {
  const RodModel model = level_rod();
  ColliderSet colliders;
  CouplingSettings settings;
  // Under element 1, which reaches from x = 0.02 to 0.04; 0.1 mm overlap.
  colliders.add(box({0.004, 0.02, 0.01}), at(0.033, 0, -0.005 - radius + 1e-4));
  ColliderSource source(colliders, settings);
  const auto found = contacts(source, model, drawn_state(model));
  ASSERT_EQ(found.size(), 1u);
  const ContactPoint& point = found[0];
  EXPECT_EQ(point.shape, 1);
  EXPECT_EQ(point.collider, 0);
  EXPECT_NEAR(point.back, 0.04 - 0.033, 0.002 + 1e-6);  // anywhere on the box's top
  EXPECT_NEAR(point.gap, -1e-4, 1e-9);
  EXPECT_NEAR(point.normal_W.z(), 1, 1e-9);
  EXPECT_EQ(point.radius, radius);
  EXPECT_EQ(point.surface_motion_W, Vec3(Vec3::Zero()));
  EXPECT_EQ(point.friction, settings.friction);
  EXPECT_EQ(point.stiffness, settings.contact_stiffness);
  EXPECT_EQ(point.margin, settings.margin);
}

TEST(ColliderSource, SkipsWhatIsFartherThanTheMargin) {
  const RodModel model = level_rod();
  for (const double gap : {0.9e-4, 1.1e-4}) {
    ColliderSet colliders;
    CouplingSettings settings;
    settings.margin = 1.0e-4;
    colliders.add(box({0.004, 0.02, 0.01}), at(0.03, 0, -0.005 - radius - gap));
    ColliderSource source(colliders, settings);
    EXPECT_EQ(contacts(source, model, drawn_state(model)).size(), gap < 1e-4 ? 1u : 0u);
  }
}

TEST(ColliderSource, TakesTheCollidersFrictionAndTheFruitsStiffness) {
  const RodModel model = level_rod();
  ColliderSet colliders;
  CouplingSettings settings;
  Collider pad = box({0.01, 0.01, 0.01});
  pad.friction = 0.8;
  colliders.add(pad, at(0.1, 0, -0.0165));
  ColliderSource source(colliders, settings);
  const auto found = contacts(source, model, drawn_state(model));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(model.shapes[found[0].shape].fruit, 0);
  EXPECT_EQ(found[0].friction, 0.8);
  EXPECT_EQ(found[0].stiffness, settings.fruit_stiffness);
}

TEST(ColliderSource, SkipsDeadElementsGoneFruitsAndInactiveColliders) {
  const RodModel model = level_rod();
  ColliderSet colliders;
  colliders.add(box({0.3, 0.02, 0.01}), at(0, 0, -0.006));
  ColliderSource source(colliders, {});
  RodState state = drawn_state(model);
  EXPECT_EQ(contacts(source, model, state).size(), 6u);
  state.fruit_gone[0] = true;
  EXPECT_EQ(contacts(source, model, state).size(), 5u);
  state.alive[4] = state.alive[3] = 0;
  EXPECT_EQ(contacts(source, model, state).size(), 3u);
  colliders.set_active(0, false);
  EXPECT_TRUE(contacts(source, model, state).empty());
}

TEST(ColliderSource, IgnoresWhatItTouchedAtSetUp) {
  const RodModel model = level_rod();
  ColliderSet colliders;
  colliders.add(box({0.05, 0.02, 0.01}), at(0, 0, 0));  // the root stands in it
  ColliderSource source(colliders, {});
  const RodState state = drawn_state(model);
  const auto before = contacts(source, model, state);
  ASSERT_FALSE(before.empty());
  source.ignore_touching(model, state);
  EXPECT_TRUE(contacts(source, model, state).empty());
  const Pose moved = at(0.06, 0, -0.006);  // now under the segments that were free
  colliders.update({&moved, 1});
  for (const ContactPoint& point : contacts(source, model, state)) EXPECT_GE(point.shape, 2);
  EXPECT_FALSE(contacts(source, model, state).empty());
}

// The motion over the step of the collider's material point under the contact, for any two poses.
TEST(ColliderSource, GivesTheRigidMotionOfTheTouchedSurface) {
  Random random(7);
  const RodModel model = level_rod();
  const RodState state = drawn_state(model);
  for (int trial = 0; trial < 50; ++trial) {
    ColliderSet colliders;
    Collider ball;
    ball.shape = std::make_shared<geometry::SphereDistance>(0.01);
    ball.X_LC = turned(Vec3::UnitY(), random.uniform(-2, 2), {0.01, 0.02, 0.0});
    const Pose last = turned(Vec3::UnitX(), random.uniform(-0.3, 0.3),
                             {random.uniform(0.02, 0.06), random.uniform(-0.025, -0.015), -0.0115});
    const Pose now =
        turned(Vec3(1, 2, 3).normalized(), random.uniform(-0.01, 0.01), Vec3(1e-4, 2e-4, -1e-4)) *
        last;
    colliders.add(ball, last);
    colliders.update({&now, 1});
    ColliderSource source(colliders, {});
    for (const ContactPoint& point : contacts(source, model, state)) {
      const Vec3 axis = point_on(model, state, model.shapes[point.shape].element, point.back);
      const Vec3 surface_W = axis - (point.gap + point.radius) * point.normal_W;
      const Vec3 moved = surface_W - (last * (now.inverse() * surface_W));
      EXPECT_LT((point.surface_motion_W - moved).norm(), 1e-12);
      EXPECT_NEAR((surface_W - now * ball.X_LC.position).norm(), 0.01, 1e-9);
    }
  }
}

// A plate swept through the rod within one step: the rod is pushed ahead of it.
TEST(ColliderSource, MeetsAColliderThatSweepsThroughInOneStep) {
  const RodModel model = level_rod();
  ColliderSet colliders;
  colliders.add(box({0.02, 0.02, 0.002}), at(0.05, 0, -0.006));
  const Pose now = at(0.05, 0, 0.008);
  colliders.update({&now, 1});
  ColliderSource source(colliders, {});
  const auto found = contacts(source, model, drawn_state(model));
  ASSERT_FALSE(found.empty());
  for (const ContactPoint& point : found) {
    EXPECT_NEAR(point.normal_W.z(), 1, 1e-9);
    EXPECT_NEAR(point.gap, -(0.008 + 0.001 + radius), 1e-8);
    EXPECT_NEAR(point.surface_motion_W.z(), 0.014, 1e-9);
  }
}

// Which collider comes first must not matter.
TEST(ColliderSource, DoesNotDependOnTheOrderOfColliders) {
  Random random(8);
  const RodModel model = level_rod();
  std::vector<Pose> poses;
  for (int i = 0; i < 12; ++i)
    poses.push_back(turned(
        Vec3::UnitX(), random.uniform(-1, 1),
        {random.uniform(0, 0.11), random.uniform(-0.01, 0.01), random.uniform(-0.01, 0.01)}));
  ColliderSet ascending, descending;
  for (int i = 0; i < 12; ++i) {
    ascending.add(box({0.01, 0.02, 0.004}), poses[i]);
    descending.add(box({0.01, 0.02, 0.004}), poses[11 - i]);
  }
  ColliderSource first(ascending, {}), second(descending, {});
  const auto a = contacts(first, model, drawn_state(model));
  auto b = contacts(second, model, drawn_state(model));
  for (ContactPoint& point : b) point.collider = 11 - point.collider;
  std::sort(b.begin(), b.end(), [](const ContactPoint& x, const ContactPoint& y) {
    return std::pair(x.shape, x.collider) < std::pair(y.shape, y.collider);
  });
  ASSERT_EQ(a.size(), b.size());
  ASSERT_GT(a.size(), 5u);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].shape, b[i].shape);
    EXPECT_EQ(a[i].collider, b[i].collider);
    EXPECT_EQ(a[i].gap, b[i].gap);
    EXPECT_EQ(a[i].back, b[i].back);
    EXPECT_EQ(a[i].normal_W, b[i].normal_W);
  }
}

TEST(ColliderSource, DoesNotAllocateOnceWarm) {
  const RodModel model = level_rod();
  ColliderSet colliders;
  colliders.add(box({0.3, 0.02, 0.01}), at(0, 0, -0.006));
  colliders.add(box({0.3, 0.02, 0.01}), at(0, 0, 0.5));
  ColliderSource source(colliders, {});
  const RodState state = drawn_state(model);
  std::vector<ContactPoint> found;
  std::vector<Pose> poses = {at(0.001, 0, -0.006), at(0, 0, 0.5)};
  const auto step = [&] {
    found.clear();
    colliders.update(poses);
    source.begin_step(model, state, dt);
    source.find(model, state, dt, found);
  };
  step();
  const long before = allocations();
  step();
  EXPECT_EQ(allocations(), before);
  EXPECT_EQ(found.size(), 6u);
}

TEST(ColliderSource, IgnoresIteratesThatRanAway) {
  const RodModel model = level_rod();
  ColliderSet colliders;
  colliders.add(box({0.3, 0.02, 0.01}), at(0, 0, -0.006));
  ColliderSource source(colliders, {});
  RodState state = drawn_state(model);
  state.position[2].x() = std::nan("");
  for (const ContactPoint& point : contacts(source, model, state)) EXPECT_NE(point.shape, 2);
}

TEST(ColliderSet, KeepsThePoseOfTheStepBefore) {
  ColliderSet colliders;
  Collider pad = box({0.02, 0.02, 0.02});
  pad.X_LC = at(0.1, 0, 0);
  colliders.add(pad, at(0, 0, 0));
  EXPECT_FALSE(colliders.placement(0).is_moving);
  EXPECT_EQ(colliders.collider(0).feature, 0.02);
  const Pose now = turned(Vec3::UnitZ(), 0.5 * M_PI, {0, 0, 1});
  colliders.update({&now, 1});
  EXPECT_TRUE(colliders.placement(0).is_moving);
  EXPECT_TRUE(colliders.placement(0).X_WC_before.position.isApprox(Vec3(0.1, 0, 0)));
  EXPECT_TRUE(colliders.placement(0).X_WC.position.isApprox(Vec3(0, 0.1, 1)));
  EXPECT_TRUE(colliders.link_pose(0).position.isApprox(Vec3(0, 0, 1)));
  // The box holds the collider on its way, too: at half the turn it is at (0.0707, 0.0707, 0.5).
  EXPECT_TRUE(colliders.placement(0).box_W.contains(Vec3(0.07, 0.07, 0.5)));
  colliders.update({&now, 1});
  EXPECT_FALSE(colliders.placement(0).is_moving);
}

TEST(ColliderSet, RefusesCollidersWithoutShapeOrWithBadFriction) {
  ColliderSet colliders;
  const auto words = [&](Collider collider) -> std::string {
    try {
      colliders.add(std::move(collider), {});
    } catch (const UsageError& error) {
      return error.what();
    }
    return "taken";
  };
  Collider hand;
  hand.name = "hand";
  EXPECT_EQ(words(hand), "collider 'hand': has no shape");
  Collider pad = box({1, 1, 1}, "pad");
  pad.friction = -0.5;
  EXPECT_EQ(words(pad), "collider 'pad': friction = -0.500000: must be between 0 and 10");
  EXPECT_EQ(colliders.size(), 0);
}

TEST(CouplingSettings, AreDescribedAndChecked) {
  CouplingSettings settings;
  EXPECT_EQ(check(settings), "");
  const auto units = known_units();
  for (const Parameter& parameter : parameters_of(settings)) {
    EXPECT_NE(std::find(units.begin(), units.end(), parameter.unit), units.end()) << parameter.name;
    EXPECT_GT(parameter.sentence.size(), 20u) << parameter.name;
  }
  settings.margin = -1;
  EXPECT_EQ(check(settings), "CouplingSettings.margin = -1 m: must be between 1e-07 and 0.01");
  EXPECT_THROW(ColliderSource(ColliderSet{}, settings), UsageError);
  settings = {};
  settings.contact_stiffness = std::nan("");
  EXPECT_THAT(check(settings), testing::HasSubstr("contact_stiffness = nan N/m: must be a finite"));
}

}  // namespace
}  // namespace pedicel::coupling
