// No rod goes through a link: a tool that moves at 1 m/s with steps of 1/120 s moves by 8.3 mm a
// step, several times what a thin link and a thin stem measure together. With shipped settings.
//
// Looked at each place of the rod alone, a step could carry it through wherever v dt > t + 2 r (t
// the link's thickness, r the rod's radius): then both its ends may be free of contact. And a place
// that is pressed deeper than r + t / 2 would be nearer to the far side. Both are decided by the
// side that the place was on when the step began, for which it is followed through the step.
//
// What Newton's iterations do not get through, a thin rod that is wrapped over an edge or a needle
// and dragged along it, is solved again in two halves of the step. Of 4,000 random cases 3 still go
// through; without the halves 15 did.
//
// The check does not use distances: in the link's frame, where the link rests, no place of the rod
// may change its side of the plate while it is over its face, and no segment may cross the needle's
// axis. What moves farther in a step than it is from the plate's edge, from the needle's end or
// from the rod's own tip may have gone round them, and is not counted.
#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <iostream>
#include <memory>
#include <vector>

#include "engine/core/random.h"
#include "engine/geometry/shapes.h"
#include "plugins/cosserat/solver/rod_system.h"
#include "plugins/coupling/collider_source.h"
#include "tests/unit/coupling/plants.h"

namespace pedicel::coupling {
namespace {

using cosserat::RodModel;
using cosserat::RodState;

constexpr double dt = 1.0 / 120.0, speed = 1.0;
constexpr int steps = 24;  // 0.2 m of way
const Vec3 gravity(0, 0, -9.81);

Vec3 random_direction(Random& random) {
  Vec3 v;
  do v = Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  while (v.norm() > 1.0 || v.norm() < 0.1);
  return v.normalized();
}

// A clamped rod of 0.2 m, from floppy (1e6 Pa) to wood (5e9 Pa).
RodModel random_rod(Random& random) {
  const double radius = random.uniform(0.0005, 0.003);
  const double modulus = std::pow(10.0, random.uniform(6.0, 9.7));
  const int segments = static_cast<int>(random.uniform(8, 21));
  RodModel model = straight_rod({0, 0, 0}, {0, 0, 0.2}, segments, radius,
                                {modulus, 0.35, 700.0, random.uniform(0.0, 0.02)});
  finish(model);
  return model;
}

struct Places {
  std::vector<Vec3> now, before;  // m, C: along the rod
};

// A link that starts beside the rod's upper half and moves across it.
class Crossing {
 public:
  Crossing(Random& random, std::shared_ptr<const geometry::SignedDistance> shape,
           const Quat& orientation, const Vec3& direction, double ahead)
      : system_(cosserat::RodSettings{}), direction_(direction) {
    system_.add_plant(random_rod(random));
    Collider link;
    link.shape = std::move(shape);
    link.friction = random.uniform(0.0, 1.0);
    const Vec3 aim(0, 0, random.uniform(0.1, 0.17));
    pose_ = {aim - ahead * direction, orientation};
    colliders_.add(link, pose_);
    system_.add_contact_source(0, std::make_unique<ColliderSource>(colliders_, CouplingSettings{}));
    places_.now = places();
  }

  const Places& step() {
    pose_.position += speed * dt * direction_;
    colliders_.update({&pose_, 1});
    places_.before = places_.now;
    system_.step(dt, gravity);
    places_.now = places();
    touched_ |= !system_.contact_forces(0).empty();
    return places_;
  }
  bool touched() const { return touched_; }
  // m, along the rod, from one of the places.
  double to_tip(std::size_t place) const {
    return 0.2 * (1.0 - static_cast<double>(place) / static_cast<double>(places_.now.size()));
  }

 private:
  std::vector<Vec3> places() const {
    std::vector<Vec3> found;
    const Pose X_CW = pose_.inverse();
    for (int e = 0; e < system_.model(0).size(); ++e)
      for (int i = 0; i < 8; ++i)
        found.push_back(X_CW * point_on(system_.model(0), system_.state(0), e,
                                        (1.0 - i / 8.0) * system_.model(0).elements[e].length));
    return found;
  }

