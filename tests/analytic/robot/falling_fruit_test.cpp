// A fruit that came off, as a rigid body: what restitution and friction take from it.
//
// Two bodies' restitutions e1 and e2 act as e = e1 e2, and their frictions likewise (Bullet). A
// sphere that falls from h comes back to e^2 h. One that slides at v0 without turning is braked by
// mu g, and is turned by 5/2 mu g / r, until it rolls at 5/7 v0 after 2 v0 / (7 mu g)
// (Coriolis, Theorie mathematique des effets du jeu de billard, 1835).
#include <gtest/gtest.h>

#include <cmath>

#include "engine/world/sim_world.h"

namespace pedicel::world {
namespace {

constexpr double radius = 0.02, g = 9.81;  // m, m/s2

struct Fall : SimWorld {
  /// A fruit above (m, its lowest point) a table whose top is at height 0, or such ground.
  Fall(double height, double fruit_e, double table_e, const Vec3& velocity, double dt,
       bool on_ground = false)
      : SimWorld(step_of(dt)) {
    if (on_ground)
      set_ground({.height = 0.0, .friction = 0.5, .restitution = table_e});
    else
      add_table(table_e);
    BodyDescription body = fruit_body("fruit", radius, 0.03, 0.0, 0.0);
    body.pose.position = Vec3(0, 0, height + radius);
    body.velocity = velocity;
    body.restitution = fruit_e;
    fruit = add_body(body);
  }
  void add_table(double table_e) {
    BodyDescription table;
    table.name = "table";
    table.parts.push_back({BodyPart::Kind::box, {}, Vec3(2, 2, 0.1), 0.0, 0.0});
    table.pose.position.z() = -0.1;
    table.friction = 0.5;
    table.restitution = table_e;
    add_body(table);
  }
  static WorldSettings step_of(double dt) {
    WorldSettings settings;
    settings.dt = dt;
    return settings;
  }
  double height() const { return body_pose(fruit).position.z() - radius; }
  int fruit = 0;
};

// m, its lowest point where it is highest after its first impact.
double comes_back_to(Fall& fall) {
  double highest = 0.0;
  bool was_down = false;
  for (int i = 0; i < 2400; ++i) {
    fall.step();
    was_down = was_down || fall.body_velocity(fall.fruit).z() >= 0.0;
    if (was_down) highest = std::max(highest, fall.height());
    if (was_down && fall.body_velocity(fall.fruit).z() < 0.0) break;  // on its way down again
  }
  EXPECT_TRUE(was_down);
  return highest;
}

TEST(FallingFruit, ComesBackAsHighAsRestitutionSays) {
  for (const auto& [fruit_e, table_e] :
       {std::pair(0.9, 0.8), std::pair(0.7, 0.7), std::pair(0.0, 0.9)}) {
    Fall fall(0.5, fruit_e, table_e, Vec3::Zero(), 1.0 / 2000.0);
    const double e = fruit_e * table_e;
    // The impact is anywhere within a step: 0.5 m are fallen at 3.1 m/s, 1.6 mm a step.
    EXPECT_NEAR(comes_back_to(fall), e * e * 0.5, 0.004) << fruit_e << " on " << table_e;
  }
}

// The ground of a scene file, whose friction comes with it.
TEST(FallingFruit, OnTheGroundLikewise) {
  for (const auto& [fruit_e, ground_e] :
       {std::pair(0.9, 0.8), std::pair(0.7, 0.7), std::pair(0.9, 0.0)}) {
    Fall fall(0.5, fruit_e, ground_e, Vec3::Zero(), 1.0 / 2000.0, true);
    const double e = fruit_e * ground_e;
    EXPECT_NEAR(comes_back_to(fall), e * e * 0.5, 0.004) << fruit_e << " on " << ground_e;
  }
}

TEST(FallingFruit, SlidesAndThenRollsAsFrictionSays) {
  const double v0 = 1.0;
  Fall fall(0.0, 0.0, 0.0, Vec3(v0, 0, 0), 1.0 / 1000.0);
  const double mu = 0.5 * fall.body(fall.fruit).friction;
  const double rolls_from = 2.0 * v0 / (7.0 * mu * g);
  while (fall.time() < 0.8 * rolls_from) fall.step();
  const double t = fall.time();
  // It lies a few steps later than it is put down, and is braked from then on.
  EXPECT_NEAR(fall.body_velocity(fall.fruit).x(), v0 - mu * g * t, 0.02 * v0);
  EXPECT_NEAR(fall.body_angular_velocity(fall.fruit).y() * radius, 2.5 * mu * g * t, 0.03 * v0);
  EXPECT_GT(v0 - mu * g * t, 2.5 * mu * g * t) << "it slides still";
  while (fall.time() < 1.2 * rolls_from) fall.step();
  const double rolling = fall.body_velocity(fall.fruit).x();
  EXPECT_NEAR(rolling, 5.0 / 7.0 * v0, 0.02 * v0);
  EXPECT_NEAR(fall.body_angular_velocity(fall.fruit).y() * radius, rolling, 0.01 * v0);
}

}  // namespace
}  // namespace pedicel::world
