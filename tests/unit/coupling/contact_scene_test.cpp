// Contact as a whole: colliders, search and solver together, against statics.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "engine/geometry/shapes.h"
#include "plugins/cosserat/contact/self_contact.h"
#include "plugins/cosserat/solver/rod_system.h"
#include "plugins/coupling/collider_source.h"
#include "plugins/coupling/contact_report.h"
#include "tests/support/allocation_counter.h"
#include "tests/unit/coupling/plants.h"

namespace pedicel::coupling {
namespace {

using cosserat::RodModel;
using cosserat::RodState;

constexpr double time_step = 1.0 / 240.0;
const Vec3 gravity(0, 0, -9.81);

Pose at(const Vec3& position) {
  return {position, Quat::Identity()};
}

Collider box(const Vec3& size, double friction) {
  Collider collider;
  collider.shape = std::make_shared<geometry::BoxDistance>(size);
  collider.friction = friction;
  return collider;
}

std::unique_ptr<cosserat::RodSystem> system_with(const RodModel& model) {
  cosserat::RodSettings settings;
  settings.newton_iterations = 10;
  auto system = std::make_unique<cosserat::RodSystem>(settings);
  system->add_plant(model);
  return system;
}

// A rod that lies free: its first segment is so soft that the clamp carries nothing
// (E A = 1 Pa x 1.3e-5 m2, against a weight of 0.017 N).
RodModel free_rod(double height, double radius) {
  RodModel model =
      straight_rod({0, 0, height}, {0.2, 0, height}, 20, radius, {2.0e7, 0.35, 700, 0.01});
  model.elements[0].section = cosserat::circle_section(radius, {1.0, 0.35, 700, 0});
  finish(model);
  return model;
}

double weight(const RodModel& model) {
  double mass = 0.0;
  for (const cosserat::Element& element : model.elements) mass += element.mass;
  return mass * gravity.norm();
}

// Statics: the normal forces of a rod at rest on the ground add up to its weight.
TEST(ContactScene, ARodOnTheGroundCarriesItsWeight) {
  const double radius = 0.002;
  const RodModel model = free_rod(radius + 0.001, radius);
  ColliderSet colliders;
  Collider ground;
  ground.shape = std::make_shared<geometry::PlaneDistance>();
  colliders.add(ground, {});
  auto system = system_with(model);
  system->add_contact_source(0, std::make_unique<ColliderSource>(colliders, CouplingSettings{}));
  for (int i = 0; i < 480; ++i) system->step(time_step, gravity);

  ContactReport report(colliders);
  report.begin();
  report.add(0, system->model(0), system->contact_forces(0));
  report.end();
  EXPECT_NEAR(report.colliders()[0].normal, weight(model), 0.01 * weight(model));
  EXPECT_NEAR(report.colliders()[0].force_W.z(), -weight(model), 0.01 * weight(model));
  EXPECT_LT(report.colliders()[0].tangential, 0.02 * weight(model));
  EXPECT_LT(system->report(0).deepest, 2.0e-4);
  for (int e = 2; e < 20; ++e) EXPECT_LT(system->state(0).velocity[e].norm(), 1e-4) << e;
}

// Laid across a sphere at its middle, a flexible rod rests there (a rod on a round thing is stable
// while half its thickness is below the radius), and the sphere carries its weight.
TEST(ContactScene, ASphereCarriesTheWeightOfARodAcrossIt) {
  const double radius = 0.002;
  const RodModel model = free_rod(0.0, radius);
  ColliderSet colliders;
  Collider ball;
  ball.shape = std::make_shared<geometry::SphereDistance>(0.05);
  colliders.add(ball, at({0.1, 0, -0.05 - radius}));
  auto system = system_with(model);
  system->add_contact_source(0, std::make_unique<ColliderSource>(colliders, CouplingSettings{}));
  double normal = 0.0;
  for (int i = 0; i < 480; ++i) {
    system->step(time_step, gravity);
    for (const auto& force : system->contact_forces(0))
      if (i >= 240) normal += force.normal / 240.0;
  }
  EXPECT_NEAR(normal, weight(model), 0.01 * weight(model));
  EXPECT_LT(system->report(0).deepest, 2.0e-4);
}

// A fruit hangs on a straight stalk, E A = 2e7 Pa x pi mm2 = 62.8 N over 0.1 m. Two pads squeeze it
// with about 5 N each and go down by 5 mm, which wants 62.8 N x 0.05 = 3.1 N: friction holds
// 2 x mu x 5 N.
struct Grip {
  double fruit_moved = 0.0, pads_moved = 0.0, pull = 0.0, normal = 0.0;
  int contacts = 0;
  bool ever_slipped = false;  // towards the end of the pull
  double deepest = 0.0;
};

Grip pull_down(double friction) {
  const double fruit_radius = 0.012, squeeze = 3.0e-4;
  RodModel model = straight_rod({0, 0, 0.2}, {0, 0, 0.1}, 10, 0.001, {2.0e7, 0.35, 700, 0.01});
  model.fruits.push_back({"fruit", 9, 0.0, fruit_radius, 950, {}});
  finish(model);
  ColliderSet colliders;
  const auto pads = [&](double opening, double lowered) {
    const double y = fruit_radius + 0.005 + opening;
    return std::vector<Pose>{at({0, y, 0.1 - lowered}), at({0, -y, 0.1 - lowered})};
  };
  for (const Pose& pose : pads(0.002, 0.0)) colliders.add(box({0.03, 0.01, 0.03}, friction), pose);
  auto system = system_with(model);
  system->add_contact_source(0, std::make_unique<ColliderSource>(colliders, CouplingSettings{}));
  ContactReport report(colliders);
  Grip grip;
  grip.pads_moved = 0.005;
  double before = 0.0;
  for (int i = 0; i < 360; ++i) {
    const double t = i * time_step;
    const double opening = t < 0.4 ? 0.002 - (0.002 + squeeze) * t / 0.4 : -squeeze;
    const double lowered = grip.pads_moved * std::clamp((t - 0.5) / 0.5, 0.0, 1.0);
    colliders.update(pads(opening, lowered));
    system->step(time_step, gravity);
    if (t < 0.5) before = system->state(0).position[9].z();
    if (t < 0.9) continue;
    for (const auto& force : system->contact_forces(0)) grip.ever_slipped |= force.slipping;
  }
  grip.fruit_moved = before - system->state(0).position[9].z();
  report.begin();
  report.add(0, system->model(0), system->contact_forces(0));
  report.end();
  for (const ContactSum& sum : report.colliders()) {
    grip.normal += sum.normal;
    grip.pull += sum.force_W.z();
    grip.contacts += sum.contacts;
    grip.deepest = std::max(grip.deepest, sum.deepest);
  }
  return grip;
}

TEST(ContactScene, PadsCarryAFruitAlongWhereFrictionHolds) {
  const Grip grip = pull_down(0.8);
  EXPECT_EQ(grip.contacts, 2);
  EXPECT_NEAR(grip.normal, 10.0, 0.5);
  EXPECT_FALSE(grip.ever_slipped);
  // Two friction springs of 1e4 N/m in parallel give way by 3.1 N / 2e4 N/m = 0.16 mm.
  EXPECT_NEAR(grip.fruit_moved, grip.pads_moved - 1.6e-4, 5e-5);
  EXPECT_NEAR(grip.pull, 62.8 * grip.fruit_moved / 0.1, 0.15);
}

TEST(ContactScene, PadsSlipOffAFruitWhereItDoesNot) {
  const Grip grip = pull_down(0.1);
  EXPECT_EQ(grip.contacts, 2);
  EXPECT_TRUE(grip.ever_slipped);
  EXPECT_NEAR(grip.pull, 0.1 * grip.normal, 0.01);
  EXPECT_NEAR(grip.fruit_moved, 0.1 * grip.normal / 62.8 * 0.1, 2e-4);
}

// Sum of all forces on the plant and on the colliders is zero at every step, and the plant's weight
// plus the pads' pull is what the clamp carries.
TEST(ContactScene, ForcesOnLinksAreOppositeToThoseOnThePlant) {
  const double radius = 0.002;
  const RodModel model = free_rod(radius + 0.001, radius);
  ColliderSet colliders;
  for (int i = 0; i < 4; ++i)
    colliders.add(box({0.03, 0.05, 0.01}, 0.5), at({0.05 * i + 0.02, 0, -0.005 - 0.001 * i}));
  auto system = system_with(model);
  system->add_contact_source(0, std::make_unique<ColliderSource>(colliders, CouplingSettings{}));
  ContactReport report(colliders);
  int touched = 0;
  for (int i = 0; i < 120; ++i) {
    system->step(time_step, gravity);
    report.begin();
    report.add(0, system->model(0), system->contact_forces(0));
    report.end();
    Vec3 sum = report.organs(0)[0].force_W;
    for (const ContactSum& one : report.colliders()) sum += one.force_W, touched += one.contacts;
    EXPECT_LT(sum.norm(), 1e-12);
  }
  EXPECT_GT(touched, 100);
}

// A plate of 4 mm goes through where a hanging rod is, at 2 m/s: 8.3 mm a step. The rod must stay
// ahead of it.
TEST(ContactScene, AFastPlateDoesNotPassThroughARod) {
  const double radius = 0.0015, speed = 2.0;
  RodModel model = straight_rod({0, 0, 0.3}, {0, 0, 0}, 15, radius, {2.0e7, 0.35, 700, 0.01});
  finish(model);
  ColliderSet colliders;
  const auto plate = [&](double x) { return at({x, 0, 0.1}); };
  colliders.add(box({0.004, 0.05, 0.05}, 0.3), plate(-0.03));
  auto system = system_with(model);
  system->add_contact_source(0, std::make_unique<ColliderSource>(colliders, CouplingSettings{}));
  for (int i = 1; i <= 20; ++i) {
    const double x = -0.03 + speed * i * time_step;
    const Pose pose = plate(x);
    colliders.update({&pose, 1});
    system->step(time_step, gravity);
    for (int e = 0; e < 15; ++e) {
      const Vec3 node = system->state(0).position[e];
      if (std::abs(node.z() - 0.1) > 0.02) continue;
      EXPECT_GT(node.x(), x + 0.002 + radius - 5e-4) << "step " << i << " node " << e;
    }
  }
}

// Two cantilevers that cross: the soft one above sags onto the stiff one below. In a static contact
// the two sides carry equal and opposite forces, and they do not go through each other.
TEST(ContactScene, SelfContactBalancesMomentum) {
  const double radius = 0.002;
  RodModel model = straight_rod({0, 0, 0}, {0.2, 0, 0}, 10, radius, {5.0e9, 0.35, 700, 0.01});
  for (int e = 0; e < 10; ++e) {
    const Vec3 end(0.1, 0.02 * (e + 1) - 0.1, 0.01);
    const Vec3 normal = Vec3::Zero();
    const int index = add_element(model, e == 0 ? -1 : 9 + e, end,
                                  cosserat::circle_section(radius, {3.0e8, 0.35, 700, 0}), normal);
    model.elements[index].radius_near = model.elements[index].radius_far = radius;
    model.elements[index].damping_time = 0.05;
  }
  finish(model);
  auto system = system_with(model);
  system->add_contact_source(
      0, std::make_unique<cosserat::SelfContact>(model, self_contact_settings({})));
  for (int i = 0; i < 720; ++i) system->step(time_step, gravity);
  Vec3 sum = Vec3::Zero();
  double normal = 0.0;
  for (const auto& force : system->contact_forces(0)) {
    sum += force.normal * force.point.normal_W + force.tangential_W;
    normal += force.normal;
  }
  ASSERT_FALSE(system->contact_forces(0).empty());
  EXPECT_GT(normal, 0.002);
  EXPECT_LT(sum.norm(), 1e-3 * normal);
  EXPECT_LT(system->report(0).deepest, 2.0e-4);
}

TEST(ContactScene, AStepWithContactDoesNotAllocateOnceWarm) {
  const double radius = 0.002;
  const RodModel model = free_rod(radius, radius);
  ColliderSet colliders;
  Collider ground;
  ground.shape = std::make_shared<geometry::PlaneDistance>();
  colliders.add(ground, {});
  auto system = system_with(model);
  system->add_contact_source(0, std::make_unique<ColliderSource>(colliders, CouplingSettings{}));
  system->add_contact_source(
      0, std::make_unique<cosserat::SelfContact>(model, self_contact_settings({})));
  for (int i = 0; i < 20; ++i) system->step(time_step, gravity);
  const long before = allocations();
  for (int i = 0; i < 20; ++i) system->step(time_step, gravity);
  EXPECT_EQ(allocations(), before);
  EXPECT_FALSE(system->contact_forces(0).empty());
}

}  // namespace
}  // namespace pedicel::coupling
