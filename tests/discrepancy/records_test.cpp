// Records as people make them, against beam theory (Euler-Bernoulli, small deflections; shear adds
// less than 1e-3 at this slenderness) and against the reference simulator.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/core/random.h"
#include "plugins/discrepancy/data/path_smoothing.h"
#include "plugins/discrepancy/simulate/data_set.h"
#include "tests/discrepancy/reference_trial.h"
#include "tests/unit/discrepancy/beam_experiment.h"

namespace pedicel::discrepancy {
namespace {

using testing::Beam;
using testing::effect;
using testing::experiment_of;
using testing::on_stem;

Prediction predict(const Experiment& experiment, const Variant& variant = {},
                   const Numerics& numerics = {0.02, 1.0 / 480}) {
  Simulator simulator(experiment, numerics, 1);
  const Simulator::Request request{&variant, 0};
  return simulator.run({&request, 1}).front();
}

// Cantilever modes: b L of the first two, and their shapes with 1 at the tip.
constexpr double mode_numbers[] = {1.875104069, 4.694091133};

double mode_shape(int mode, double share) {
  const double b = mode_numbers[mode];
  const double c = (std::cosh(b) + std::cos(b)) / (std::sinh(b) + std::sin(b));
  const auto w = [&](double x) {
    return std::cosh(b * x) - std::cos(b * x) - c * (std::sinh(b * x) - std::sin(b * x));
  };
  return w(share) / w(1.0);
}

double mode_frequency(const Beam& beam, int mode) {
  return std::pow(mode_numbers[mode] / beam.length, 2) *
         std::sqrt(beam.stiffness() / beam.mass_per_length());
}

/// A beam that swings in its first two modes, each with a phase of its own, across two axes.
Experiment swinging(const Beam& beam) {
  Experiment experiment = experiment_of(beam, 0.6, 0.005);
  experiment.markers = {{"low", on_stem(0.3)}, {"middle", on_stem(0.65)}, {"tip", on_stem(1.0)}};
  experiment.noise.position_std = 1.0e-6;
  Trial& trial = experiment.trials[0];
  trial.window = 0.15;
  trial.force = {};
  trial.markers.value.setZero(trial.markers.size(), 9);
  for (int s = 0; s < trial.markers.size(); ++s) {
    const double t = trial.markers.time[s];
    const double first = mode_frequency(beam, 0) * t, second = mode_frequency(beam, 1) * t;
    for (int m = 0; m < 3; ++m) {
      const double at = experiment.markers[m].place.at;
      trial.markers.value(s, 3 * m) = 2.0e-3 * mode_shape(0, at) * std::cos(first + 0.7) +
                                      1.0e-4 * mode_shape(1, at) * std::sin(second);
      trial.markers.value(s, 3 * m + 1) = 1.0e-3 * mode_shape(0, at) * std::sin(first - 0.4);
      trial.markers.value(s, 3 * m + 2) = at * beam.length;
    }
  }
  return experiment;
}

// Three periods on, the mesh of 20 segments is ahead by 0.3 % of a period: 4 % of the amplitude.
TEST(MovingStart, FindsPlaceAndSpeedOfTwoModes) {
  const Beam beam;
  const Experiment experiment = swinging(beam);
  Simulator simulator(experiment, {0.02, 1.0 / 1920}, 1);
  EXPECT_GE(simulator.start_amplitudes(0), 8);  // two modes in two directions
  const Prediction found = predict(experiment, {}, {0.02, 1.0 / 1920});
  ASSERT_TRUE(found.healthy);
  for (int s = 0; s < found.markers.rows(); ++s)
    for (int c = 6; c < 8; ++c)
      EXPECT_NEAR(found.markers(s, c), experiment.trials[0].markers.value(s, c),
                  s <= 30 ? 2.0e-5 : 1.2e-4)
          << s << " " << c;
}

// What the instruments do comes on top: a marker that sits aside is not a plant that is bent, and
// one that is late saw the plant before the record began.
TEST(MovingStart, LooksThroughTheInstruments) {
  const Experiment plain = swinging({});
  Experiment seen = plain;
  Variant variant;
  variant.effects = {effect("marker_offset", "offset", {0.01, 0.0, 0.0}),
                     effect("latency", "delay", {0.01})};
  variant.effects[0].words["marker"] = "tip";
  Trial& trial = seen.trials[0];
  // Two samples late, of which the first are those before the record.
  const Prediction full = predict(plain, {}, {0.02, 1.0 / 1920});
  for (int s = 2; s < trial.markers.size(); ++s) {
    trial.markers.value.row(s) = full.markers.row(s - 2);
    trial.markers.value(s, 6) += 0.01;
  }
  trial.markers.value.topRows(2).setConstant(NAN);
  const Prediction found = predict(seen, variant, {0.02, 1.0 / 1920});
  for (int s = 2; s < trial.markers.size(); ++s)
    for (const int c : {0, 1, 3, 4, 6, 7})  // what sits aside turns with the tip, and so goes down
      EXPECT_NEAR(found.markers(s, c), trial.markers.value(s, c), 1.0e-5) << s << " " << c;
}

// A stem that leans and carries a weight, led aside by a third of its length and let go, by another
// solver; the record begins in mid swing.
TEST(MovingStart, FollowsALargeSwingOfAnotherSolver) {
  Experiment experiment = experiment_of({0.4, 0.003, 2.0e8, 800.0, 0.01}, 1.5, 0.01);
  plant::PlantFile& plant = experiment.plant();
  plant.curves[0].points = {Vec3(0, 0, 0), Vec3(0.05, 0, 0.2), Vec3(0.12, 0, 0.38)};
  experiment.markers = {{"a", on_stem(0.3)}, {"b", on_stem(0.6)}, {"c", on_stem(1.0)}};
  reference::TrialPlan plan;
  plan.duration = 2.0;
  plan.interval = 0.01;
  const reference::Subject subject{plant, {}, {}};
  const Vec3 tip = reference::settled_point(subject, plan, on_stem(1.0), {0.01, 0.002});
  reference::HoldPlan hold;
  hold.place = on_stem(1.0);
  hold.stiffness = 50.0;
  for (int i = 0; i <= 20; ++i) {
    hold.path.time.push_back(0.01 * i);
    hold.path.position.push_back(tip + 0.1 * (0.05 * i) * Vec3(0.3, 1.0, -0.2));
  }
  hold.release = 0.2;
  plan.holds = {hold};
  std::vector<reference::MarkerPlan> markers;
  for (const Marker& marker : experiment.markers) markers.push_back({marker.name, marker.place});
  const reference::Record record = reference::run_trial(subject, plan, markers, {0.01, 0.001});
  constexpr int cut = 50;  // 0.3 s after the release
  Trial& trial = experiment.trials[0];
  trial.gravity = Vec3(0, 0, -9.81);
  trial.force = {};
  trial.window = 0.2;
  trial.markers.value = record.markers.middleRows(cut, trial.markers.size());
  experiment.noise.position_std = 1.0e-5;
  const Prediction found = predict(experiment, {}, {0.01, 1.0 / 1920});
  ASSERT_TRUE(found.healthy);
  const Eigen::MatrixXd& measured = trial.markers.value;
  const double swing = std::sqrt((measured.rowwise() - measured.colwise().mean()).squaredNorm() /
                                 static_cast<double>(measured.size()));
  const double off =
      std::sqrt((found.markers - measured).squaredNorm() / static_cast<double>(measured.size()));
  EXPECT_GT(swing, 0.008);
  EXPECT_LT(off, 0.03 * swing);
  EXPECT_LT((found.markers.topRows(20) - measured.topRows(20)).cwiseAbs().maxCoeff(), 0.02 * swing);
}

// Led along one axis, a beam's tip goes where a force along it takes it; along a rigid hold's path
// it would be stretched besides.
TEST(Guides, APointSlidesAcrossItsAxis) {
  const Beam beam;
  constexpr double offset = 0.02;
  for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0.6, 0.8, 0)}) {
    Experiment experiment = experiment_of(beam, 0.1);
    Hold hold{on_stem(1.0),
              testing::resting_at(Vec3(0, 0, beam.length) + offset * axis + Vec3(0, 0, 0.3)),
              {},
              {}};
    hold.release = INFINITY;
    hold.axes = {axis};
    experiment.trials[0].holds = {hold};
    const Prediction found = predict(experiment);
    ASSERT_TRUE(found.healthy);
    for (const int s : {0, 10}) {
      const Vec3 tip = found.markers.row(s).tail<3>().transpose();
      const Vec3 force = found.force.row(s).transpose();
      EXPECT_NEAR(axis.dot(tip), offset, 1e-6);
      EXPECT_LT(Vec3(tip - axis.dot(tip) * axis - tip.z() * Vec3::UnitZ()).norm(), 1e-6);
      // The tip comes down by 3/5 offset^2 / L.
      EXPECT_NEAR(beam.length - tip.z(), 0.6 * offset * offset / beam.length, 2e-5);
      EXPECT_NEAR(force.dot(axis) / (beam.tip_stiffness() * offset), 1.0, 1e-2);
      EXPECT_LT(Vec3(force - force.dot(axis) * axis).norm(), 1e-9);
    }
  }
}

