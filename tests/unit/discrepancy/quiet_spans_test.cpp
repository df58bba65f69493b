#include "plugins/discrepancy/data/quiet_spans.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "engine/core/random.h"

namespace pedicel::discrepancy {
namespace {

constexpr NoiseLevels levels{3.0e-4, 0.01, 1.0e-3};
using Motion1 = std::function<double(double)>;

// One marker that moves along x, at 100 Hz, with the stated noise.
Trial seen_trial(const Motion1& x, double duration = 4.0, double interval = 0.01) {
  Trial trial;
  trial.name = "one";
  Random random(3);
  const int count = static_cast<int>(std::lround(duration / interval)) + 1;
  trial.markers.value.resize(count, 3);
  for (int i = 0; i < count; ++i) {
    trial.markers.time.push_back(interval * i);
    for (int a = 0; a < 3; ++a)
      trial.markers.value(i, a) =
          0.4 + (a == 0 ? x(interval * i) : 0.0) + levels.position * random.normal();
  }
  return trial;
}

double total(const std::vector<TimeSpan>& spans) {
  double sum = 0.0;
  for (const TimeSpan& span : spans) sum += span.end - span.begin;
  return sum;
}

bool covers(const std::vector<TimeSpan>& spans, double t) {
  for (const TimeSpan& span : spans)
    if (t >= span.begin && t < span.end) return true;
  return false;
}

// 20 mm at 2 Hz that die out with 3 /s from 1 s on: below the noise 1.4 s later.
double ringing(double t) {
  return t < 1.0 ? 0.0 : 0.02 * std::exp(-3.0 * (t - 1.0)) * std::cos(4.0 * M_PI * (t - 1.0));
}

TEST(QuietSpans, WhereASwingHasDiedOutAndBeforeIt) {
  Trial trial = seen_trial(ringing);
  TimedLoad load;
  load.to = 1.0;
  trial.loads = {load};
  const std::vector<TimeSpan> spans = quiet_spans(trial, levels);
  for (const double t : {0.2, 0.5, 3.0, 3.9}) EXPECT_TRUE(covers(spans, t)) << t;
  for (const double t : {1.0, 1.3, 1.8}) EXPECT_FALSE(covers(spans, t)) << t;
}

TEST(QuietSpans, ASlowDriftIsQuietAndASlowSwingIsNot) {
  EXPECT_GT(total(quiet_spans(seen_trial([](double t) { return 0.002 * t; }), levels)), 3.5);
  const auto swing = [](double t) { return 0.03 * std::sin(3.0 * t); };
  EXPECT_TRUE(quiet_spans(seen_trial(swing), levels).empty());
}

// Nobody sees whether a plant moves between samples that are 0.1 s apart, or whose marker is
// hidden.
TEST(QuietSpans, WhatIsNotSeenIsNotQuiet) {
  const Motion1 still = [](double) { return 0.0; };
  EXPECT_TRUE(quiet_spans(seen_trial(still, 4.0, 0.1), levels).empty());
  Trial hidden = seen_trial(still);
  hidden.markers.value.middleRows(100, 150).setConstant(NAN);
  const std::vector<TimeSpan> spans = quiet_spans(hidden, levels);
  EXPECT_TRUE(covers(spans, 0.5));
  EXPECT_FALSE(covers(spans, 1.7));
}

// A path is known beyond the noise of markers, and so is a force.
TEST(QuietSpans, WhatDrivesThePlantMovesIt) {
  const Motion1 still = [](double) { return 0.0; };
  Trial led = seen_trial(still);
  Hold hold;
  hold.release = 3.0;
  for (int i = 0; i <= 300; ++i) {
    hold.path.time.push_back(0.01 * i);
    hold.path.position.emplace_back(i < 100 ? 0.0 : 3.0e-4 * std::sin(0.2 * i), 0.0, 0.3);
  }
  led.holds = {hold};
  const std::vector<TimeSpan> spans = quiet_spans(led, levels);
  EXPECT_TRUE(covers(spans, 0.3));
  EXPECT_FALSE(covers(spans, 2.0));
  EXPECT_TRUE(covers(spans, 3.5));
  Trial pulled = seen_trial(still);
  pulled.force.time = pulled.markers.time;
  pulled.force.value.setZero(pulled.force.size(), 3);
  for (int i = 200; i < pulled.force.size(); ++i)
    pulled.force.value(i, 2) = 0.05 * std::sin(0.3 * i);
  EXPECT_TRUE(covers(quiet_spans(pulled, levels), 0.8));
  EXPECT_FALSE(covers(quiet_spans(pulled, levels), 3.0));
}

TEST(QuietSpans, NoneWhereFruitsComeOffOrThePlantIsTurned) {
  const Motion1 still = [](double) { return 0.0; };
  Trial breaks = seen_trial(still);
  breaks.events.push_back({2.0, "detached", "fruit"});
  EXPECT_TRUE(quiet_spans(breaks, levels).empty());
  Trial turned = seen_trial(still);
  DrivenPath base;
  base.time = {0.0, 4.0};
  base.position = {Vec3::Zero(), Vec3::Zero()};
  base.rotation = {Quat::Identity(), Quat(Eigen::AngleAxisd(0.1, Vec3::UnitX()))};
  turned.base = base;
  EXPECT_TRUE(quiet_spans(turned, levels).empty());
}

}  // namespace
}  // namespace pedicel::discrepancy
