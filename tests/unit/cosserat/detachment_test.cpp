// Fruits that come off: at their threshold, with the right cause, and with their momentum.
#include "plugins/cosserat/solver/detachment.h"

#include <gtest/gtest.h>

#include "tests/analytic/rod_cases.h"
#include "tests/unit/cosserat/random_plants.h"

namespace pedicel::cosserat::cases {
namespace {

// A stem with a stalk to the side, which ends in a fruit.
RodModel stalk(const Thresholds& thresholds, double back = 0.0) {
  const Section section = circle_section(0.002, {2.0e7, 0.3, 700.0, 0.0});
  RodModel model;
  add_element(model, -1, Vec3(0, 0, 0.05), section);
  add_element(model, 0, Vec3(0.02, 0, 0.06), section);
  model.fruits.push_back({"fruit", 1, back, 0.012, 1000.0, thresholds});
  finish(model);
  return model;
}

struct Limit {
  const char* cause;
  double Thresholds::*threshold;
  double DetachEvent::*value;
};

constexpr Limit limits[] = {
    {"stretch", &Thresholds::stretch, &DetachEvent::stretch},
    {"bend", &Thresholds::bend, &DetachEvent::bend},
    {"force", &Thresholds::force, &DetachEvent::force},
    {"moment", &Thresholds::moment, &DetachEvent::moment},
    {"torsion", &Thresholds::torsion, &DetachEvent::torsion},
};

RodState loaded(const RodModel& model) {
  RodState state = drawn_state(model);
  const Load load{1, 0.0, Vec3(0.1, 0.05, 0.2), Vec3(1e-3, 0, 1e-3)};
  settle(model, state, no_gravity, {&load, 1});
  return state;
}

// What the joint carries, by its definition.
double carried(const RodModel& model, const RodState& state, const std::string& cause) {
  const Strain strain = strain_of(model, state, 1);
  const JointLoad load = joint_load(model, state, 1);
  if (cause == "stretch") return strain.stretch.norm();
  if (cause == "bend") return strain.bend.norm();
  if (cause == "force") return load.force.norm();
  if (cause == "moment") return load.moment.head<2>().norm();
  return std::abs(load.moment.z());
}

// What damping passes on counts for limits of load: K (strain + time rate), by the step's own rate.
TEST(Detachment, LimitsOfLoadCountWhatDampingPassesOn) {
  RodModel model = stalk({});
  for (Element& element : model.elements) element.damping_time = 0.02;
  RodState state = loaded(model);
  const double elastic = joint_load(model, state, 1).force.norm();
  model.fruits[0].thresholds.force = 1.5 * elastic;
  std::vector<DetachEvent> events;
  StalkStart rested;
  begin_stalks(model, state, 0.01, rested);
  detach(model, state, events, rested);
  EXPECT_TRUE(events.empty()) << "nothing moved";
  // The load grew from zero within the step: three times the elastic part in all.
  StalkStart pulled = rested;
  pulled.loads[0] = JointLoad{};
  detach(model, state, events, pulled);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].cause, "force");
  EXPECT_NEAR(events[0].force, 3.0 * elastic, 1e-9 * elastic);
}

TEST(Detachment, EachThresholdBreaksAtItsValueAndIsNamed) {
  for (const Limit& limit : limits) {
    RodModel model = stalk({});
    RodState state = loaded(model);
    const double value = carried(model, state, limit.cause);
    ASSERT_GT(value, 0.0) << limit.cause;
    std::vector<DetachEvent> events;
    model.fruits[0].thresholds.*limit.threshold = 1.001 * value;
    detach(model, state, events);
    EXPECT_TRUE(events.empty()) << limit.cause;
    EXPECT_NEAR(margin_used(model, state, 0), 1.0 / 1.001, 1e-9);
    model.fruits[0].thresholds.*limit.threshold = 0.999 * value;
    detach(model, state, events);
    ASSERT_EQ(events.size(), 1u) << limit.cause;
    EXPECT_EQ(events[0].cause, limit.cause);
    EXPECT_NEAR(events[0].*limit.value, value, 1e-12);
    EXPECT_TRUE(state.fruit_gone[0]);
    detach(model, state, events);
    EXPECT_EQ(events.size(), 1u) << "it came off twice";
    EXPECT_EQ(margin_used(model, state, 0), 0.0);
  }
}

TEST(Detachment, TheCauseIsTheThresholdThatIsPassedMost) {
  RodModel model = stalk({});
  RodState state = loaded(model);
  model.fruits[0].thresholds.stretch = carried(model, state, "stretch") / 1.1;
  model.fruits[0].thresholds.moment = carried(model, state, "moment") / 1.5;
  std::vector<DetachEvent> events;
  detach(model, state, events);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].cause, "moment");
}