TEST(Guides, TwoAxesOrAStatedStiffness) {
  const Beam beam;
  Experiment experiment = experiment_of(beam, 0.05);
  Hold hold{on_stem(1.0), testing::resting_at(Vec3(0.004, 0.003, 0.3)), INFINITY, 20.0};
  hold.axes = {Vec3::UnitX(), Vec3::UnitY()};
  experiment.trials[0].holds = {hold};
  const Prediction found = predict(experiment);
  const double series = 1.0 / (1.0 / 20.0 + 1.0 / beam.tip_stiffness());
  EXPECT_NEAR(found.force(0, 0) / (0.004 * series), 1.0, 5e-3);
  EXPECT_NEAR(found.force(0, 1) / (0.003 * series), 1.0, 5e-3);
  EXPECT_EQ(found.force(0, 2), 0.0);
}

// A pusher comes from 10 mm away, pushes the tip aside by 20 mm and goes back: it pulls at no time.
TEST(Guides, APusherOnlyPushes) {
  Beam beam;
  beam.damping_time = 0.02;
  Experiment experiment = experiment_of(beam, 6.0, 0.02);
  DrivenPath path;
  for (int i = 0; i <= 300; ++i) {
    const double t = 0.02 * i;
    path.time.push_back(t);
    path.position.emplace_back(-0.01 + 0.03 * (0.5 - 0.5 * std::cos(2.0 * M_PI * t / 6.0)), 0.0,
                               beam.length);
  }
  Hold hold{on_stem(1.0), path, INFINITY, {}};
  hold.axes = {Vec3::UnitX()};
  hold.one_sided = true;
  experiment.trials[0].holds = {hold};
  const Prediction found = predict(experiment);
  ASSERT_TRUE(found.healthy);
  EXPECT_NEAR(found.markers(0, 3), 0.0, 1e-6);
  EXPECT_GE(found.force.col(0).minCoeff(), 0.0);
  for (int s = 0; s <= 300; ++s) {
    const double led = path.position[s].x();
    // Pushed slowly, the tip is at the pusher; left by it, it swings little about where it rests.
    if (std::abs(led) > 1.5e-3) {
      EXPECT_NEAR(found.markers(s, 3), std::max(0.0, led), 1e-3) << s;
    }
    if (led < -1.5e-3) {
      EXPECT_EQ(found.force(s, 0), 0.0) << s;
    }
  }
  EXPECT_NEAR(found.force(150, 0) / (beam.tip_stiffness() * 0.02), 1.0, 2e-2);
}

