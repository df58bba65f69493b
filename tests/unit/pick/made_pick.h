#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "engine/core/random.h"
#include "plugins/discrepancy/pick/pick_record.h"

/// Picks with a known end, at a known moment. An arm's tip, a mass on a spring, is led away from a
/// fruit; between arm and gripper sits the sensor. The stalk and the branch are a spring. It breaks
/// at once, or the hand slides off, or both hold.
namespace pedicel::testing {

struct MadePick {
  enum class End { breaks, slips, holds };
  End end = End::breaks;
  double moment = 2.0;          ///< s, of the break or of the slip's beginning
  double force = 15.0;          ///< N, of the stalk at that moment
  double slip_time = 0.4;       ///< s, from the first to the last of the slip
  double slip_left = 0.1;       ///< share of the force that is left behind a slip
  double slide_before = 0.0;    ///< share of the force that is lost in a slide before the break
  double fruit = 0.15;          ///< kg
  double gripper = 1.0;         ///< kg, beyond the sensor
  double arm = 4.0;             ///< kg, moving with it
  double swing = 10.0;          ///< Hz, of the arm with the gripper
  double swing_damping = 0.08;  ///< of critical
  double turning = 0.5;         ///< N, by which the gripper's weight wanders while the wrist turns
  double noise = 0.05;          ///< N, standard deviation, white
  double cutoff = 60.0;         ///< Hz, of a low-pass of second order, quarter of critical off
  double step = 0.01;           ///< N, to which the sensor rounds
  double rate = 250.0;          ///< Hz
  double jitter = 0.1;          ///< of an interval
  double duration = 4.0;        ///< s
  std::uint64_t seed = 1;
};

/// The force of the stalk over time, N, without the arm's swing.
inline double stalk_force(const MadePick& p, double t) {
  const double begin = 0.5;
  const double pulled = std::max(0.0, t - begin) / (p.moment - begin);
  double force = p.force * std::pow(std::min(pulled, 1.0), 1.3);
  if (p.slide_before > 0.0) {
    const double slide = std::clamp((t - p.moment + 0.3) / 0.3, 0.0, 1.0);
    force *= 1.0 - p.slide_before * slide * slide;
  }
  if (t < p.moment || p.end == MadePick::End::holds) return force;
  if (p.end == MadePick::End::breaks) return 0.0;
  const double gone = std::clamp((t - p.moment) / p.slip_time, 0.0, 1.0);
  return force * (p.slip_left + (1.0 - p.slip_left) * (1.0 - gone));
}

/// Three axes in the sensor's frame, as a table would have them.
inline discrepancy::PickRecord make_pick(const MadePick& p) {
  constexpr double dt = 2e-4;  // s
  Random random(p.seed);
  const double omega = 2.0 * std::numbers::pi * p.swing, mass = p.arm + p.gripper;
  const double angle = random.uniform(0.0, 2.0 * std::numbers::pi), up = random.uniform(0.3, 1.0);
  const double side = std::sqrt(1.0 - up * up);
  const Eigen::Vector3d pull(side * std::cos(angle), side * std::sin(angle), up);
  const Eigen::Vector3d turn(random.normal(), random.normal(), random.normal());
  const double turning_speed = random.uniform(0.5, 1.5), begun = random.uniform(0.0, 6.0);
  discrepancy::PickRecord record;
  record.file = "made.csv";
  double x = 0.0, v = 0.0;  // m, m/s: the tip against where it is led
  Eigen::Vector3d low = Eigen::Vector3d::Zero(), rate = Eigen::Vector3d::Zero();
  const double wc = 2.0 * std::numbers::pi * p.cutoff;
  double next = 0.0;
  std::vector<Eigen::Vector3d> rows;
  bool first = true;
  for (double t = 0.0; t < p.duration; t += dt) {
    const double stalk = stalk_force(p, t);
    const double a = -stalk / mass - omega * omega * x - 2.0 * p.swing_damping * omega * v;
    v += dt * a;
    x += dt * v;
    const bool carried = p.end == MadePick::End::breaks && t >= p.moment;
    const double beyond = p.gripper + (carried ? p.fruit : 0.0);
    const double settled = 1.0 - std::exp(-std::max(0.0, t - p.moment) / 0.05);
    const Eigen::Vector3d weight =
        Eigen::Vector3d(0, 0, -9.81 * (p.gripper + (carried ? p.fruit * settled : 0.0))) +
        p.turning * std::sin(turning_speed * t + begun) * turn.normalized();
    const Eigen::Vector3d force = pull * (stalk + beyond * a) + weight;
    if (first) low = force;
    first = false;
    rate += dt * (wc * wc * (force - low) - 1.5 * wc * rate);
    low += dt * rate;
    if (t < next) continue;
    next += (1.0 + p.jitter * random.uniform(-1.0, 1.0)) / p.rate;
    Eigen::Vector3d row = low;
    for (int axis = 0; axis < 3; ++axis)
      row[axis] = p.step * std::round((row[axis] + p.noise * random.normal()) / p.step);
    rows.push_back(row);
    record.time.push_back(t);
  }
  record.force.resize(static_cast<Eigen::Index>(rows.size()), 3);
  for (std::size_t i = 0; i < rows.size(); ++i)
    record.force.row(static_cast<Eigen::Index>(i)) = rows[i].transpose();
  return record;
}

/// A pick as its seed has it: arms, sensors, fruits and grips as they are in practice.
inline MadePick drawn_pick(MadePick::End end, std::uint64_t seed) {
  Random random(seed * 977 + static_cast<std::uint64_t>(end));
  MadePick p;
  p.end = end;
  p.seed = seed;
  p.moment = random.uniform(1.5, 2.8);
  p.force = random.uniform(5.0, 30.0);
  p.slip_time = random.uniform(0.15, 0.8);
  p.slip_left = random.uniform(0.0, 0.35);
  p.slide_before = random.uniform() < 0.3 ? random.uniform(0.0, 0.4) : 0.0;
  p.fruit = random.uniform(0.02, 0.25);
  p.gripper = random.uniform(0.3, 1.5);
  p.arm = random.uniform(2.0, 8.0);
  p.swing = random.uniform(6.0, 15.0);
  p.swing_damping = random.uniform(0.03, 0.2);
  p.turning = random.uniform(0.0, 1.0);
  p.noise = random.uniform(0.01, 0.3);
  p.cutoff = random.uniform(20.0, 100.0);
  p.step = random.uniform() < 0.3 ? 0.1 : 0.01;
  p.rate = random.uniform(100.0, 500.0);
  return p;
}

}  // namespace pedicel::testing
