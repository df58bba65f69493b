// Energy and momentum of an undamped rod that swings from the horizontal under gravity.
#include <gtest/gtest.h>

#include "analytic/rod_cases.h"

namespace pedicel::cosserat::cases {
namespace {

// Linear momentum, exactly as the scheme has it: BDF2 says
//   (3 P(n+1) - 4 P(n) + P(n-1)) / (2 dt) = M g - R(n+1),
// with R the force of the root segment on the rest, the only force from outside besides weight:
// all other joint forces cancel in pairs. The tolerance is Newton's: 1e-6 of the weight.
TEST(RodBalance, MomentumChangesByWeightAndTheRootsForce) {
  Simulation sim(PeerCantilever::model(12), settings_with(Integrator::bdf2));
  const double dt = 1.0 / 240.0;
  double mass = 0.0;
  for (const Element& element : sim.model.elements) mass += element.mass;
  const auto momentum = [&] {
    Vec3 sum = Vec3::Zero();
    for (int e = 0; e < sim.model.size(); ++e)
      sum += sim.model.elements[e].mass * sim.state.velocity[e];
    return sum;
  };
  Vec3 before = momentum();
  sim.step(dt, gravity);
  Vec3 now = momentum();
  for (int i = 0; i < 240; ++i) {
    sim.step(dt, gravity);
    const Vec3 next = momentum();
    const Vec3 rate = (3.0 * next - 4.0 * now + before) / (2.0 * dt);
    const Vec3 root = sim.state.orientation[0] * joint_load(sim.model, sim.state, 0).force;
    ASSERT_LT((rate - mass * gravity + root).norm(), 1e-6 * mass * 9.81) << "step " << i;
    before = now;
    now = next;
  }
}

struct Loss {
  double largest_gain, lost;  // share of the energy that moves (the fall to the settled shape)
};

Loss swing(double dt) {
  RodState settled = drawn_state(PeerCantilever::model(10));
  settle(PeerCantilever::model(10), settled, gravity);
  Simulation sim(PeerCantilever::model(10), settings_with(Integrator::bdf2));
  const double start = energy_of(sim.model, sim.state, gravity).total();
  const double scale = start - energy_of(sim.model, settled, gravity).total();
  double lowest = start, gain = 0.0;
  while (sim.state.time < 2.0) {
    sim.step(dt, gravity);
    const double total = energy_of(sim.model, sim.state, gravity).total();
    gain = std::max(gain, total - lowest);
    lowest = std::min(lowest, total);
  }
  return {gain / scale, (start - energy_of(sim.model, sim.state, gravity).total()) / scale};
}

// BDF2 damps a mode by y^3/4 (y = omega dt): the first hardly, those it cannot resolve strongly. So
// the sudden start's higher modes are lost and the swing stays: less than 2 % in 2 s at 1/240 s,
// and a fraction of that with a smaller step. Energy never grows beyond the ripple that comes with
// the scheme's O(y^2) error of a mode's energy in the course of a period.
TEST(RodBalance, EnergyOfAnUndampedSwing) {
  const Loss coarse = swing(1.0 / 240.0), fine = swing(1.0 / 960.0);
  RecordProperty("lost_240", std::to_string(coarse.lost));
  RecordProperty("lost_960", std::to_string(fine.lost));
  EXPECT_LT(coarse.lost, 0.02);
  EXPECT_GT(fine.lost, 0.0);
  EXPECT_LT(fine.lost, 0.3 * coarse.lost);
  EXPECT_LT(fine.largest_gain, 0.002);
}

}  // namespace
}  // namespace pedicel::cosserat::cases