  cosserat::RodSystem system_;
  ColliderSet colliders_;
  Pose pose_;
  Vec3 direction_;
  Places places_;
  bool touched_ = false;
};

// 150 seeds, and others that go through where no step is taken in halves (of the needle's 150, 1048
// does).
std::vector<unsigned> seeds(unsigned first, std::initializer_list<unsigned> others) {
  std::vector<unsigned> all(others);
  for (unsigned i = 0; i < 150; ++i) all.push_back(first + i);
  return all;
}

TEST(Tunnel, NoRodGoesThroughAThinPlate) {
  int touched = 0, failed = 0;
  for (const unsigned seed : seeds(1, {263, 345, 1021})) {
    Random random(seed);
    const Vec3 size(0.06, 0.06, std::pow(10.0, random.uniform(-3.7, -2.3)));  // 0.2 to 5 mm
    // Level, so that it does not come down on the clamp, which cannot give way.
    Vec3 direction = random_direction(random);
    direction.z() = 0.0;
    direction.normalize();
    // Its normal within 60 degrees of the way.
    Vec3 normal = random_direction(random);
    if (normal.dot(direction) < 0.0) normal = -normal;
    normal = (normal + direction).normalized();
    Crossing crossing(random, std::make_shared<geometry::BoxDistance>(size),
                      Quat::FromTwoVectors(Vec3::UnitZ(), normal), direction, 0.05);
    const auto from_edge = [&](const Vec3& p) {
      return 0.5 * size.x() - std::max(std::abs(p.x()), std::abs(p.y()));
    };
    bool passed = false;
    for (int i = 0; i < steps; ++i) {
      const Places& places = crossing.step();
      for (std::size_t p = 0; p < places.now.size(); ++p) {
        const Vec3 &now = places.now[p], &before = places.before[p];
        const double inside = std::min(from_edge(now), from_edge(before));
        passed |= inside > std::max(0.002, (now - before).norm()) && now.z() * before.z() < 0.0;
      }
    }
    touched += crossing.touched();
    failed += passed;
    if (passed) std::cout << "went through: seed " << seed << "\n";
  }
  EXPECT_GT(touched, 100);
  EXPECT_EQ(failed, 0);
}

// Where two segments cross in a step, the volume between them changes its sign while their nearest
// places lie inside of both. `to_tip` is how far the rod's tip is.
bool crossed_axis(const Vec3& a_before, const Vec3& b_before, const Vec3& a, const Vec3& b,
                  double half_length, double to_tip) {
  const double moved = std::max((a - a_before).norm(), (b - b_before).norm());
  const double to_end = half_length - std::max(std::abs(a.z()), std::abs(a_before.z()));
  if (moved > std::min(to_end, to_tip)) return false;
  const auto volume = [](const Vec3& p, const Vec3& q) { return p.x() * q.y() - p.y() * q.x(); };
  const double then = volume(a_before, b_before), now = volume(a, b);
  if (then * now >= 0.0) return false;
  const double share = then / (then - now);
  const Vec3 p = a_before + share * (a - a_before), q = b_before + share * (b - b_before);
  // Where the axis of z meets the segment p q seen from above.
  const Vec3 along = q - p;
  const double at =
      -(p.x() * along.x() + p.y() * along.y()) / (along.x() * along.x() + along.y() * along.y());
  return at > 0.0 && at < 1.0 && std::abs(p.z() + at * along.z()) < half_length;
}

TEST(Tunnel, NoRodGoesThroughANeedle) {
  int touched = 0, failed = 0;
  for (const unsigned seed : seeds(1001, {})) {
    Random random(seed);
    const double thickness = std::pow(10.0, random.uniform(-3.7, -2.3)), length = 0.1;
    Vec3 direction = random_direction(random);
    direction.z() *= 0.3;
    direction.normalize();
    const Vec3 axis = direction.cross(random_direction(random)).normalized();
    if (std::abs(axis.z()) > 0.9) continue;  // along the rod it passes beside it
    Crossing crossing(random, std::make_shared<geometry::CylinderDistance>(0.5 * thickness, length),
                      Quat::FromTwoVectors(Vec3::UnitZ(), axis), direction, 0.05);
    bool passed = false;
    for (int i = 0; i < steps; ++i) {
      const Places& places = crossing.step();
      for (std::size_t p = 0; p + 1 < places.now.size(); ++p)
        passed |= crossed_axis(places.before[p], places.before[p + 1], places.now[p],
                               places.now[p + 1], 0.5 * length, crossing.to_tip(p));
    }
    touched += crossing.touched();
    failed += passed;
    if (passed) std::cout << "went through: seed " << seed << "\n";
  }
  EXPECT_GT(touched, 80);
  EXPECT_EQ(failed, 0);
}

}  // namespace
}  // namespace pedicel::coupling