// Two fruits at one place: the first leaves the stub to the second, and takes no mass but its own.
TEST(Detachment, TheSecondFruitOfASegmentStays) {
  RodModel model = stalk({});
  model.fruits.push_back(model.fruits[0]);
  model.fruits[1].name = "second";
  finish(model);
  RodState state = loaded(model);
  const double all = model.elements[1].mass, one = fruit_mass(model.fruits[0]);
  std::vector<DetachEvent> events;
  model.fruits[0].thresholds.force = 0.5 * carried(model, state, "force");
  detach(model, state, events);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_DOUBLE_EQ(events[0].mass, one);
  EXPECT_TRUE(state.alive[1]);
  EXPECT_FALSE(state.fruit_gone[1]);
  EXPECT_NEAR(model.elements[1].mass, all - one, 1e-15);
  model.fruits[1].thresholds.force = 0.5 * carried(model, state, "force");
  detach(model, state, events);
  ASSERT_EQ(events.size(), 2u) << "it would hang on nothing";
  EXPECT_EQ(events[1].fruit, 1);
  EXPECT_NEAR(events[1].mass, all - one, 1e-15) << "with the stub";
  EXPECT_FALSE(state.alive[1]);
}

TEST(Detachment, NothingComesOffWithoutThresholds) {
  RodModel model = stalk({});
  RodState state = loaded(model);
  std::vector<DetachEvent> events;
  detach(model, state, events);
  EXPECT_TRUE(events.empty());
  EXPECT_EQ(margin_used(model, state, 0), 0.0);
}

// Linear momentum and angular momentum about the world's origin, kg m/s and kg m2/s.
struct Momentum {
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
  void add(double mass, const Vec3& place, const Vec3& velocity, const Vec3& spin) {
    linear += mass * velocity;
    angular += place.cross(mass * velocity) + spin;
  }
};

void add_element_momentum(const RodModel& model, const RodState& state, int e, Momentum& sum) {
  const Element& element = model.elements[e];
  const Quat& q = state.orientation[e];
  const Vec3 com = state.position[e] - element.com_back * (q * Vec3::UnitZ());
  sum.add(element.mass, com, state.velocity[e],
          q * element.inertia.cwiseProduct(state.angular_velocity[e]));
}

Momentum of(const RodModel& model, const RodState& state) {
  Momentum sum;
  for (int e = 0; e < model.size(); ++e)
    if (state.alive[e]) add_element_momentum(model, state, e, sum);
  return sum;
}

// At a tip the segment goes with its fruit, as the stub of the stalk.
TEST(Detachment, AtATipTheStubGoesWithTheFruitAndKeepsItsMomentum) {
  Random random(1);
  RodModel model = stalk({});
  model.fruits[0].thresholds.stretch = 1e-9;
  RodState state = random_state(model, random, 1e-4, 0.01);
  const Momentum before = of(model, state);
  const double mass_before = model.elements[0].mass + model.elements[1].mass;
  const double com_back = model.elements[1].com_back;
  std::vector<DetachEvent> events;
  detach(model, state, events);
  ASSERT_EQ(events.size(), 1u);
  const DetachEvent& event = events[0];
  EXPECT_FALSE(state.alive[1]);
  EXPECT_DOUBLE_EQ(event.stub_length, model.elements[1].length);
  EXPECT_NEAR(event.mass + model.elements[0].mass, mass_before, 1e-15);
  EXPECT_LT((event.position_W - state.position[1]).norm(), 1e-12);
  // The rigid body that goes on: its velocity at the fruit's centre, carried to its own centre.
  const Vec3 to_com = (0.0 - com_back) * (event.orientation * Vec3::UnitZ());
  const Vec3 velocity = event.velocity_W + event.angular_velocity_W.cross(to_com);
  Momentum after = of(model, state);
  after.linear += event.mass * velocity;
  EXPECT_LT((after.linear - before.linear).norm(), 1e-12 * before.linear.norm());
}

// Between the nodes only the fruit goes; the segment gets lighter and both keep their motion.
TEST(Detachment, InTheMiddleOnlyTheFruitGoesAndMomentumIsKept) {
  Random random(2);
  RodModel model = stalk({}, 0.015);
  model.fruits[0].thresholds.stretch = 1e-9;
  RodState state = random_state(model, random, 0.0, 0.0);
  state.position[1] *= 1.001;  // stretched a little; nodes and frame then differ by as much
  const Momentum before = of(model, state);
  const Fruit fruit = model.fruits[0];
  const Vec3 place_before = velocity_on(model, state, 1, 0.004);
  std::vector<DetachEvent> events;
  detach(model, state, events);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_TRUE(state.alive[1]);
  EXPECT_DOUBLE_EQ(events[0].mass, fruit_mass(fruit));
  EXPECT_DOUBLE_EQ(events[0].stub_length, 0.0);
  EXPECT_LT((velocity_on(model, state, 1, 0.004) - place_before).norm(), 1e-12);
  Momentum after = of(model, state);
  after.add(events[0].mass, events[0].position_W, events[0].velocity_W,
            0.4 * events[0].mass * fruit.radius * fruit.radius * events[0].angular_velocity_W);
  EXPECT_LT((after.linear - before.linear).norm(), 1e-12 * before.linear.norm());
  EXPECT_LT((after.angular - before.angular).norm(), 1e-3 * before.angular.norm());
  EXPECT_EQ(state.previous_dt, 0.0) << "the past belongs to a heavier segment";
}

}  // namespace
}  // namespace pedicel::cosserat::cases
