#include "plugins/discrepancy/test/symptoms.h"

#include <gtest/gtest.h>

#include <map>
#include <numbers>

#include "tests/unit/discrepancy/made_data.h"

namespace pedicel::discrepancy {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
enum { release, weights, push };

// Each value lies within 4 of its own standard errors of what was laid on the data.
void expect_value(const std::vector<Symptom>& all, const std::string& name, double expected,
                  double model_error = 0.0) {
  const Symptom* symptom = strongest(all, name);
  ASSERT_NE(symptom, nullptr) << name;
  EXPECT_TRUE(symptom->shows()) << name;
  EXPECT_NEAR(symptom->value, expected, 4.0 * symptom->standard_error + model_error) << name;
  EXPECT_FALSE(symptom->speaks_for.empty()) << name;
  EXPECT_TRUE(symptom->sentence.ends_with(".")) << symptom->sentence;
}

void expect_insignificant(const std::vector<Symptom>& all, const std::string& name) {
  const Symptom* symptom = strongest(all, name);
  if (!symptom) return;
  EXPECT_FALSE(symptom->shows()) << symptom->sentence;
}

// 2 x 40 experiments of noise alone, some 60 symptoms each: at the level of 5 standard errors less
// than one experiment in a hundred raises any.
TEST(Symptoms, PureNoiseRaisesNone) {
  int alarms = 0;
  std::size_t least = 1000;
  for (const double correlation : {0.0, 0.8})
    for (int seed = 1; seed <= 40; ++seed) {
      MadeData made;
      made.add_noise(seed, correlation);
      const auto all = made.symptoms(correlation);
      least = std::min(least, all.size());
      for (const Symptom& symptom : all)
        if (symptom.shows()) {
          ++alarms;
          ADD_FAILURE_AT(__FILE__, __LINE__) << seed << " " << symptom.sentence;
          break;
        }
    }
  EXPECT_LE(alarms, 1);
  EXPECT_GT(least, 20u) << "there is something to raise";
}

// The scatter of each kind over seeds is what its standard error says, within what 40 seeds tell.
TEST(Symptoms, StandardErrorsHold) {
  std::map<std::string, std::pair<double, int>> squares;
  for (int seed = 1; seed <= 40; ++seed) {
    MadeData made;
    made.add_noise(1000 + seed, 0.6);
    for (const Symptom& symptom : made.symptoms(0.6)) {
      if (symptom.name == "bad_channel") continue;  // the largest of several, never below 0
      const bool vector = (symptom.name == "base_rotation" || symptom.name == "excess_curvature" ||
                           symptom.name == "constant_offset");
      auto& [sum, count] = squares[symptom.name];
      sum += std::pow(symptom.significance(), 2) / (vector ? 3.0 : 1.0);
      ++count;
    }
  }
  EXPECT_GT(squares.size(), 9u);
  for (const auto& [name, sum] : squares) {
    EXPECT_LT(sum.first / sum.second, 1.8) << name;
    EXPECT_GT(sum.first / sum.second, 0.3) << name;
  }
}

TEST(Symptoms, AgreementHasNoSymptom) {
  for (const Symptom& symptom : MadeData().symptoms())
    EXPECT_FALSE(symptom.shows()) << symptom.sentence;
}

// A rigid turn about the root: linear in the distance, so it bends nothing and turns the branch
// with the stem.
TEST(Symptoms, TurnAboutTheRoot) {
  MadeData made;
  made.add_noise(1);
  made.change([](int trial, double t, int, const Vec3& p) -> Vec3 {
    if (trial != weights || t < 4.0) return Vec3::Zero();
    return Vec3(0, degree, 0).cross(p);
  });
  const auto all = made.symptoms();
  expect_value(all, "base_rotation", 1.0);
  expect_insignificant(all, "excess_curvature");
  expect_insignificant(all, "junction_kink");
  expect_insignificant(all, "length_scale");
  expect_insignificant(all, "time_shift");
  const Symptom& turn = *strongest(all, "base_rotation");
  EXPECT_NE(turn.subject.find("weights, 4"), std::string::npos) << turn.subject;
  ASSERT_EQ(turn.plot.series.size(), 2u);
  // Arc over distance is the angle.
  EXPECT_NEAR(turn.plot.series[1].y.back() / turn.plot.series[1].x.back(), 1e3 * degree, 0.5);
}

// A kink of angle a at m2, a third of neighbour distance L from both: second difference a / L.
TEST(Symptoms, BendAtAPlace) {
  MadeData made;
  made.add_noise(2);
  const double a = 0.02, L = 0.15;
  made.change([&](int trial, double t, int m, const Vec3&) -> Vec3 {
    if (trial != weights || t < 4.0 || m > 3) return Vec3::Zero();
    return Vec3(a * std::max(0.0, made.drawn(m).z() - 0.3), 0, 0);
  });
  const auto all = made.symptoms();
  expect_value(all, "excess_curvature", a / L);
  EXPECT_NE(strongest(all, "excess_curvature")->sentence.find("around m2"), std::string::npos);
}

TEST(Symptoms, KinkAtTheJunction) {
  MadeData made;
  made.add_noise(3);
  made.change([&](int trial, double t, int m, const Vec3&) -> Vec3 {
    if (trial != weights || t < 4.0 || m < 4) return Vec3::Zero();
    return Vec3(0, 2.0 * degree, 0).cross(made.drawn(m) - Vec3(0, 0, 0.3));
  });
  const auto all = made.symptoms();
  expect_value(all, "junction_kink", 2.0);
  EXPECT_NE(strongest(all, "junction_kink")->sentence.find("branch"), std::string::npos);
  expect_insignificant(all, "excess_curvature");
}

// To first order a delay d leaves -d v.
TEST(Symptoms, MarkersThatComeLate) {
  MadeData made;
  made.add_noise(4);
  const double delay = 0.004;
  for (std::size_t t = 0; t < made.predictions.size(); ++t)
    made.experiment.trials[t].markers.value -= delay * made.predictions[t].marker_velocity;
  const auto all = made.symptoms();
  expect_value(all, "time_shift", 1e3 * delay);
  EXPECT_NE(strongest(all, "time_shift")->sentence.find("behind"), std::string::npos);
  expect_insignificant(all, "base_rotation");
}

// A frequency that is off drifts out of step, which is no delay.
TEST(Symptoms, AnotherFrequencyIsNoDelay) {
  MadeData made;
  made.add_noise(5);
  Eigen::MatrixXd& x = made.experiment.trials[release].markers.value;
  const auto& time = made.experiment.trials[release].markers.time;
  for (Eigen::Index i = 0; i < x.rows(); ++i)
    if (time[i] > 1.0)
      x.row(i) += 0.002 * (time[i] - 1.0) * made.predictions[release].marker_velocity.row(i);
  const auto all = made.symptoms();
  expect_insignificant(all, "time_shift");
  expect_value(all, "frequency", 0.2, 0.02);
}

TEST(Symptoms, LengthsBetweenMarkers) {
  MadeData made;
  made.add_noise(6);
  made.change([](int, double, int, const Vec3& p) -> Vec3 { return 0.005 * p; });
  const auto all = made.symptoms();
  expect_value(all, "length_scale", 0.5);
}

TEST(Symptoms, OneMarkerThatSitsElsewhere) {
  MadeData made;
  made.add_noise(7);
  made.change([](int, double, int m, const Vec3&) -> Vec3 {
    return m == 2 ? Vec3(0.003, -0.004, 0.0) : Vec3::Zero();
  });
  const auto all = made.symptoms();
  expect_value(all, "constant_offset", 5.0);
  EXPECT_EQ(strongest(all, "constant_offset")->subject, "m3");
  const Symptom* bad = strongest(all, "bad_channel");
  ASSERT_NE(bad, nullptr);
  EXPECT_TRUE(bad->shows());
  EXPECT_EQ(bad->subject, "m3");
}

// The release with another frequency and damping, by its closed form.
void replace_swing(MadeData& made, double f, const std::function<double(double)>& envelope) {
  Samples& s = made.experiment.trials[release].markers;
  for (int i = 0; i < s.size(); ++i) {
    const double t = s.time[i] - 1.0;
    if (t < 0.0) continue;
    const double top = 0.04 * envelope(t) * std::cos(2 * std::numbers::pi * f * t);
    for (int m = 0; m < 6; ++m)
      s.value(i, 3 * m) = made.drawn(m).x() + std::pow(made.drawn(m).z() / 0.6, 2) * top;
  }
}

TEST(Symptoms, FrequencyAndDamping) {
  MadeData made;
  const double f = 2.06, zeta = 0.05;
  const double decay = 2 * std::numbers::pi * f * zeta / std::sqrt(1 - zeta * zeta);
  replace_swing(made, f, [=](double t) { return std::exp(-decay * t); });
  made.add_noise(8);
  const auto all = made.symptoms();
  expect_value(all, "frequency", 100.0 * (f / MadeData::frequency - 1.0));
  expect_value(all, "damping", zeta - MadeData::damping);
  expect_insignificant(all, "damping_by_amplitude");
  expect_insignificant(all, "frequency_by_amplitude");
}

// Moved by its base or by a hand, and left to ring when that has come to rest.
TEST(Symptoms, RingingAfterARestCountsAsFree) {
  MadeData made;
  const double f = 2.06, w = 2 * std::numbers::pi * f, decay = w * 0.03;
  replace_swing(made, f, [=](double t) { return std::exp(-decay * t); });
  made.add_noise(17);
  Trial& trial = made.experiment.trials[release];
  DrivenPath path{{0.0}, {Vec3::Zero()}, {}};
  for (double t = 0.1; t < 6.05; t += 0.1) {
    path.time.push_back(t);
    // To its place within a second, and then a trembling of it.
    path.position.push_back(t < 1.05 ? Vec3(0.02 * t, 0, 0)
                                     : Vec3(0.02, 1e-5 * std::cos(40 * t), 0));
  }
  const Hold released = trial.holds.front();
  const double expected = 100.0 * (f / MadeData::frequency - 1.0);
  trial.holds.clear();
  trial.base = path;
  expect_value(made.symptoms(), "frequency", expected);
  trial.base.reset();
  trial.holds = {released};
  trial.holds.front().path = path;
  trial.holds.front().release = std::numeric_limits<double>::infinity();
  expect_value(made.symptoms(), "frequency", expected);

  for (std::size_t i = 0; i < path.time.size(); ++i)
    path.position[i].x() = 0.02 * std::sin(9.0 * path.time[i]);
  trial.holds.front().path = path;
  EXPECT_EQ(strongest(made.symptoms(), "frequency"), nullptr) << "driven to the end";
}

// Quadratic drag beside the model's own damping: the amplitude follows a' = -d a - b a^2, so
// a = e / (1 + b (1 - e) / d) with e = exp(-d t): wide swings die out faster.
TEST(Symptoms, DampingThatGrowsWithAmplitude) {
  MadeData made;
  const double d = 2 * std::numbers::pi * 2.0 * 0.03, b = 0.8;
  replace_swing(made, MadeData::frequency, [=](double t) {
    const double e = std::exp(-d * t);
    return e / (1.0 + b * (1.0 - e) / d);
  });
  made.add_noise(9);
  const auto all = made.symptoms();
  const Symptom* symptom = strongest(all, "damping_by_amplitude");
  ASSERT_NE(symptom, nullptr);
  EXPECT_TRUE(symptom->shows());
  EXPECT_GT(symptom->value, 0.0);
  EXPECT_EQ(symptom->speaks_for.front(), "leaf_drag");
}

// A second mode of 11 Hz in both, damped 1 time the first in the data and 4 times in the model.
TEST(Symptoms, DampingOfTheSecondMode) {
  MadeData made;
  const auto add = [&](Eigen::MatrixXd& x, double zeta) {
    const double w = 2 * std::numbers::pi * 11.0;
    for (int i = 0; i < x.rows(); ++i) {
      const double t = i / 50.0 - 1.0;
      if (t < 0.0) continue;
      for (int m = 0; m < 4; ++m)
        x(i, 3 * m) += (m == 3 ? -0.004 : 0.006) * std::exp(-zeta * w * t) * std::cos(w * t);
    }
  };
  add(made.predictions[release].markers, 0.12);
  add(made.experiment.trials[release].markers.value, 0.03);
  made.add_noise(10);
  const auto all = made.symptoms();
  expect_value(all, "damping_by_mode", -3.0, 0.05);
}

// Dry friction of c against the push: over a path of s out and s back it costs 2 c s.
TEST(Symptoms, LoopOfAPush) {
  MadeData made;
  made.add_noise(11);
  const double c = 0.05, s = 0.04;
  Samples& force = made.experiment.trials[push].force;
  for (int i = 0; i < force.size(); ++i)
    force.value(i, 0) += force.time[i] < 2.0 ? c : force.time[i] > 5.0 ? -c : 0.0;
  const auto all = made.symptoms();
  // Half a sample at each end of the ramps: 0.02 s of 2 s.
  expect_value(all, "loop_area", 1e3 * 2 * c * s, 0.01 * 1e3 * 2 * c * s);
  expect_insignificant(all, "force_drift");
}

TEST(Symptoms, ForceThatFallsWhileHeld) {
  MadeData made;
  made.add_noise(12);
  Samples& force = made.experiment.trials[push].force;
  for (int i = 0; i < force.size(); ++i)
    force.value(i, 0) -= 0.03 * std::clamp((force.time[i] - 2.0) / 3.0, 0.0, 1.0);
  expect_value(made.symptoms(), "force_drift", -0.03);
}

TEST(Symptoms, ForceThatIsTooLarge) {
  MadeData made;
  made.add_noise(13);
  made.experiment.trials[push].force.value *= 1.15;
  expect_value(made.symptoms(), "force_scale", 15.0);
  // A trial's name may be a word of the sentence, so it is quoted.
  const std::string words = "in trial \"" + made.experiment.trials[push].name + "\" needs";
  for (const Symptom& symptom : made.symptoms())
    if (symptom.name == "force_scale") {
      EXPECT_NE(symptom.sentence.find(words), std::string::npos) << symptom.sentence;
    }
}

TEST(Symptoms, MotionAcrossThePlane) {
  MadeData made;
  made.add_noise(14);
  made.change([&](int trial, double, int m, const Vec3& p) -> Vec3 {
    return trial == release ? Vec3(0, 0.1 * (p.x() - made.drawn(m).x()), 0) : Vec3::Zero();
  });
  const auto all = made.symptoms();
  expect_value(all, "out_of_plane", 0.01, 5e-4);
  EXPECT_EQ(strongest(all, "out_of_plane")->subject, "release");
}

// Four equal releases whose frequency rises by 0.5 % each time: stiffness by 1 %, 3 % in all.
TEST(Symptoms, StiffnessThatFollowsTheClock) {
  MadeData made;
  const Trial first = made.experiment.trials[release];
  const Prediction same = made.predictions[release];
  made.experiment.trials.clear();
  made.predictions.clear();
  const double d = 2 * std::numbers::pi * 2.0 * 0.03;
  for (int k = 0; k < 4; ++k) {
    MadeData one;
    replace_swing(one, 2.0 * (1.0 + 0.005 * k), [=](double t) { return std::exp(-d * t); });
    one.add_noise(20 + k);
    Trial trial = one.experiment.trials[release];
    trial.name = "release" + std::to_string(k);
    trial.clock = 600.0 * k;
    made.experiment.trials.push_back(trial);
    made.predictions.push_back(same);
  }
  expect_value(made.symptoms(), "clock_trend", 3.0, 0.02);
}

TEST(Symptoms, TrialsThatFailedAndGapsAreLeftOut) {
  MadeData made;
  made.add_noise(15);
  made.predictions[release].healthy = false;
  for (int i = 0; i < 200; ++i)
    made.experiment.trials[weights].markers.value.row(i).segment<3>(6).setConstant(NAN);
  const auto all = made.symptoms();
  EXPECT_EQ(strongest(all, "frequency"), nullptr);
  for (const Symptom& symptom : all) {
    EXPECT_TRUE(std::isfinite(symptom.value)) << symptom.name;
    EXPECT_FALSE(symptom.shows()) << symptom.sentence;
  }
}

TEST(Symptoms, NumbersAreWrittenToTheirErrors) {
  EXPECT_EQ(with_error(0.8312, 0.0234, "mm"), "0.83 \u00b1 0.02 mm");
  EXPECT_EQ(with_error(1.00213, 0.0012, "deg"), "1.0021 \u00b1 0.0012 deg");
  EXPECT_EQ(with_error(-12.34, 3.0, "1"), "-12 \u00b1 3");
  EXPECT_EQ(with_error(1.2e-9, 3e-10, "1"), "1.2e-09 \u00b1 3e-10");
}

TEST(Symptoms, PairsFollowTheSameSubject) {
  const auto make = [](const char* name, const char* subject, double value) {
    Symptom s;
    s.name = name;
    s.subject = subject;
    s.value = value;
    s.standard_error = 1.0;
    return s;
  };
  const auto pairs = paired({make("a", "x", 3.0), make("a", "y", -20.0), make("b", "x", 30.0)},
                            {make("a", "x", 9.0), make("a", "y", 1.0)});
  ASSERT_EQ(pairs.size(), 2u);
  EXPECT_EQ(pairs[0].before.name, "b");
  EXPECT_TRUE(pairs[0].after.name.empty());
  EXPECT_EQ(pairs[1].before.subject, "y");
  EXPECT_EQ(pairs[1].after.value, 1.0);
}

}  // namespace
}  // namespace pedicel::discrepancy
