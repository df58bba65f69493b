// What contact costs where nothing is near, counted in looks at distance fields and at pairs.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "engine/core/random.h"
#include "engine/core/state_hash.h"
#include "engine/geometry/shapes.h"
#include "plugins/cosserat/contact/self_contact.h"
#include "plugins/cosserat/solver/rod_system.h"
#include "plugins/coupling/collider_source.h"
#include "plugins/coupling/element_chunks.h"
#include "plugins/plant/reference_plants.h"
#include "tests/support/allocation_counter.h"

namespace pedicel::coupling {
namespace {

using cosserat::ContactPoint;
using cosserat::RodModel;
using cosserat::RodState;

constexpr double dt = 1.0 / 240.0;

/// Passes every question on and counts it.
class CountedField : public geometry::SignedDistance {
 public:
  CountedField(std::shared_ptr<const geometry::SignedDistance> field, long& count)
      : field_(std::move(field)), count_(count) {}
  double distance(const Vec3& p, Vec3* gradient) const override {
    ++count_;
    return field_->distance(p, gradient);
  }
  geometry::Aabb bounds() const override { return field_->bounds(); }

 private:
  std::shared_ptr<const geometry::SignedDistance> field_;
  long& count_;
};

Collider counted(std::shared_ptr<const geometry::SignedDistance> field, long& count) {
  Collider collider;
  collider.shape = std::make_shared<CountedField>(std::move(field), count);
  return collider;
}

Pose at(double x, double y, double z) {
  return {{x, y, z}, Quat::Identity()};
}

RodState shifted(const RodModel& model, const Vec3& by) {
  RodState state = drawn_state(model);
  for (Vec3& position : state.position) position += by;
  return state;
}

// A robot of ten links that moves beside a plant of the forest, 59 elements.
TEST(BroadPhase, AsksNothingOfARobotThatIsNotNear) {
  const RodModel model = plant::forest_plant(0);
  const RodState state = drawn_state(model);
  long asked = 0;
  ColliderSet colliders;
  std::vector<Pose> poses;
  for (int link = 0; link < 10; ++link) {
    poses.push_back(at(0.4, 0.0, 0.05 * link));
    colliders.add(counted(std::make_shared<geometry::BoxDistance>(Vec3(0.1, 0.1, 0.1)), asked),
                  poses.back());
  }
  ColliderSource source(colliders, {});
  std::vector<ContactPoint> found;
  const auto step = [&] {
    for (Pose& pose : poses) pose.position.y() += 0.001;
    colliders.update(poses);
    source.begin_step(model, state, dt);
    for (int iteration = 0; iteration < 4; ++iteration) source.find(model, state, dt, found);
  };
  step();
  const long before = allocations();
  for (int i = 0; i < 100; ++i) step();
  EXPECT_EQ(allocations(), before);
  EXPECT_EQ(asked, 0);
  EXPECT_TRUE(found.empty());
}

// The ground has no box, so its field is asked once a chunk of at most 8 elements; only the lowest
// chunk comes near enough for its shapes to ask by themselves, one question each.
TEST(BroadPhase, AsksTheGroundOnceAChunk) {
  const RodModel model = plant::forest_plant(0);
  const RodState state = shifted(model, {0, 0, 0.05});
  long asked = 0;
  ColliderSet colliders;
  colliders.add(counted(std::make_shared<geometry::PlaneDistance>(), asked), {});
  ColliderSource source(colliders, {});
  std::vector<ContactPoint> found;
  source.begin_step(model, state, dt);
  source.find(model, state, dt, found);
  EXPECT_TRUE(found.empty());
  ElementChunks chunks;
  chunks.build(model, 0.0);
  EXPECT_LE(chunks.chunks().size(), model.elements.size() / 5);
  EXPECT_LE(asked, static_cast<long>(chunks.chunks().size()) + 8);
  EXPECT_GT(asked, 0);
}

// Every shape's way must lie in its chunk's box, however the elements turn and move in the step.
TEST(ElementChunks, HoldTheWaysOfTheirShapes) {
  Random random(11);
  const RodModel model = plant::hanging_tree();
  ElementChunks chunks;
  chunks.build(model, 1.0e-4);
  EXPECT_TRUE(chunks.is_built_for(model));
  RodState start = drawn_state(model), end = start;
  for (RodState* state : {&start, &end})
    for (int e = 0; e < model.size(); ++e) {
      for (double& x : state->position[e]) x += random.uniform(-0.02, 0.02);
      state->orientation[e] = Quat::FromTwoVectors(
          Vec3::UnitZ(), Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)));
    }
  chunks.begin(start.position);
  chunks.extend(end.position);
  int next_element = 0;
  std::size_t shapes = 0;
  for (const ElementChunks::Chunk& chunk : chunks.chunks()) {
    EXPECT_EQ(chunk.first, next_element);
    next_element = chunk.last;
    for (int i = chunk.first_shape; i < chunk.last_shape; ++i, ++shapes) {
      const auto& shape = model.shapes[chunks.shapes()[i]];
      ASSERT_TRUE(shape.element >= chunk.first && shape.element < chunk.last);
      for (const RodState* state : {&start, &end})
        for (const double back : {shape.back_near, shape.back_far}) {
          const Vec3 place = state->position[shape.element] -
                             back * (state->orientation[shape.element] * Vec3::UnitZ());
          const Vec3 rim = Vec3::Constant(shape.radius_near + 1.0e-4);
          EXPECT_TRUE(chunk.way_W.contains(place + rim) && chunk.way_W.contains(place - rim));
        }
    }
  }
  EXPECT_EQ(next_element, model.size());
  EXPECT_EQ(shapes, model.shapes.size());
}

