// From a motion that is known to what the instruments report.
#include "plugins/discrepancy/simulate/observation.h"

#include <gtest/gtest.h>

#include "plugins/cosserat/model/rotation.h"
#include "tests/unit/discrepancy/beam_experiment.h"

namespace pedicel::discrepancy {
namespace {

using testing::effect;
using testing::on_stem;

const std::vector<Marker> one_marker = {{"m", on_stem(1.0)}};

// A cubic in time, whose element turns about z at 1 rad/s; unequal steps.
Vec3 position(double t) {
  return {1.0 + t, 2.0 * t * t, t * t * t - t};
}
Vec3 velocity(double t) {
  return {1.0, 4.0 * t, 3.0 * t * t - 1.0};
}

Motion cubic_motion() {
  Motion motion;
  motion.time = {0.0, 0.4, 0.7, 1.0};
  motion.position.resize(4, 3);
  motion.velocity.resize(4, 3);
  motion.turn.resize(4, 4);
  for (int k = 0; k < 4; ++k) {
    motion.position.row(k) = position(motion.time[k]).transpose();
    motion.velocity.row(k) = velocity(motion.time[k]).transpose();
    motion.turn.row(k) = cosserat::exp_map(Vec3(0, 0, motion.time[k])).coeffs().transpose();
  }
  // A force that rises with time and jumps to zero at 0.7.
  motion.force_time = {0.0, 0.4, 0.7, 0.7, 1.0};
  motion.force.resize(5, 3);
  for (int k = 0; k < 5; ++k)
    motion.force.row(k) =
        k < 3 ? Vec3(motion.force_time[k], 1, 0).transpose() : Vec3(0, 0, 0).transpose();
  return motion;
}

Observed seen(const std::vector<plant::Effect>& effects, const std::vector<double>& at) {
  return observe(cubic_motion(), one_marker, effects, at, at);
}

Vec3 marker(const Observed& observed, int sample = 0) {
  return observed.markers.row(sample).transpose();
}

TEST(Observation, InterpolatesCubicsExactly) {
  const std::vector<double> at = {0.0, 0.1, 0.4, 0.55, 0.9, 1.0};
  const Observed observed = seen({}, at);
  for (int s = 0; s < 6; ++s) {
    EXPECT_LT((marker(observed, s) - position(at[s])).norm(), 1e-14) << s;
    EXPECT_LT((observed.marker_velocity.row(s).transpose() - velocity(at[s])).norm(), 1e-13) << s;
  }
}

TEST(Observation, NothingIsKnownBeyondTheEnd) {
  const Observed observed = seen({}, {1.01});
  EXPECT_TRUE(observed.markers.array().isNaN().all());
  EXPECT_TRUE(observed.force.array().isNaN().all());
}

TEST(Observation, LatencyLooksBackAndRestsBeforeTimeZero) {
  const Observed observed = seen({effect("latency", "delay", {0.07})}, {0.05, 0.62});
  EXPECT_LT((marker(observed, 0) - position(0.0)).norm(), 1e-14);
  EXPECT_LT((marker(observed, 1) - position(0.55)).norm(), 1e-14);
  // The force and the plant's own velocity are not late.
  EXPECT_NEAR(observed.force(1, 0), 0.62, 1e-14);
  EXPECT_LT((observed.marker_velocity.row(1).transpose() - velocity(0.62)).norm(), 1e-13);
}

TEST(Observation, AnOffsetTurnsWithItsElementAndIsLateToo) {
  plant::Effect offset = effect("marker_offset", "offset", {0.1, 0.0, 0.0});
  offset.words["marker"] = "m";
  const Vec3 turned(0.1 * std::cos(0.55), 0.1 * std::sin(0.55), 0.0);
  EXPECT_LT((marker(seen({offset}, {0.55})) - position(0.55) - turned).norm(), 1e-14);
  const Observed late = seen({offset, effect("latency", "delay", {0.2})}, {0.75});
  EXPECT_LT((marker(late) - position(0.55) - turned).norm(), 1e-14);
  offset.words["marker"] = "another";
  EXPECT_LT((marker(seen({offset}, {0.55})) - position(0.55)).norm(), 1e-14);
}

TEST(Observation, FrameAndScaleActAboutTheWorldsOrigin) {
  const Observed turned = seen({effect("frame_rotation", "rotation", {0, 0, M_PI / 2})}, {0.4});
  const Vec3 p = position(0.4);
  EXPECT_LT((marker(turned) - Vec3(-p.y(), p.x(), p.z())).norm(), 1e-14);
  EXPECT_LT((marker(seen({effect("marker_scale", "factor", {1.5})}, {0.4})) - 1.5 * p).norm(),
            1e-14);
}

TEST(Observation, ForceJumpsAtItsTimeAndPassesThroughTheGain) {
  plant::Effect gain = effect("force_gain", "gain", {2.0});
  gain.numbers["offset"] = {0.0, 0.0, 3.0};
  const Observed observed = seen({gain}, {0.2, 0.7 - 1.0e-12, 0.7, 0.8});
  EXPECT_LT((observed.force.row(0) - Eigen::RowVector3d(0.4, 2, 3)).norm(), 1e-14);
  EXPECT_LT((observed.force.row(1) - Eigen::RowVector3d(1.4, 2, 3)).norm(), 1e-9);
  EXPECT_LT((observed.force.row(2) - Eigen::RowVector3d(0, 0, 3)).norm(), 1e-14);
  EXPECT_LT((observed.force.row(3) - Eigen::RowVector3d(0, 0, 3)).norm(), 1e-14);
}

plant::Effect lag(const std::string& what, double time) {
  plant::Effect made = effect("sensor_lag", "time", {time});
  made.words["what"] = what;
  return made;
}

// y' = (x - y)/T with x a cubic from time 0 on and y(0) = x(0) is a cubic p, which takes T times
// the next derivative off each, and what is left of the start: y = p + (x(0) - p(0)) exp(-t/T).
Vec3 lagging(double t, double time) {
  const auto particular = [&](double s) {
    return Vec3(position(s) - time * velocity(s) + time * time * Vec3(0, 4, 6 * s) -
                time * time * time * Vec3(0, 0, 6));
  };
  return particular(t) + std::exp(-t / time) * (position(0.0) - particular(0.0));
}

TEST(Observation, MarkersThatLagFollowTheEquation) {
  const std::vector<double> at = {0.0, 0.1, 0.4, 0.55, 0.9, 1.0};
  for (const double time : {1.0e-6, 0.02, 0.3, 40.0}) {
    const Observed observed = seen({lag("markers", time)}, at);
    for (int s = 0; s < 6; ++s)
      EXPECT_LT((marker(observed, s) - lagging(at[s], time)).norm(), time > 1.0 ? 1e-9 : 1e-13)
          << s << ", " << time;
    EXPECT_NEAR(observed.force(1, 0), 0.1, 1e-14);  // the force does not lag
  }
}

TEST(Observation, LagsAddUpAndNoLagChangesNothing) {
  const std::vector<double> at = {0.05, 0.62};
  const Observed plain = seen({}, at);
  EXPECT_EQ(seen({lag("markers", 0.0), lag("force", 0.0)}, at).markers, plain.markers);
  EXPECT_EQ(seen({lag("markers", 0.0), lag("force", 0.0)}, at).force, plain.force);
  const Observed two = seen({lag("markers", 0.1), lag("markers", 0.2)}, at);
  EXPECT_LT((marker(two, 1) - lagging(0.62, 0.3)).norm(), 1e-13);
  // A lag that is late, too: the same, later; before time 0 it rests.
  const Observed late = seen({lag("markers", 0.3), effect("latency", "delay", {0.07})}, at);
  EXPECT_LT((marker(late, 0) - position(0.0)).norm(), 1e-14);
  EXPECT_LT((marker(late, 1) - lagging(0.55, 0.3)).norm(), 1e-13);
}

// The force rises evenly from 0 to 0.7 in x, is 1 in y, and is let go: y = t - T (1 - exp(-t/T)) on
// the way up, and what it had reached dies away after the jump.
TEST(Observation, AForceThatLagsDiesAwayAfterTheRelease) {
  constexpr double time = 0.15;
  plant::Effect gain = effect("force_gain", "gain", {2.0});
  const auto rising = [&](double t) { return t - time * (1.0 - std::exp(-t / time)); };
  const Observed observed = seen({lag("force", time), gain}, {0.0, 0.3, 0.7, 0.8, 1.0});
  EXPECT_LT((observed.force.row(0) - Eigen::RowVector3d(0, 2, 0)).norm(), 1e-14);
  EXPECT_LT((observed.force.row(1) - 2.0 * Eigen::RowVector3d(rising(0.3), 1, 0)).norm(), 1e-14);
  for (const int s : {2, 3, 4}) {
    const double left = std::exp(-(s == 2 ? 0.0 : s == 3 ? 0.1 : 0.3) / time);
    EXPECT_LT((observed.force.row(s) - 2.0 * left * Eigen::RowVector3d(rising(0.7), 1, 0)).norm(),
              1e-13)
        << s;
  }
  EXPECT_LT((marker(observed, 1) - position(0.3)).norm(), 1e-14);  // the markers do not lag
}

// A marker that sits aside of its place and lags: the offset turns at 1 rad/s, for which rows this
// wide are coarse; its steady lag is T times its velocity.
TEST(Observation, AnOffsetLagsToo) {
  plant::Effect offset = effect("marker_offset", "offset", {0.1, 0.0, 0.0});
  offset.words["marker"] = "m";
  constexpr double time = 0.01;
  const Vec3 turned(0.1 * std::cos(0.9), 0.1 * std::sin(0.9), 0.0);
  const Vec3 rate(-turned.y(), turned.x(), 0.0);
  const Vec3 found = marker(seen({offset, lag("markers", time)}, {0.9}));
  EXPECT_LT((found - lagging(0.9, time) - turned + time * rate).norm(), 2e-4);
  EXPECT_GT((time * rate).norm(), 9e-4);
}

}  // namespace
}  // namespace pedicel::discrepancy
