#include "tests/discrepancy/scene_cases/harvest_case.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace pedicel::scene_case {

namespace {

constexpr double gap = 0.002;              // m, between fingertip and fruit: a cup holds it
constexpr double below = 0.012;            // m, of the finger's axis beneath the fruit's centre
constexpr double way_in = 0.09;            // m, along the finger
constexpr double taken = 1.0, pull = 1.1;  // s

/// Where the fingertip's centre is when it takes the fruit, and the finger's direction there.
struct Reach {
  Vec3 tip, direction;
};

Vec3 direction_at(const Vec3& tip) {
  const Vec3 joints = reaching(tip, tip.z(), 1.0);
  return {std::cos(joints[0] + joints[1]), std::sin(joints[0] + joints[1]), 0.0};
}

Reach reach_of(const Setting& s) {
  const Truss& truss = *s.truss;
  const Vec3 fruit = s.root + Vec3(0.0, 0.0, truss.from) + truss.length * truss.direction;
  const double apart = truss.fruit_radius + finger_radius + gap;
  Reach reach{fruit, direction_at(fruit)};
  // The finger's direction depends on where its tip is, and hardly.
  for (int again = 0; again < 5; ++again) {
    reach.tip =
        fruit - std::sqrt(apart * apart - below * below) * reach.direction - Vec3(0.0, 0.0, below);
    reach.direction = direction_at(reach.tip);
  }
  return reach;
}

}  // namespace

void make_harvest(Setting& s) {
  std::mt19937_64 random(s.seed * 6151 + 5);
  const auto between = [&](double low, double high) {
    return low + (high - low) * std::uniform_real_distribution<double>()(random);
  };
  // Of whole elements, on every mesh: the truss begins at a node.
  s.height = 0.42;
  s.radius = between(0.0053, 0.0058);
  s.modulus = between(5.0e8, 7.0e8);
  s.root = {between(0.455, 0.465), between(-0.005, 0.005), 0.0};
  Truss truss;
  truss.direction = Vec3(0.9, between(0.05, 0.15), between(-0.35, -0.25)).normalized();
  truss.radius = between(0.0017, 0.0019);
  truss.fruit_radius = between(0.013, 0.015);
  truss.strength = between(2.2, 2.6);
  s.truss = truss;
}

std::vector<Drive> harvest_drives(const Setting& s) {
  const Reach reach = reach_of(s);
  // m, of the fingertip from where it takes the fruit.
  const auto tip = [&](double x, double y, double z) {
    const Vec3 place = reach.tip + Vec3(x, y, z);
    return reaching(place, place.z(), 1.0);
  };
  const Vec3 in = -way_in * reach.direction;
  const Vec3 clear = tip(in.x(), in.y(), in.z()), at = tip(0, 0, 0);
  std::vector<Drive> all;
  all.push_back({"pull_down",
                 3.2,
                 {0.2, 0.9, pull, 1.6, 2.3, 2.5, 3.0},
                 {clear, at, at, tip(0, 0.03, 0), tip(0, 0.035, -0.05), tip(0, 0.035, -0.05),
                  tip(0, -0.01, -0.05)},
                 taken});
  all.push_back({"pull_back",
                 3.0,
                 {0.2, 0.9, pull, 1.5, 2.1, 2.3, 2.8},
                 {clear, at, at, tip(0, 0.025, 0), tip(-0.05, 0.025, -0.03),
                  tip(-0.05, 0.025, -0.03), tip(-0.05, -0.015, -0.03)},
                 taken,
                 true});
  all.push_back({"pull_out",
                 3.2,
                 {0.2, 0.9, pull, 1.7, 2.4, 2.6, 3.0},
                 {clear, at, at, tip(0, 0.035, -0.005), tip(0.035, 0.035, -0.03),
                  tip(0.035, 0.035, -0.03), tip(0.02, -0.01, -0.03)},
                 taken});
  all.resize(static_cast<std::size_t>(std::clamp(s.trials, 1, 3)));
  return all;
}

}  // namespace pedicel::scene_case
