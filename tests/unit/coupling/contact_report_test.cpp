#include "plugins/coupling/contact_report.h"

#include <gtest/gtest.h>

#include "engine/core/random.h"
#include "engine/geometry/shapes.h"
#include "plugins/cosserat/contact/self_contact.h"
#include "tests/support/allocation_counter.h"
#include "tests/unit/coupling/plants.h"

namespace pedicel::coupling {
namespace {

using cosserat::ContactForce;

struct Scene {
  ColliderSet colliders;
  cosserat::RodModel model = straight_rod({0, 0, 0}, {0.1, 0, 0}, 4, 0.002);

  Scene() {
    model.organs = {"plant/stem", "plant/truss"};
    model.elements[2].organ = model.elements[3].organ = 1;
    model.fruits.push_back({"fruit", 3, 0.0, 0.01, 950, {}});  // shape 4
    finish(model);
    for (int i = 0; i < 3; ++i) {
      Collider ball;
      ball.body = 5;
      ball.link = i == 2 ? 1 : 0;  // two colliders on link 0
      ball.shape = std::make_shared<geometry::SphereDistance>(0.01);
      colliders.add(ball, {});
    }
  }
};

Vec3 random_vector(Random& random) {
  return {random.normal(), random.normal(), random.normal()};
}

ContactForce random_force(Random& random, int shape, int collider) {
  ContactForce force;
  force.point.shape = shape;
  force.point.collider = collider;
  force.point.gap = random.uniform(-1e-4, 1e-4);
  force.point.normal_W = random_vector(random).normalized();
  force.place_W = random_vector(random);
  force.normal = random.uniform(0, 2);
  force.tangential_W = force.point.normal_W.cross(random_vector(random));
  force.slipping = random.integer(0, 1) == 1;
  return force;
}

Vec3 total(const ContactForce& force) {
  return force.normal * force.point.normal_W + force.tangential_W;
}

TEST(ContactReport, SumsOverCollidersOrgansAndLinks) {
  Random random(9);
  const Scene scene;
  std::vector<ContactForce> forces;
  for (int i = 0; i < 20; ++i) forces.push_back(random_force(random, i % 4, i % 3));
  ContactReport report(scene.colliders);
  report.begin();
  report.add(0, scene.model, forces);
  report.end();

  Vec3 on_plant = Vec3::Zero(), on_links = Vec3::Zero(), on_colliders = Vec3::Zero();
  double normal = 0.0, tangential = 0.0, deepest = 0.0;
  for (const ContactForce& force : forces) {
    on_plant += total(force);
    if (force.point.collider == 1) {
      normal += force.normal;
      tangential += force.tangential_W.norm();
      deepest = std::max(deepest, -force.point.gap);
    }
  }
  for (const ContactSum& sum : report.colliders()) on_colliders += sum.force_W;
  for (int link = 0; link < 2; ++link) on_links += report.sum_of_link(5, link).force_W;
  const Vec3 on_organs = report.organs(0)[0].force_W + report.organs(0)[1].force_W;
  EXPECT_LT((on_organs - on_plant).norm(), 1e-12);
  EXPECT_LT((on_colliders + on_plant).norm(), 1e-12);
  EXPECT_LT((on_links + on_plant).norm(), 1e-12);
  EXPECT_NEAR(report.colliders()[1].normal, normal, 1e-12);
  EXPECT_NEAR(report.colliders()[1].tangential, tangential, 1e-12);
  EXPECT_EQ(report.colliders()[1].deepest, deepest);
  EXPECT_EQ(report.sum_of_link(5, 0).contacts, 14);
  EXPECT_EQ(report.sum_of_link(6, 0).contacts, 0);
}

// Force at place and moment together must do what the single forces do: the moment about any point
// is the sum of theirs.
TEST(ContactReport, GivesTheWrenchOnALink) {
  Random random(10);
  const Scene scene;
  std::vector<ContactForce> forces;
  for (int i = 0; i < 12; ++i) forces.push_back(random_force(random, i % 4, i % 2));
  ContactReport report(scene.colliders);
  report.begin();
  report.add(0, scene.model, forces);
  report.end();
  const ContactSum sum = report.sum_of_link(5, 0);
  const Vec3 about(0.3, -0.2, 0.7);
  Vec3 expected = Vec3::Zero();
  for (const ContactForce& force : forces) expected -= (force.place_W - about).cross(total(force));
  EXPECT_LT(((sum.place_W - about).cross(sum.force_W) + sum.moment_W - expected).norm(), 1e-12);
}

TEST(ContactReport, CountsSelfContactForTheOrgansOnly) {
  Random random(11);
  const Scene scene;
  const std::vector<ContactForce> forces = {random_force(random, 3, cosserat::self_contact_base)};
  ContactReport report(scene.colliders);
  report.begin();
  report.add(1, scene.model, forces);
  report.end();
  EXPECT_EQ(report.organs(1)[1].contacts, 1);
  for (const ContactSum& sum : report.colliders()) EXPECT_EQ(sum.contacts, 0);
}

TEST(ContactReport, SumsOverFruits) {
  Random random(13);
  const Scene scene;
  const std::vector<ContactForce> forces = {random_force(random, 3, 0), random_force(random, 4, 0)};
  ContactReport report(scene.colliders);
  report.begin();
  report.add(0, scene.model, forces);
  report.end();
  EXPECT_EQ(report.fruits(0)[0].normal, forces[1].normal);
  EXPECT_LT((report.fruits(0)[0].force_W - total(forces[1])).norm(), 1e-12);
  EXPECT_EQ(report.organs(0)[1].contacts, 2);
}

TEST(ContactReport, StartsFromNothingEachStepAndDoesNotAllocateOnceWarm) {
  Random random(12);
  const Scene scene;
  std::vector<ContactForce> forces = {random_force(random, 0, 0)};
  ContactReport report(scene.colliders);
  const auto step = [&] {
    report.begin();
    report.add(0, scene.model, forces);
    report.end();
  };
  step();
  const double first = report.colliders()[0].normal;
  const long before = allocations();
  step();
  EXPECT_EQ(allocations(), before);
  EXPECT_EQ(report.colliders()[0].normal, first);
  forces.clear();
  step();
  EXPECT_EQ(report.colliders()[0].contacts, 0);
  EXPECT_EQ(report.organs(0)[0].normal, 0.0);
}

}  // namespace
}  // namespace pedicel::coupling
