#include "engine/world/sim_world.h"

#include <gtest/gtest.h>

#include <string>

#include "engine/core/check.h"

namespace pedicel::world {
namespace {

BodyDescription ball(const std::string& name, double radius, double mass, const Vec3& position) {
  BodyDescription body = fruit_body(name, radius, mass, 0.0, 0.0);
  body.pose.position = position;
  return body;
}

/// Writes the phase's letter when it acts.
class Scribe : public Participant, public Observer {
 public:
  Scribe(Phase phase, std::string& log, char letter) : phase_(phase), log_(log), letter_(letter) {}
  Phase phase() const override { return phase_; }
  void act(SimWorld&, WorldReport&) override { log_ += letter_; }
  void observe(const SimWorld&, const WorldReport&) override { log_ += letter_; }

 private:
  Phase phase_;
  std::string& log_;
  char letter_;
};

TEST(SimWorld, RunsThePhasesInTheirOrderWhateverTheOrderInWhichPartsWereAdded) {
  SimWorld world({});
  std::string log;
  Scribe plants(Phase::plants, log, 'p'), control(Phase::control, log, 'r');
  Scribe commands(Phase::commands, log, 'c'), observer(Phase::observe, log, 'o');
  Scribe recorder(Phase::record, log, 'R'), second(Phase::plants, log, 'q');
  world.set_recorder(&recorder);
  world.add(static_cast<Observer&>(observer));
  for (Participant* part :
       std::initializer_list<Participant*>{&plants, &control, &commands, &second})
    world.add(*part);
  world.step();
  EXPECT_EQ(log, "crpqoR");
  world.step();
  EXPECT_EQ(log, "crpqoRcrpqoR");
}

TEST(SimWorld, RefusesAParticipantInAReadOnlyPhase) {
  SimWorld world({});
  std::string log;
  Scribe part(Phase::observe, log, 'x');
  EXPECT_THROW(world.add(static_cast<Participant&>(part)), UsageError);
}

TEST(SimWorld, RefusesAStepThatIsNoTime) {
  WorldSettings settings;
  settings.dt = 0.0;
  EXPECT_THROW(SimWorld{settings}, UsageError);
}

/// Plants must see the rigid bodies where they are at the end of the step.
class PoseAtTick : public Participant {
 public:
  Phase phase() const override { return Phase::plants; }
  void act(SimWorld& world, WorldReport&) override { seen = world.body_pose(0).position; }
  Vec3 seen = Vec3::Zero();
};

TEST(SimWorld, PlantsActOnceTheBodiesHaveMoved) {
  SimWorld world({});
  world.add_body(ball("fruit", 0.01, 0.1, {0, 0, 1}));
  PoseAtTick tick;
  world.add(tick);
  world.step();
  EXPECT_LT(tick.seen.z(), 1.0);
  EXPECT_EQ(tick.seen, world.body_pose(0).position);
}

// Bullet integrates with symplectic Euler: v_n = -g n dt, z_n = -g dt^2 n (n + 1) / 2.
TEST(SimWorld, AFruitFallsAsTheDiscreteSchemeSays) {
  SimWorld world({});
  BodyDescription fruit = ball("fruit", 0.01, 0.02, {0, 0, 2});
  fruit.velocity = Vec3(0.3, 0, 0);
  world.add_body(fruit);
  const int n = 48;
  for (int i = 0; i < n; ++i) world.step();
  const double dt = world.dt();
  EXPECT_NEAR(world.body_pose(0).position.z(), 2.0 - 9.81 * dt * dt * n * (n + 1) / 2.0, 1e-9);
  EXPECT_NEAR(world.body_pose(0).position.x(), 0.3 * n * dt, 1e-9);
  EXPECT_NEAR(world.time(), 0.2, 1e-12);
}

TEST(SimWorld, ASmallFruitLandsInATrayAndComesToRestThere) {
  WorldSettings settings;
  settings.dt = 1.0 / 480.0;
  SimWorld world(settings);
  BodyDescription tray;
  tray.name = "tray";
  tray.parts = tray_parts({0.3, 0.3, 0.06}, 0.004);
  world.add_body(tray);
  BodyDescription fruit = fruit_body("fruit", 0.012, 0.007, 0.03, 0.0015);
  fruit.pose.position = {0.02, 0.01, 0.9};
  fruit.velocity = Vec3(0.1, 0, 0);
  fruit.angular_velocity = Vec3(0, 1, 0);
  const int index = world.add_body(fruit);
  for (int i = 0; i < 5 * 480; ++i) world.step();
  const Vec3 place = world.body_pose(index).position;
  EXPECT_LT(place.head<2>().cwiseAbs().maxCoeff(), 0.15);
  EXPECT_NEAR(place.z(), 0.004 + 0.012, 0.002);
  EXPECT_LT(world.body_velocity(index).norm(), 0.02);
}

TEST(SimWorld, ABodyOfSeveralPartsKeepsTheFrameThatItWasGiven) {
  SimWorld world({});
  BodyDescription body = fruit_body("fruit", 0.01, 0.1, 0.08, 0.002);
  body.pose = {Vec3(1, 2, 3), Quat(0.5, 0.5, 0.5, 0.5)};
  const int index = world.add_body(body);
  EXPECT_LT((world.body_pose(index).position - body.pose.position).norm(), 1e-12);
  EXPECT_LT(world.body_pose(index).rotation.angularDistance(body.pose.rotation), 1e-12);
}

// Force through the centre of mass of a ball, for one step: dv = F dt / m.
TEST(SimWorld, APushActsForOneStep) {
  WorldSettings settings;
  settings.gravity = Vec3::Zero();
  SimWorld world(settings);
  world.add_body(ball("fruit", 0.05, 0.5, Vec3::Zero()));
  world.push_body(0, Vec3(2, 0, 0), Vec3::Zero());
  world.step();
  world.step();
  EXPECT_NEAR(world.body_velocity(0).x(), 2.0 * world.dt() / 0.5, 1e-12);
}

TEST(SimWorld, RefusesBodiesThatCannotBe) {
  SimWorld world({});
  EXPECT_THROW(world.add_body({}), UsageError);
  world.add_body(ball("fruit", 0.05, 0.5, Vec3::Zero()));
  EXPECT_THROW(world.add_body(ball("fruit", 0.05, 0.5, Vec3::Zero())), UsageError);
  EXPECT_THROW(world.add_body(ball("point", 0.0, 0.5, Vec3::Zero())), UsageError);
}

TEST(SimWorld, TwoWorldsSideBySideGiveTheSameBits) {
  const auto run = [] {
    SimWorld world({});
    world.set_ground({});
    for (int i = 0; i < 6; ++i)
      world.add_body(
          ball("fruit_" + std::to_string(i), 0.02, 0.05, {0.005 * i, 0.003 * i, 0.1 + 0.05 * i}));
    for (int i = 0; i < 480; ++i) world.step();
    StateHash hash;
    world.add_to(hash);
    return hash.value();
  };
  const std::uint64_t first = run();
  EXPECT_EQ(first, run());
}

}  // namespace
}  // namespace pedicel::world