// Turned about its own axis by the path and tilted: a hold that leads the direction follows the
// tilt alone. A marker that sits aside shows the twist.
TEST(Guides, ADirectionLeavesTheTwistFree) {
  const Beam beam;
  Experiment experiment = experiment_of(beam, 0.05);
  const Quat tilt(Eigen::AngleAxisd(0.1, Vec3::UnitY()));
  const Quat twist(Eigen::AngleAxisd(0.5, Vec3::UnitZ()));
  Hold hold{on_stem(1.0), testing::resting_at(Vec3(0.02, 0, beam.length)), INFINITY, 200.0};
  hold.path.rotation = {tilt * twist};
  plant::Effect aside = effect("marker_offset", "offset", {0.01, 0.0, 0.0});
  aside.words["marker"] = "tip";
  const auto arm = [&](bool direction) -> Vec3 {
    hold.direction = direction;
    experiment.trials[0].holds = {hold};
    const Variant with{{aside}, {}};
    return (predict(experiment, with).markers - predict(experiment).markers)
               .row(0)
               .tail<3>()
               .transpose() /
           0.01;
  };
  const Vec3 led = arm(true), held = arm(false);
  EXPECT_NEAR(std::atan2(led.y(), led.x()), 0.0, 0.02);
  EXPECT_NEAR(std::atan2(held.y(), held.x()), 0.5, 0.05);
  EXPECT_NEAR(led.z(), -std::sin(0.1), 0.02);  // tilted, though
}

