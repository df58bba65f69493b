// Plants that touch each other: what they share, that both sides feel one force, and that nothing
// changes for those that are far apart.
#include "plugins/cosserat/solver/canopy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/core/check.h"
#include "plugins/cosserat/solver/rod_system.h"
#include "plugins/plant/reference_plants.h"
#include "tests/analytic/rod_cases.h"
#include "tests/unit/cosserat/random_plants.h"

namespace pedicel::cosserat::cases {
namespace {

constexpr double dt = 1.0 / 240.0;
const Vec3 no_gravity = Vec3::Zero();

// Newton's iterations stop where they are needless for one plant, or for all: only what has
// converged can be compared.
RodSettings converged() {
  RodSettings settings;
  settings.newton_iterations = 40;
  settings.tolerance = 1.0e-9;
  return settings;
}

// A cantilever of a circular section.
RodModel cantilever_of(const char* name, const Vec3& from, const Vec3& to, double radius, double e,
                       int elements) {
  RodModel model;
  model.name = name;
  model.root.position = from;
  model.root.rotation = Quat::FromTwoVectors(Vec3::UnitZ(), to - from);
  model.organs = {std::string(name) + "/stem"};
  for (int i = 0; i < elements; ++i) {
    const int made = add_element(model, i - 1, from + (i + 1.0) / elements * (to - from),
                                 circle_section(radius, Material{e, 0.3, 8000.0, 0.0}));
    model.elements[made].radius_near = model.elements[made].radius_far = radius;
    model.elements[made].mass_damping = 20.0;
  }
  finish(model);
  return model;
}

Vec3 sum_of(const std::vector<ContactForce>& forces) {
  Vec3 sum = Vec3::Zero();
  for (const ContactForce& one : forces) sum += one.normal * one.point.normal_W + one.tangential_W;
  return sum;
}

// Two cantilevers of length 0.4 m cross at right angles where each ends, the upper one's axis two
// radii above the lower one's, and a force presses the upper end down. They share it as springs of
// k = 3 E I / L^3 side by side (Gere & Timoshenko, Mechanics of Materials, appendix G).
TEST(Canopy, CrossedCantileversShareALoadByTheirStiffness) {
  constexpr double radius = 0.004, length = 0.4, load = 0.2, overhang = 0.02;
  for (const double ratio : {0.5, 1.0, 3.0}) {
    constexpr double modulus = 2.0e9;
    RodSystem system{RodSettings{}};
    system.add_plant(cantilever_of("upper", {-length, 0, 2 * radius}, {overhang, 0, 2 * radius},
                                   radius, modulus, 42));
    system.add_plant(
        cantilever_of("lower", {0, -length, 0}, {0, overhang, 0}, radius, ratio * modulus, 42));
    system.let_plants_touch({1.0e6, 1.0e4, 0.3, 1.0e-5});
    // At the crossing, two elements before the end.
    system.loads(0).push_back({39, 0.0, Vec3(0, 0, -load), Vec3::Zero()});
    // Heavy elements, so that contact's spring is stiff, in no gravity. What is left of the
    // iterations makes the two quiver by 0.1 mm: means over a second.
    double on_upper = 0.0, sunk = 0.0;
    constexpr int settling = 1000, measured = 240;
    for (int i = 0; i < settling + measured; ++i) {
      system.step(dt, no_gravity);
      const Vec3 upper = sum_of(system.contact_forces(0)), lower = sum_of(system.contact_forces(1));
      ASSERT_LT((upper + lower).norm(), 1e-12);
      if (i < settling) continue;
      on_upper += upper.z() / measured;
      sunk -= system.state(1).position[39].z() / measured;
    }
    EXPECT_NEAR(on_upper, load * ratio / (1.0 + ratio), 0.02 * load) << "ratio " << ratio;
    const double inertia = M_PI / 4.0 * std::pow(radius, 4);
    const double spring = 3.0 * modulus * inertia / std::pow(length, 3);
    EXPECT_NEAR(sunk, load / (spring * (1.0 + ratio)), 0.03 * sunk) << "ratio " << ratio;
    ASSERT_FALSE(system.contact_forces(0).empty());
    const ContactPoint& point = system.contact_forces(0).front().point;
    ASSERT_TRUE(is_other_plant(point.collider));
    EXPECT_EQ(system.touched(point.collider).plant, 1);
    EXPECT_NEAR(system.touched(point.collider).shape, 39.5, 1.0);  // it lies at a node
  }
}

std::vector<RodModel> garden(int plants, bool loops) {
  std::vector<RodModel> models;
  for (int p = 0; p < plants; ++p) {
    Random random(p);
    models.push_back(random_plant(random, 12 + p, loops && p % 3 == 0));
    models.back().name = "plant_" + std::to_string(p);
    models.back().organs = {models.back().name + "/stem"};
  }
  return models;
}

// A rigid motion of the drawn plant.
void shift(RodModel& model, const Vec3& by) {
  model.root.position += by;
  for (Element& element : model.elements) element.drawn_position += by;
  for (Support& support : model.supports) support.position += by;
}

// Solved as one, yet not in each other's reach. They swing gently: which steps are of first order,
// because something moves fast, is decided for all at once.
TEST(Canopy, PlantsThatAreFarApartMoveAsTheyDoAlone) {
  RodSystem together{converged(), 2}, alone{converged()};
  for (int p = 0; p < 6; ++p) {
    RodModel model = plant::forest_plant(p);
    shift(model, Vec3(p, 0, 0));
    for (RodSystem* system : {&together, &alone}) {
      system->add_plant(model);
      system->loads(p).push_back({18, 0.0, Vec3(0.002 * p, 0.003, 0), Vec3::Zero()});
    }
    alone.add_contact_source(p, std::make_unique<SelfContact>(model, SelfContactSettings{}));
  }
  together.let_plants_touch(SelfContactSettings{});
  for (int i = 0; i < 120; ++i) {
    together.step(dt, gravity);
    alone.step(dt, gravity);
  }
  for (int p = 0; p < alone.size(); ++p)
    for (int e = 0; e < alone.model(p).size(); ++e)
      EXPECT_LT((together.state(p).position[e] - alone.state(p).position[e]).norm(), 1e-6)
          << "plant " << p << ", element " << e;
}

// Random trees whose crowns stand in each other.
std::uint64_t tangled(int threads, Vec3& imbalance, int& contacts, double& fastest) {
  RodSystem system{RodSettings{}, threads};
  for (RodModel& model : garden(5, true)) {
    shift(model, Vec3(0.03 * system.size(), 0, 0) - model.root.position);
    model.fruits[0].thresholds.stretch = 0.05;
    system.add_plant(model);
  }
  system.let_plants_touch(SelfContactSettings{});
  imbalance.setZero();
  contacts = 0;
  fastest = 0.0;
  for (int i = 0; i < 240; ++i) {
    system.step(dt, gravity);
    Vec3 sum = Vec3::Zero();
    for (int p = 0; p < system.size(); ++p) {
      sum += sum_of(system.contact_forces(p));
      contacts += system.report(p).contacts;
      for (const Vec3& v : system.state(p).velocity) fastest = std::max(fastest, v.norm());
    }
    imbalance = imbalance.cwiseMax(sum.cwiseAbs());
  }
  StateHash hash;
  system.add_to(hash);
  return hash.value();
}

TEST(Canopy, ForcesBalanceAndBitsDoNotDependOnThreads) {
  Vec3 imbalance;
  int contacts = 0;
  double fastest = 0.0;
  const std::uint64_t one = tangled(1, imbalance, contacts, fastest);
  EXPECT_GT(contacts, 100);
  EXPECT_LT(imbalance.maxCoeff(), 1e-10);
  EXPECT_LT(fastest, 20.0);
  EXPECT_EQ(one, tangled(2, imbalance, contacts, fastest));
}

// What a model has one of, for all of its joints.
TEST(Canopy, PlantsMustAgreeOnTheirGusts) {
  RodSystem system{RodSettings{}};
  for (RodModel& model : garden(2, false)) {
    model.air.resize(model.elements.size());
    model.gust_frequency = 1.0 + system.size();
    system.add_plant(model);
  }
  system.let_plants_touch(SelfContactSettings{});
  try {
    system.step(dt, gravity);
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("gust frequency of \"plant_1\""));
  }
}

// Laws of one plant are those of its own joints, whatever the others have.
TEST(Canopy, JointLawsStayWithTheirPlant) {
  RodSystem together{converged()}, alone{converged()};
  JointBranch slow, slider;
  slow.share = 0.5;
  slow.time = 0.2;
  slider.share = 0.2;
  slider.limit = 1.0e-3;
  JointLaw creeping, rubbing;
  creeping.deviation = -0.5;
  creeping.branches = {slow};
  rubbing.elastic = 0.6;
  rubbing.branches = {slider, slider};
  for (int p = 0; p < 3; ++p) {
    RodModel model = plant::forest_plant(p);
    shift(model, Vec3(p, 0, 0));
    if (p > 0) model.laws.assign(model.elements.size(), p == 1 ? creeping : rubbing);
    together.add_plant(model);
    alone.add_plant(model);
  }
  together.let_plants_touch(SelfContactSettings{});
  for (int i = 0; i < 120; ++i) {
    together.step(dt, gravity);
    alone.step(dt, gravity);
  }
  for (int p = 0; p < 3; ++p)
    EXPECT_LT((together.state(p).position.back() - alone.state(p).position.back()).norm(), 1e-6)
        << "plant " << p;
  EXPECT_EQ(together.state(0).joint_memory.size(), 0u);
  const std::vector<Vec3>&kept = together.state(1).joint_memory, &own = alone.state(1).joint_memory;
  ASSERT_EQ(kept.size(), own.size());
  for (std::size_t i = 0; i < own.size(); ++i) EXPECT_LT((kept[i] - own[i]).norm(), 1e-6);
}

// A plant that gets other laws between two steps has memory of another size.
TEST(Canopy, OtherLawsStartTheirMemoryAnew) {
  RodSystem system{RodSettings{}};
  for (int p = 0; p < 2; ++p) system.add_plant(plant::forest_plant(p));
  system.let_plants_touch(SelfContactSettings{});
  for (const int branches : {1, 3, 0, 2}) {
    JointBranch slow;
    slow.share = 0.1;
    slow.time = 0.2;
    JointLaw law;
    law.branches.assign(branches, slow);
    system.edit_model(1).laws.assign(system.model(1).elements.size(), law);
    system.edit_state(1);
    for (int i = 0; i < 5; ++i) system.step(dt, gravity);
    EXPECT_EQ(system.state(1).joint_memory.size(), branches * system.model(1).elements.size());
    EXPECT_TRUE(system.state(1).position.back().allFinite());
  }
}

}  // namespace
}  // namespace pedicel::cosserat::cases
