// Mistakes of a day in a laboratory: each must be told with its file and its likely cause, and what
// known effects explain must not be.
#include "discrepancy/contradiction.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "discrepancy/admission.h"
#include "unit/discrepancy/laboratory.h"

namespace pedicel::discrepancy {
namespace {

using laboratory::change_points;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

struct Mistake {
  std::string name;
  std::function<void(Experiment&)> make;
  std::vector<std::string> said;  ///< the first is the file
};
std::ostream& operator<<(std::ostream& out, const Mistake& mistake) {
  return out << mistake.name;
}

std::function<void(Experiment&)> in(int trial, const std::function<void(Trial&)>& change) {
  return [=](Experiment& experiment) { change(experiment.trials[trial]); };
}
std::function<void(Experiment&)> in_all(const std::function<void(Trial&)>& change) {
  return [=](Experiment& experiment) {
    for (Trial& trial : experiment.trials) change(trial);
  };
}
std::function<void(Trial&)> points(const std::function<Vec3(const Vec3&)>& change) {
  return [=](Trial& trial) { change_points(trial, change); };
}
std::function<void(Trial&)> times(const std::function<double(double)>& change) {
  return [=](Trial& trial) {
    for (double& t : trial.markers.time) t = change(t);
  };
}
std::function<void(Trial&)> path_times(const std::function<double(double)>& change) {
  return [=](Trial& trial) {
    for (double& t : trial.holds[0].path.time) t = change(t);
  };
}

using laboratory::push;
using laboratory::release_x;
using laboratory::weights;

const Mistake clocks[] = {
    {"SinceNineteenSeventy",
     in(release_x, times([](double t) { return t + 1.7e9; })),
     {"release_x/markers.csv",
      "begins 1.7e+09 s after the trial (force.csv: 0 to 4 s; hold.csv: 0 "
      "to 1 s): expected seconds since it began, not since 1970"}},
    {"MillisecondsSinceNineteenSeventy",
     in(push, times([](double t) { return 1.7e12 + 1e3 * t; })),
     {"push/markers.csv", "not milliseconds since 1970"}},
    {"Milliseconds",
     in(release_x, times([](double t) { return 1e3 * t; })),
     {"release_x/markers.csv", "milliseconds", "m4 follows hold.csv", "divided by 1000"}},
    {"MillisecondsUnderWeights",
     in(weights, times([](double t) { return 1e3 * t; })),
     {"weights/markers.csv", "milliseconds", "m5 follows the load"}},
    {"MillisecondsOfAPath",
     in(release_x, path_times([](double t) { return 1e3 * t; })),
     {"release_x/hold.csv", "milliseconds"}},
    {"NumbersOfFrames",
     in(release_x, times([](double t) { return t / laboratory::step; })),
     {"release_x/markers.csv", "numbers of frames", "divided by 50"}},
    {"AClockSetAnew",
     in(release_x, times([](double t) { return t < 2.0 ? t : t + 3600.0; })),
     {"release_x/markers.csv", "jumps by 3600 s at 1.98 s"}},
    {"TwoSecondsLate",
     in(release_x, times([](double t) { return t + 2.0; })),
     {"release_x/markers.csv", "is 2 s late: m4 follows hold.csv"}},
    {"WeightsTwoSecondsLate",
     in(weights, times([](double t) { return t + 2.0; })),
     {"weights/markers.csv", "s late: m5 follows the load"}},
};

const Mistake units_and_frames[] = {
    {"MillimetresInOneTrial",
     in(release_x, points([](const Vec3& x) { return Vec3(1e3 * x); })),
     {"release_x/markers.csv", "times as far apart", "expected metres in the plant's own frame",
      "not millimetres"}},
    {"CentimetresInAll",
     in_all(points([](const Vec3& x) { return Vec3(1e2 * x); })),
     {"release_x/markers.csv", "not centimetres",
      "(and so release_y/markers.csv, weights/markers.csv, push/markers.csv)"}},
    {"Inches",
     in(push, points([](const Vec3& x) { return Vec3(x / 0.0254); })),
     {"push/markers.csv", "not inches"}},
    {"XAndYExchanged",
     in(release_x, points([](const Vec3& x) { return Vec3(x.y(), x.x(), x.z()); })),
     {"release_x/markers.csv", "read as (y, x, z)", "x and y exchanged?"}},
    {"TheOtherHand",
     in_all(points([](const Vec3& x) { return Vec3(x.x(), -x.y(), x.z()); })),
     {"release_x/markers.csv", "y of the opposite sign?"}},
    {"YUp",
     in_all(points([](const Vec3& x) { return Vec3(x.x(), x.z(), -x.y()); })),
     {"release_x/markers.csv", "read as (x, -z, y)", "y up in place of z?"}},
    {"ATurnedFrame",
     in(weights, points([](const Vec3& x) { return Vec3(-x.y(), x.x(), x.z()); })),
     {"weights/markers.csv", "read as (y, -x, z)", "turned about z?"}},
    {"AnOriginElsewhere",
     in(push, points([](const Vec3& x) { return Vec3(x + Vec3(0.1, 0, 0)); })),
     {"push/markers.csv", "aside of the plant's drawing by about (0.1,", "origin elsewhere?"}},
};

class Contradictions : public ::testing::TestWithParam<Mistake> {};

TEST_P(Contradictions, AreTold) {
  Experiment experiment = laboratory::day();
  GetParam().make(experiment);
  const Admission admission = admit(experiment);
  ASSERT_FALSE(admission.contradictions.empty());
  EXPECT_THAT(admission.refusal, StartsWith(GetParam().said.front() + " "));
  for (const std::string& part : GetParam().said) EXPECT_THAT(admission.refusal, HasSubstr(part));
  // A check of a folder says the same, of the same file.
  Diagnostics diagnostics;
  add_refusal(diagnostics, admission);
  EXPECT_THAT(diagnostics.text(), StartsWith("day/" + GetParam().said.front() + ": error: "));
}

constexpr auto name_of = [](const auto& info) { return info.param.name; };
INSTANTIATE_TEST_SUITE_P(Clock, Contradictions, ::testing::ValuesIn(clocks), name_of);
INSTANTIATE_TEST_SUITE_P(Frame, Contradictions, ::testing::ValuesIn(units_and_frames), name_of);

// What has a name of its own among the causes.
Vec3 turned(const Vec3& x, double angle) {
  return Eigen::AngleAxisd(angle, Vec3(1, 2, 2).normalized()) * x;
}
const Mistake known_effects[] = {
    {"NoMistake", [](Experiment&) {}, {}},
    {"ALatency", in_all(times([](double t) { return t + 0.02; })), {}},
    {"ALongLatency", in_all(times([](double t) { return t + 0.3; })), {}},
    {"AFrameTurned", in_all(points([](const Vec3& x) { return turned(x, 0.05); })), {}},
    {"AFrameTurnedFar", in_all(points([](const Vec3& x) { return turned(x, 0.29); })), {}},
    {"AScale", in_all(points([](const Vec3& x) { return Vec3(1.01 * x); })), {}},
    {"ALargeScale", in_all(points([](const Vec3& x) { return Vec3(0.82 * x); })), {}},
    {"AMarkerAside",
     [](Experiment& experiment) {
       for (Trial& trial : experiment.trials) trial.markers.value.col(12).array() += 0.045;
     },
     {}},
};

class KnownEffects : public ::testing::TestWithParam<Mistake> {};

TEST_P(KnownEffects, AreLeftToTheDiagnosis) {
  Experiment experiment = laboratory::day();
  GetParam().make(experiment);
  EXPECT_EQ(sentence(contradictions(experiment)), "");
}
INSTANTIATE_TEST_SUITE_P(Some, KnownEffects, ::testing::ValuesIn(known_effects), name_of);

}  // namespace
}  // namespace pedicel::discrepancy