// Weight, the moment of a load and of a hung mass.
TEST(RootWrench, CarriesWhatHangsOnThePlant) {
  const Beam beam;
  Experiment experiment = experiment_of(beam, 0.1);
  Trial& trial = experiment.trials[0];
  trial.gravity = Vec3(0, 0, -9.81);
  trial.masses = {{on_stem(0.5), 0.004}};
  trial.loads = {{on_stem(1.0), Vec3(0.01, -0.02, 0), {}, {}}};
  trial.loads[0].from = -1.0;
  trial.loads[0].to = INFINITY;
  trial.wrench = testing::empty_samples(0.1, 0.02, 6);
  const Prediction found = predict(experiment);
  const double weight = 9.81 * (beam.mass_per_length() * beam.length + 0.004);
  const Vec3 tip = found.markers.row(0).tail<3>().transpose();
  for (int s = 0; s < 6; ++s) {
    EXPECT_NEAR(found.wrench(s, 0), -0.01, 1e-5);
    EXPECT_NEAR(found.wrench(s, 1), 0.02, 1e-5);
    EXPECT_NEAR(found.wrench(s, 2), weight, 1e-5);
    // About the root: minus r x F of the load and of what it leads aside, the mass that hangs at
    // the middle marker and the stem, whose centre goes 3/8 of the tip's way.
    const Vec3 down(0, 0, -9.81), middle = found.markers.row(0).head<3>().transpose();
    const Vec3 sum = tip.cross(Vec3(0.01, -0.02, 0)) + middle.cross(0.004 * down) +
                     (0.375 * tip).cross(beam.mass_per_length() * beam.length * down);
    EXPECT_NEAR(found.wrench(s, 3) / -sum.x(), 1.0, 0.01);
    EXPECT_NEAR(found.wrench(s, 4) / -sum.y(), 1.0, 0.01);
    EXPECT_NEAR(found.wrench(s, 5), -sum.z(), 1e-6);
  }
}

// A root that is shaken slowly (pi rad/s): mass times acceleration, with half the length for an
// arm. What rings from the start, at w1 = 33 rad/s, is pi / w1 of that and dies out.
TEST(RootWrench, CarriesTheInertiaOfThePlant) {
  const Beam beam;
  Experiment experiment = experiment_of(beam, 2.0, 0.05);
  Trial& trial = experiment.trials[0];
  DrivenPath base;
  const auto way = [](double t) { return 0.02 * (t - std::sin(M_PI * t) / M_PI); };
  for (int i = 0; i <= 2000; ++i) {
    base.time.push_back(0.001 * i);
    base.position.emplace_back(way(0.001 * i), 0.0, 0.0);
  }
  trial.base = base;
  trial.wrench = testing::empty_samples(2.0, 0.05, 6);
  experiment.plant().material.damping_time = 0.02;
  const Prediction found = predict(experiment, {}, {0.02, 1.0 / 1000});
  const double mass = beam.mass_per_length() * beam.length;
  for (int s = 10; s <= 30; ++s) {
    const double acceleration = 0.02 * M_PI * std::sin(M_PI * 0.05 * s);
    EXPECT_NEAR(found.wrench(s, 0), mass * acceleration, 0.08 * mass * 0.02 * M_PI) << s;
    EXPECT_NEAR(found.wrench(s, 4), 0.5 * beam.length * mass * acceleration,
                0.08 * 0.5 * beam.length * mass * 0.02 * M_PI)
        << s;
  }
}

// Let go, a plant swings from rest to rest: what carries it gives no impulse in all. Without the
// part of the damping that would be -2 zeta of what the first mode held, 5 % of a swing's.
TEST(RootWrench, GivesNoImpulseFromRestToRest) {
  Beam beam;
  beam.damping_time = 0.02;
  Experiment experiment = experiment_of(beam, 3.0, 1.0 / 480);
  Trial& trial = experiment.trials[0];
  trial.loads = {{on_stem(1.0), Vec3(0.01, 0, 0), -1.0, 0.5}};
  trial.wrench = testing::empty_samples(3.0, 1.0 / 480, 6);
  const Prediction found = predict(experiment);
  double impulse = 0.0, size = 0.0;
  for (Eigen::Index s = 241; s < found.wrench.rows(); ++s) {  // 0.5 s is sample 240
    impulse += found.wrench(s, 4) / 480.0;
    size += std::abs(found.wrench(s, 4)) / 480.0;
  }
  EXPECT_GT(size, 1e-4);
  EXPECT_LT(std::abs(impulse), 0.01 * size);
}

