// Mistakes of a day in a laboratory: each must be told with its file and its likely cause, and what
// known effects explain must not be.
#include "plugins/discrepancy/admission/contradiction.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/io/yaml.h"
#include "plugins/discrepancy/admission/admission.h"
#include "plugins/plant/effect_reader.h"
#include "tests/unit/discrepancy/laboratory.h"

namespace pedicel::discrepancy {
namespace {

using laboratory::change_points;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
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

// As a file writes it.
plant::Effect effect(const std::string& text) {
  Diagnostics diagnostics;
  const io::YamlNode node = io::parse_yaml(text, "effect.yaml", diagnostics);
  const effects::EffectDefinition* known = effects::find_effect(node.raw()["name"].Scalar());
  const plant::Effect effect = plant::read_effect(node, known->file);
  EXPECT_EQ(diagnostics.text(), "");
  return effect;
}

using laboratory::push;
using laboratory::release_x;
using laboratory::release_y;
using laboratory::weights;

std::function<void(Trial&)> force_times(const std::function<double(double)>& change) {
  return [=](Trial& trial) {
    for (double& t : trial.force.time) t = change(t);
  };
}
// The clock counts the frames that are left.
std::function<void(Trial&)> drop_frames(int at, int lost) {
  return [=](Trial& trial) {
    Samples& all = trial.markers;
    const int rows = all.size() - lost;
    all.value.middleRows(at, rows - at) = all.value.bottomRows(rows - at).eval();
    all.value.conservativeResize(rows, Eigen::NoChange);
    all.time.resize(rows);
  };
}

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
    {"MinutesUnderWeights",
     in(weights, times([](double t) { return t / 60.0; })),
     {"weights/markers.csv", "minutes: m5 follows the load when they are multiplied by 60,"}},
    {"HoursUnderWeights",
     in(weights, times([](double t) { return t / 3600.0; })),
     {"weights/markers.csv", "hours: m5 follows the load when they are multiplied by 3600,"}},
    {"KilosecondsUnderWeights",
     in(weights, times([](double t) { return 1e-3 * t; })),
     {"weights/markers.csv", "kiloseconds: m5 follows the load", "multiplied by 1000,"}},
    {"HoursBesideAPath",
     in(push, times([](double t) { return t / 3600.0; })),
     {"push/markers.csv", "hours: m4 follows hold.csv", "multiplied by 3600,"}},
    {"APathInHours",
     in(push, path_times([](double t) { return t / 3600.0; })),
     {"push/hold.csv", "hours"}},
    {"ForcesInHours",
     in(push, force_times([](double t) { return t / 3600.0; })),
     {"push/force.csv", "hours: the force follows hold.csv when they are multiplied by 3600,"}},
    {"APathHalfASecondLate",
     in(release_x, path_times([](double t) { return t + 0.5; })),
     {"release_x/hold.csv", "is 0.5 s late: m4 moves before it"}},
    {"APathThatBeginsAtItsRelease",
     in(release_x, path_times([](double t) { return t + 1.0; })),
     {"release_x/hold.csv", "begins at 1 s, not before the release at 1 s"}},
    {"APathThatBeginsAfterItsRelease",
     in(release_x, path_times([](double t) { return t + 1.5; })),
     {"release_x/hold.csv", "begins at 1.5 s, not before the release at 1 s"}},
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
    {"WeightsAtTwiceTheRate",
     in(weights, times([](double t) { return 2.0 * t; })),
     {"weights/markers.csv", "times as fast", "rate of frames?"}},
    {"WeightsAtHalfTheRate",
     in(weights, times([](double t) { return 0.5 * t; })),
     {"weights/markers.csv", "times as fast", "rate of frames?"}},
    {"WeightsThreePerCentFast",
     in(weights, times([](double t) { return 1.03 * t; })),
     {"weights/markers.csv", "m5 answer the load at 3 s after", "and that at 9 s after",
      "a clock that runs 1.03 times as fast"}},
    {"FramesDroppedUnderWeights",
     in(weights, drop_frames(350, 50)),
     {"weights/markers.csv", "m5 answer the load at 3 s", "frames dropped"}},
    {"OnePerCentFast",
     [](Experiment& e) {
       e = laboratory::measured({effect("{name: grip_compliance, stiffness: 2000}")});
       in(push, times([](double t) { return 1.01 * t; }))(e);
     },
     {"push/markers.csv", "has a clock that runs 1.01",
      "as fast as that of hold.csv: m4 is left "
      "behind by 0.0"}},
    {"ForcesInMilliseconds",
     in(push, force_times([](double t) { return 1e3 * t; })),
     {"push/force.csv", "milliseconds: the force follows hold.csv when they are divided by 1000"}},
    {"ForcesASecondLate",
     in(push, force_times([](double t) { return t + 1.0; })),
     {"push/force.csv", "is 1 s late: the force follows hold.csv"}},
    {"AForceAfterTheRelease",
     in(release_x,
        [](Trial& trial) {
          for (int row = 70; row < trial.force.size(); ++row)
            trial.force.value(row, 0) += 0.3 * std::sin(9.0 * trial.force.time[row]);
        }),
     {"release_x/force.csv", "N after the release at 1 s: expected no pull any more"}},
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
    {"TurnedByFortyFiveDegrees",
     in_all(points(
         [](const Vec3& x) { return Vec3(Eigen::AngleAxisd(-M_PI / 4.0, Vec3::UnitZ()) * x); })),
     {"release_x/markers.csv", "turned by 45 degrees about z", "turned on the floor?"}},
    {"CamerasPushed",
     in(push,
        [](Trial& trial) {
          for (Eigen::Index c = 0; c < trial.markers.value.cols(); c += 3)
            trial.markers.value.col(c).tail(200).array() += 0.03;
        }),
     {"push/markers.csv", "all markers go aside by the same 30", "between 4 and 4.02 s",
      "cameras that were pushed"}},
};

Vec3 point(const Trial& trial, int row, int marker) {
  return trial.markers.value.block<1, 3>(row, 3 * marker).transpose();
}
void put(Trial& trial, int row, int marker, const Vec3& x) {
  trial.markers.value.block<1, 3>(row, 3 * marker) = x.transpose();
}
std::function<void(Trial&)> exchange(int a, int b, int from) {
  return [=](Trial& trial) {
    for (int row = from; row < trial.markers.size(); ++row) {
      const Vec3 keep = point(trial, row, a);
      put(trial, row, a, point(trial, row, b));
      put(trial, row, b, keep);
    }
  };
}
// The marker is touched.
std::function<void(Trial&)> slip(int marker, const Vec3& by, int from, int to) {
  return [=](Trial& trial) {
    for (int row = from; row < std::min(to, trial.markers.size()); ++row)
      put(trial, row, marker, point(trial, row, marker) + by);
  };
}
// The first row with noise of its own.
Eigen::RowVectorXd still(const Samples& samples, int row) {
  Random random(100 + row);
  Eigen::RowVectorXd value = samples.value.row(0);
  for (double& x : value)
    x += (value.size() > 3 ? laboratory::position_std : laboratory::force_std) * random.normal();
  return value;
}
void every_seventh_is_zero(Trial& trial) {
  for (int row = 6; row < trial.markers.size(); row += 7) put(trial, row, 8, Vec3::Zero());
}
void copy_column(Trial& trial) {
  for (int row = 0; row < trial.markers.size(); ++row) put(trial, row, 2, point(trial, row, 1));
}
// The tracker loses a marker for good and takes something in the room for it.
void ghost(Trial& trial) {
  for (int row = 60; row < trial.markers.size(); ++row) put(trial, row, 6, Vec3(0.9, 0.4, 0.1));
}
// The table goes on with another record.
void append(Trial& trial, const Samples& more) {
  Samples& all = trial.markers;
  const double next = all.time.back() + laboratory::step;
  const Eigen::Index rows = all.value.rows();
  all.value.conservativeResize(rows + more.value.rows(), Eigen::NoChange);
  all.value.bottomRows(more.value.rows()) = more.value;
  for (const double t : more.time) all.time.push_back(next + t);
}
std::function<void(Experiment&)> loads(const std::function<Vec3(const Vec3&, int)>& change) {
  return in(weights, [=](Trial& trial) {
    for (int i = 0; i < static_cast<int>(trial.loads.size()); ++i)
      trial.loads[i].force = change(trial.loads[i].force, i);
  });
}
std::function<void(Trial&)> path(const std::function<Vec3(const Vec3&)>& change) {
  return [=](Trial& trial) {
    for (Vec3& x : trial.holds[0].path.position) x = change(x);
  };
}
std::function<void(Trial&)> force(double factor) {
  return [=](Trial& trial) { trial.force.value *= factor; };
}

const Mistake labels[] = {
    {"LabelsSwappedHalfWay",
     in(release_x, exchange(1, 8, 100)),
     {"release_x/markers.csv", "m2 and m9 exchange their places from 2 s on", "swapped"}},
    {"NeighboursSwappedHalfWay",
     in(push, exchange(1, 2, 200)),
     {"push/markers.csv", "m2 and m3 exchange their places from 4 s on"}},
    {"LabelsSwappedFromTheStart",
     in_all(exchange(1, 2, 0)),
     {"release_x/markers.csv", "m2 and m3 each where the plant has the other"}},
    {"AColumnCopied",
     in(release_y, copy_column),
     {"release_y/markers.csv", "same numbers for m2 and m3 in 201 rows"}},
    {"ZerosForNotSeen",
     in(release_x, every_seventh_is_zero),
     {"release_x/markers.csv", "m9 at exactly 0, 0, 0 in 28 rows", "expected empty cells"}},
    {"AWordForNotSeen",
     in(release_x,
        [](Trial& trial) {
          for (int row = 60; row < 63; ++row) put(trial, row, 8, Vec3::Constant(-9999.0));
        }),
     {"release_x/markers.csv", "m9 at exactly -9999, -9999, -9999 in 3 rows",
      "expected empty cells"}},
    {"NeverSeen",
     in(release_x, [](Trial& trial) { trial.markers.value.setConstant(std::nan("")); }),
     {"release_x/markers.csv", "has no marker in any of its 201 rows"}},
    {"AGhost", in(release_x, ghost), {"release_x/markers.csv", "m7", "a ghost"}},
    {"AMarkerThatSlips",
     in(release_x, slip(4, Vec3(0.02, 0, 0), 101, 1000)),
     {"release_x/markers.csv", "m5 go aside by", "mm between 2 and 2.02 s",
      "while the other markers do not", "slipped"}},
    {"AMarkerOfABranchThatSlips",
     in(weights, slip(6, Vec3(0, 0.006, 0.006), 250, 1000)),
     {"weights/markers.csv", "m7 go aside by", "mm between 4.98 and 5 s"}},
    {"AMarkerAtAnotherPlace",
     [](Experiment& experiment) { experiment.markers[2].place.at = 0.75; },
     {"release_x/markers.csv", "where the plant is 0.03", "expected m3 at 0.75 of stem"}},
};

const Mistake drives[] = {
    {"MarkersOfAnotherTrial",
     [](Experiment& e) { std::swap(e.trials[release_x].markers, e.trials[release_y].markers); },
     {"release_x/markers.csv", "go another way than hold.csv", "the markers of trial release_y?"}},
    {"ACopiedFile",
     [](Experiment& e) { e.trials[weights].markers = e.trials[push].markers; },
     {"weights/markers.csv", "same numbers as push/markers.csv", "copied?"}},
    {"FoldersExchanged",
     [](Experiment& e) {
       Trial &one = e.trials[release_x], &other = e.trials[push];
       std::swap(one.markers, other.markers);
       std::swap(one.force, other.force);
       std::swap(one.holds[0].path, other.holds[0].path);
     },
     {"release_x/markers.csv", "follow hold.csv until 8 s, where it is let go at 1 s"}},
    {"TwoRecordsInOneTable",
     [](Experiment& e) { append(e.trials[release_x], e.trials[release_y].markers); },
     {"release_x/markers.csv",
      "holds from 4.02 to 8.02 s the same numbers as release_y/markers.csv",
      "two records in one table?"}},
    {"ARowCopiedDown",
     in(release_x,
        [](Trial& trial) {
          for (int row = 40; row < trial.markers.size(); ++row)
            trial.markers.value.row(row) = trial.markers.value.row(40);
        }),
     {"release_x/markers.csv", "stand still to the last digit from 0.8 s on, in 161 rows"}},
    {"ForcesAlongAnotherAxis",
     in(push,
        [](Trial& trial) {
          trial.force.value.col(1).swap(trial.force.value.col(0));
          trial.force.value.col(2).setZero();
        }),
     {"push/force.csv", "goes across the way that hold.csv leads the held point"}},
    {"ATableThatBeginsAgain",
     in(push, [](Trial& trial) { append(trial, Samples(trial.markers)); }),
     {"push/markers.csv",
      "holds from 8.02 to 16.02 s the same numbers as earlier rows of its own"}},
    {"LoadsInGrams",
     loads([](const Vec3& f, int) { return Vec3(f / 9.80665e-3); }),
     {"weights/markers.csv", "m for a newton of the load", "expected loads in newtons; in grams"}},
    {"LoadsAlongAnotherAxis",
     loads([](const Vec3& f, int) { return Vec3(f.y(), f.x(), f.z()); }),
     {"weights/markers.csv", "m5 go across the load beside it"}},
    {"LoadsOfTheOtherSign",
     loads([](const Vec3& f, int) { return Vec3(-f); }),
     {"weights/markers.csv", "against the change of the load at 3 s", "of the other sign?"}},
    {"LoadsInAnotherOrder",
     loads([](const Vec3& f, int i) { return Vec3(i == 0 ? 2.0 * f : 0.5 * f); }),
     {"weights/markers.csv", "against the change of the load at 6 s", "in another order?"}},
    {"APathInMillimetres",
     in(release_x, path([](const Vec3& x) { return Vec3(1e3 * x); })),
     {"release_x/hold.csv", "in millimetres?"}},
    {"APathWithYUp",
     in(push, path([](const Vec3& x) { return Vec3(x.x(), x.z(), -x.y()); })),
     {"push/hold.csv", "read as (x, -z, y)", "y up in place of z?"}},
    {"ThePathOfAnotherPoint",
     in(release_x, path([](const Vec3& x) { return Vec3(x - Vec3(0.03, -0.006, 0.2)); })),
     {"release_x/hold.csv", "path of the point at"}},
    {"QuaternionsWithWFirst",
     in(release_x,
        [](Trial& trial) {
          DrivenPath& path = trial.holds[0].path;  // 1, 0, 0, 0, read as x, y, z, w
          path.rotation.assign(path.time.size(), Quat(0, 1, 0, 0));
        }),
     {"release_x/hold.csv", "expected qx, qy, qz, qw"}},
    {"AReleaseThatWasEarlier",
     in(release_x, [](Trial& t) { t.holds[0].release = 2.0; }),
     {"release_x/markers.csv", "held until 2 s", "earlier"}},
    {"AReleaseThatWasLater",
     in(release_x, [](Trial& t) { t.holds[0].release = 0.3; }),
     {"release_x/markers.csv", "let go at 0.3 s", "later"}},
    {"AnotherRate",
     in(push, times([](double t) { return 1.2 * t; })),
     {"push/markers.csv", "times as fast as that of hold.csv", "rate of frames?"}},
    {"FramesDroppedUncounted",
     in(release_x, drop_frames(60, 33)),
     {"release_x/markers.csv", "markers jump between 1.18 and 1.2 s", "frames dropped"}},
    {"ForcesOnTheSensor", in(push, force(-1.0)), {"push/force.csv", "of the opposite sign?"}},
    {"ForcesInGrams", in(push, force(101.97)), {"push/force.csv", "expected newtons", "in grams?"}},
    {"ForcesInKilonewtons",
     in(push, force(1e-3)),
     {"push/force.csv", "expected newtons", "in kilonewtons?"}},
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

// Rows without a marker are gaps, to the end of the record, too.
TEST(Contradiction, MarkersLostForGoodDoNotStandStill) {
  Experiment experiment = laboratory::day();
  Trial& trial = experiment.trials[release_x];
  trial.markers.value.bottomRows(trial.markers.size() - 150).setConstant(NAN);
  EXPECT_THAT(admit(experiment).refusal, Not(HasSubstr("stand still")));
}

constexpr auto name_of = [](const auto& info) { return info.param.name; };
INSTANTIATE_TEST_SUITE_P(Clock, Contradictions, ::testing::ValuesIn(clocks), name_of);
INSTANTIATE_TEST_SUITE_P(Frame, Contradictions, ::testing::ValuesIn(units_and_frames), name_of);
INSTANTIATE_TEST_SUITE_P(Label, Contradictions, ::testing::ValuesIn(labels), name_of);
INSTANTIATE_TEST_SUITE_P(Drive, Contradictions, ::testing::ValuesIn(drives), name_of);

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
    {"LabelsSwappedForAWhile",
     in(release_x,
        [](Trial& trial) {
          exchange(1, 2, 100)(trial);
          exchange(1, 2, 120)(trial);
        }),
     {}},
    {"AMarkerElsewhereForAWhile", in(release_x, slip(4, Vec3(0.02, 0, 0), 101, 131)), {}},
    {"AMarkerElsewhereInOneRow", in(release_x, slip(4, Vec3(0.02, 0, 0), 101, 102)), {}},
    {"AMarkerElsewhereUntilAGap",
     in(release_x,
        [](Trial& trial) {
          slip(4, Vec3(0.02, 0, 0), 101, 131)(trial);
          for (int row = 126; row < 136; ++row) put(trial, row, 4, Vec3::Constant(std::nan("")));
        }),
     {}},
    {"APathThatBeginsLateWithStillMarkers",
     in(push,
        [](Trial& trial) {
          // All waited two seconds at the first place; the path says nothing of them.
          const int wait = 100, rows = trial.markers.size();
          for (Samples* samples : {&trial.markers, &trial.force}) {
            Eigen::MatrixXd later = samples->value;
            for (int row = 0; row < rows; ++row)
              later.row(row) = row < wait ? still(*samples, row) : samples->value.row(row - wait);
            samples->value = later;
          }
          for (double& t : trial.holds[0].path.time) t += 2.0;
        }),
     {}},
    {"AFrozenMarker",
     in(release_x,
        [](Trial& trial) {
          for (int row = 100; row < trial.markers.size(); ++row)
            put(trial, row, 8, point(trial, 100, 8));
        }),
     {}},
    {"ASeldomSampledRecord",
     in_all([](Trial& trial) {
       Samples few;
       few.value.resize((trial.markers.size() + 11) / 12, trial.markers.value.cols());
       for (int row = 0; row < few.value.rows(); ++row) {
         few.time.push_back(trial.markers.time[12 * row]);
         few.value.row(row) = trial.markers.value.row(12 * row);
       }
       trial.markers = few;
     }),
     {}},
    {"AForceGainOfATenth", in_all([](Trial& trial) { trial.force.value *= 0.2; }), {}},
};

class KnownEffects : public ::testing::TestWithParam<Mistake> {};

TEST_P(KnownEffects, AreLeftToTheDiagnosis) {
  Experiment experiment = laboratory::day();
  GetParam().make(experiment);
  EXPECT_EQ(sentence(contradictions(experiment)), "");
}
INSTANTIATE_TEST_SUITE_P(Some, KnownEffects, ::testing::ValuesIn(known_effects), name_of);

struct Hidden {
  std::string name, effect;  ///< the effect as a file writes it
};
std::ostream& operator<<(std::ostream& out, const Hidden& hidden) {
  return out << hidden.name;
}

// As large as makes sense, and larger.
const Hidden hidden_effects[] = {
    {"HalfTheModulus", "{name: youngs_modulus, factor: 0.5}"},
    {"ThreeTimesTheModulus", "{name: youngs_modulus, factor: 3}"},
    {"AHeavyTip", "{name: extra_mass, mass: 0.03, where: {curve: stem, at: 0.9}}"},
    {"ASoftRoot", "{name: base_compliance, stiffness: 0.5}"},
    {"AWeakSegment",
     "{name: weak_segment, factor: 0.1, length: 0.08, where: {curve: stem, at: 0.4}}"},
    {"AGradient", "{name: stiffness_gradient, gradient: -1.5}"},
    {"Softening", "{name: material_nonlinearity, coefficient: -0.3, k0: 1}"},
    {"Anisotropy", "{name: anisotropy, ratio: 0.4, direction: [0.7, 0.7, 0]}"},
    {"Friction", "{name: internal_friction, curvature: 0.1, ratio: 0.6}"},
    {"Relaxation", "{name: relaxation, fraction: 0.6, time: 1.5}"},
    {"Creep", "{name: creep, fraction: 0.6, time: 40}"},
    {"Yield", "{name: yield, curvature: 0.3}"},
    {"MassDamping", "{name: mass_damping, rate: 20}"},
    {"Wind", "{name: wind, velocity: [1.5, 1.5, 0], drag_area: 0.1}"},
    {"Gust", "{name: gust, velocity: [0, 2, 0], drag_area: 0.1, frequency: 0.5, amplitude: 0.6}"},
    {"LeafDrag", "{name: leaf_drag, drag_area: 0.3}"},
    {"ASoftGrip", "{name: grip_compliance, stiffness: 15}"},
    {"ASlip", "{name: grip_slip, distance: -0.06, time: 0.7}"},
    {"Latency", "{name: latency, delay: 0.3}"},
    {"ATurnedFrame", "{name: frame_rotation, rotation: [0.2, -0.2, 0.1]}"},
    {"AnOffset", "{name: marker_offset, marker: m5, offset: [0.02, -0.03, 0.03]}"},
    {"AForceGain", "{name: force_gain, gain: 0.3, offset: [0.1, 0, -0.1]}"},
};

// A soft stem that was drawn upright leans by 0.1 m to the side that is down. Compared with where
// the first trial's gravity has it, a path or a marker of the second would be 0.2 m off.
TEST(HonestTrials, APlantMayBeTurnedBetweenTrials) {
  Experiment experiment = laboratory::day();
  experiment.plant().material.youngs_modulus = 5e7;
  // On the branches alone: a marker beside the path would say how far the plant is aside.
  experiment.markers.erase(experiment.markers.begin(), experiment.markers.begin() + 5);
  experiment.trials.clear();
  laboratory::add_trials(experiment);
  Trial& turned = experiment.trials[release_y];
  turned.gravity = {0, 9.81, 0};
  const Vec3 start = laboratory::held_point(experiment, turned.gravity);
  ASSERT_GT((start - laboratory::held_point(experiment)).norm(), 0.1);
  for (Vec3& x : turned.holds[0].path.position) x += start - laboratory::held_point(experiment);
  laboratory::measure(experiment, {});
  for (const Contradiction& one : contradictions(experiment)) ADD_FAILURE() << one.sentence();
  turned.gravity = experiment.trials[release_x].gravity;
  EXPECT_FALSE(contradictions(experiment).empty())
      << "the same tables, and a gravity that is wrong";
}

// The plant is pulled aside within a fifth of a second and let go soon after: markers go far
// between two samples, and all of them.
TEST(HonestTrials, AFastReleaseIsNoMistake) {
  Experiment experiment = laboratory::day();
  Hold& hold = experiment.trials[release_x].holds[0];
  const Vec3 start = hold.path.position.front();
  hold = laboratory::hold_along(start, 0.1 * Vec3::UnitX(), 0.3,
                                [](double t) { return laboratory::ease(t / 0.2); });
  hold.release = 0.3;
  experiment.trials.resize(1);
  laboratory::measure(experiment, {});
  EXPECT_EQ(sentence(contradictions(experiment)), "");
}

class HiddenEffects : public ::testing::TestWithParam<Hidden> {};

TEST_P(HiddenEffects, AreLeftToTheDiagnosis) {
  EXPECT_EQ(sentence(contradictions(laboratory::measured({effect(GetParam().effect)}))), "");
}
INSTANTIATE_TEST_SUITE_P(Some, HiddenEffects, ::testing::ValuesIn(hidden_effects), name_of);

}  // namespace
}  // namespace pedicel::discrepancy