// Drawn apart, the branches of a plant look at few pairs however far it is carried as a whole, and
// collect pairs anew only once it has moved by the skin.
TEST(BroadPhase, SelfContactLooksAtFewPairsOfAPlantThatStaysApart) {
  const RodModel model = plant::forest_plant(0);
  cosserat::SelfContact source(model, {});
  std::vector<ContactPoint> found;
  RodState start = drawn_state(model);
  const auto step_to = [&](const RodState& state) {
    source.begin_step(model, start, dt);
    for (int iteration = 0; iteration < 4; ++iteration) source.find(model, state, dt, found);
    start = state;
  };
  step_to(start);
  EXPECT_EQ(source.work().collections, 0);
  // Of the 59 * 58 / 2 = 1711 pairs, those beside the forks.
  EXPECT_LE(source.work().pairs, 4 * 11);
  for (int i = 1; i <= 10; ++i) step_to(shifted(model, {2.0e-4 * i, 0, 0}));
  EXPECT_EQ(source.work().collections, 0);
  EXPECT_LE(source.work().pairs, 4 * 11 * 11);
  for (int i = 1; i <= 100; ++i) step_to(shifted(model, {2.0e-4 * (10 + i), 0, 0}));
  EXPECT_LE(source.work().collections, 100 / 10);
  EXPECT_GT(source.work().collections, 0);
  EXPECT_TRUE(found.empty());
}

// A branch that is thrown at another from far beyond the skin, within one step, is still met: the
// pairs are collected over its way.
TEST(BroadPhase, SelfContactMeetsWhatComesFromBeyondTheSkin) {
  RodModel model;
  const auto add = [&](int parent, const Vec3& end) {
    const int e = add_element(model, parent, end, cosserat::circle_section(0.002, {}));
    model.elements[e].radius_near = model.elements[e].radius_far = 0.002;
  };
  for (int e = 0; e < 4; ++e) add(e - 1, {0.02 * (e + 1), 0, 0});
  for (int e = 0; e < 4; ++e) add(e == 0 ? -1 : e + 3, {0.05, 0.02 * e - 0.02, 0.03});
  model.organs = {"plant/stem"};
  finish(model);
  cosserat::SelfContact source(model, {});
  const RodState start = drawn_state(model);
  RodState state = start;
  for (int e = 4; e < 8; ++e) state.position[e].z() -= 0.031;  // 1 mm beyond the other's axis
  std::vector<ContactPoint> found;
  source.begin_step(model, start, dt);
  source.find(model, state, dt, found);
  // Element 2 and element 5 cross at right angles; each gets half of the overlap.
  const auto under = std::find_if(found.begin(), found.end(), [](const ContactPoint& point) {
    return point.shape == 2 && point.collider == cosserat::self_contact_base + 5;
  });
  ASSERT_NE(under, found.end());
  EXPECT_NEAR(under->normal_W.z(), -1.0, 1e-6);
  EXPECT_NEAR(under->gap, -0.5 * (0.001 + 2 * 0.002), 1e-8);
}

// Branches and twigs of the hanging tree fall into each other: the threads that share the pairs out
// must not show.
TEST(BroadPhase, SelfContactGivesTheSameBitsWithAnyNumberOfThreads) {
  const auto fall = [](int threads) {
    cosserat::RodSystem system({}, threads);
    system.add_plant(plant::hanging_tree());
    system.add_contact_source(0, std::make_unique<cosserat::SelfContact>(
                                     system.model(0), cosserat::SelfContactSettings{}));
    for (int i = 0; i < 100; ++i) system.step(dt, {0, 0, -9.81});
    EXPECT_GT(system.report(0).contacts, 50);
    StateHash hash;
    system.add_to(hash);
    return hash.value();
  };
  EXPECT_EQ(fall(1), fall(2));
}

}  // namespace
}  // namespace pedicel::coupling