// Three deflections, each in equilibrium, as three trials would have them.
TEST(StaticSeries, EachRowIsAnEquilibrium) {
  const Beam beam;
  Experiment series = experiment_of(beam, 2.0, 1.0);
  Trial& trial = series.trials[0];
  trial.is_static = true;
  trial.gravity = Vec3(0, 0, -9.81);
  trial.wrench = testing::empty_samples(2.0, 1.0, 6);
  DrivenPath path;
  for (int i = 0; i < 3; ++i) {
    path.time.push_back(i);
    path.position.emplace_back(0.01 * i * i, 0.005 * i, beam.length - 0.002 * i);
  }
  trial.holds = {{on_stem(1.0), path, INFINITY, 30.0}};
  const Prediction found = predict(series);
  ASSERT_TRUE(found.healthy);
  for (int i = 0; i < 3; ++i) {
    Experiment alone = experiment_of(beam, 0.0, 1.0);
    alone.trials[0].gravity = trial.gravity;
    alone.trials[0].wrench = testing::empty_samples(0.0, 1.0, 6);
    alone.trials[0].holds = {{on_stem(1.0), testing::resting_at(path.position[i]), INFINITY, 30.0}};
    const Prediction one = predict(alone);
    EXPECT_LT((found.markers.row(i) - one.markers.row(0)).norm(), 1e-7) << i;
    EXPECT_LT((found.force.row(i) - one.force.row(0)).norm(), 1e-6) << i;
    EXPECT_LT((found.wrench.row(i) - one.wrench.row(0)).norm(), 1e-6) << i;
  }
}

// A rigid hold takes its path's noise to the marker that sits there, half of its length up by the
// shape of a beam that is led at its tip (5/16), and to the force by the beam's stiffness;
// released, to none.
TEST(PathNoise, WidensWhatFollowsThePath) {
  const Beam beam;
  Experiment experiment = experiment_of(beam, 0.1);
  Trial& trial = experiment.trials[0];
  Hold hold{on_stem(1.0), testing::resting_at(Vec3(0, 0, beam.length)), 0.05, {}};
  hold.axes = {Vec3::UnitX()};
  trial.holds = {hold};
  experiment.noise.position_std = 1.0e-4;
  experiment.noise.force_std = 1.0e-3;
  constexpr double path_std = 3.0e-4;
  experiment.noise.path_std = path_std;
  DataSet data(experiment);
  data.set_noise(white_noise(1.0e-4), white_noise(1.0e-3));
  Prediction off;
  off.markers = trial.markers.value.array() - 1.0e-4;
  off.force = trial.force.value.array() - 1.0e-3;
  const Eigen::MatrixXd r = data.scaled_residual(0, off);
  const auto wide = [](double ratio) { return 1.0 / std::sqrt(1.0 + ratio * ratio); };
  EXPECT_NEAR(r(2, 3), wide(3.0), 1e-4);               // the tip's x
  EXPECT_NEAR(r(2, 0), wide(3.0 * 5.0 / 16.0), 5e-3);  // the middle's
  EXPECT_NEAR(r(2, 1), 1.0, 1e-6);                     // across
  EXPECT_NEAR(r(2, 6), wide(path_std * beam.tip_stiffness() / 1.0e-3), 5e-3);
  EXPECT_NEAR(r(8, 3), 1.0, 1e-9);  // let go
}

TEST(PathNoise, SmoothsWithinItself) {
  DrivenPath path;
  Random random(3);
  constexpr double noise = 5.0e-4;
  std::vector<double> truth;
  for (int i = 0; i <= 200; ++i) {
    const double t = 0.01 * i;
    truth.push_back(0.03 * std::sin(2.0 * t));
    path.time.push_back(t);
    path.position.emplace_back(truth.back() + noise * random.normal(), noise * random.normal(),
                               0.4 + noise * random.normal());
  }
  const DrivenPath smooth = smoothed(path, noise);
  double before = 0.0, after = 0.0, rough_before = 0.0, rough_after = 0.0;
  for (int i = 0; i <= 200; ++i) {
    before += std::pow(path.position[i].x() - truth[i], 2) / 201.0;
    after += std::pow(smooth.position[i].x() - truth[i], 2) / 201.0;
    if (i < 2) continue;
    const auto bend = [&](const DrivenPath& p) {
      return (p.position[i] - 2.0 * p.position[i - 1] + p.position[i - 2]).squaredNorm();
    };
    rough_before += bend(path);
    rough_after += bend(smooth);
  }
  EXPECT_LT(std::sqrt(after), 0.6 * std::sqrt(before));
  EXPECT_LT(rough_after, 1.0e-3 * rough_before);
}

}  // namespace
}  // namespace pedicel::discrepancy
