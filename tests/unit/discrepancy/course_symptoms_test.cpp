// How what is seen depends on the rate and on what was before, on data where both are known: a
// plant that is stiffer in its swings than at rest, loops of friction and of viscosity, a force
// that lags, one that remembers.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "plugins/discrepancy/select/symptom_numbers.h"
#include "tests/unit/discrepancy/made_data.h"

namespace pedicel::discrepancy {
namespace {

enum { release, weights, push };
constexpr double amplitude = 0.03;        // m, of the pushes to and fro
constexpr double periods[] = {8.0, 2.0};  // s, of one push and of the other
constexpr double rate = 50.0;             // Hz
constexpr double spring = 20.0;           // N/m
constexpr double pi = std::numbers::pi;

/// The made experiment and two trials that push to and fro, slowly and quickly.
struct CourseData : MadeData {
  CourseData() {
    for (const double period : periods) add_sine(period);
  }

  static int first_sine() { return 3; }
  static double way(double t, double period) { return amplitude * std::sin(2.0 * pi * t / period); }
  static double speed(double t, double period) {
    return amplitude * 2.0 * pi / period * std::cos(2.0 * pi * t / period);
  }

  /// Adds to the measured force of a sine a function of time and period.
  void change_force(const std::function<double(double t, double period)>& by) {
    for (int s = 0; s < 2; ++s) {
      Samples& force = experiment.trials[first_sine() + s].force;
      for (int i = 0; i < force.size(); ++i) force.value(i, 0) += by(force.time[i], periods[s]);
    }
  }

 private:
  void add_sine(double period) {
    Trial trial;
    trial.name = period > 4.0 ? "slow" : "quick";
    Hold hold;
    hold.place = {"stem", 1.0, {}};
    const auto n = static_cast<int>(std::lround(16.0 * rate)) + 1;
    Prediction p;
    p.markers.resize(n, 3 * experiment.markers.size());
    p.marker_velocity = Eigen::MatrixXd::Zero(n, p.markers.cols());
    p.force = Eigen::MatrixXd::Zero(n, 3);
    for (int i = 0; i < n; ++i) {
      const double t = i / rate;
      hold.path.time.push_back(t);
      hold.path.position.emplace_back(way(t, period), 0, 0.6);
      p.force(i, 0) = spring * way(t, period);
      for (std::size_t m = 0; m < experiment.markers.size(); ++m) {
        const Vec3 x = drawn(static_cast<int>(m));
        const double share = std::pow(x.z() / 0.6, 2);
        p.markers.row(i).segment<3>(3 * m) = (x + Vec3(share * way(t, period), 0, 0)).transpose();
        p.marker_velocity(i, 3 * m) = share * speed(t, period);
      }
    }
    trial.markers = {hold.path.time, p.markers};
    trial.force = {hold.path.time, p.force};
    trial.holds.push_back(hold);
    experiment.trials.push_back(std::move(trial));
    predictions.push_back(std::move(p));
  }
};

constexpr const char* names[] = {"dynamic_over_static", "loop_area_by_rate", "delay_by_frequency",
                                 "force_lag", "drive_history"};

// Within 3 of its own standard errors of what is known, and seen.
void expect_value(const std::vector<Symptom>& all, const std::string& name,
                  const std::string& subject, double expected) {
  const auto found = std::ranges::find_if(all, [&](const Symptom& one) {
    return one.name == name && (subject.empty() || one.subject == subject);
  });
  ASSERT_NE(found, all.end()) << name;
  EXPECT_NEAR(found->value, expected, 3.0 * found->standard_error) << found->sentence;
  EXPECT_TRUE(expected == 0.0 || found->shows()) << found->sentence;
  EXPECT_FALSE(found->speaks_for.empty()) << name;
}

TEST(CourseSymptoms, NullDataGiveNothing) {
  std::map<std::string, std::array<int, 2>> counts;  // all, and those within two errors
  for (const double correlation : {0.0, 0.6})
    for (int seed = 1; seed <= 40; ++seed) {
      CourseData made;
      made.add_noise(static_cast<std::uint64_t>(seed), correlation);
      for (const Symptom& one : made.symptoms(correlation)) {
        if (std::ranges::find(names, one.name) == std::end(names)) continue;
        ++counts[one.name][0];
        counts[one.name][1] += std::abs(one.value) <= 2.0 * one.standard_error;
        EXPECT_FALSE(one.shows()) << seed << " " << one.sentence;
      }
    }
  EXPECT_EQ(counts.size(), std::size(names));
  // 95.4 % are expected; so few as 89 % of 80 come about once in 40 kinds of such a test.
  int all = 0, within = 0;
  for (const auto& [name, count] : counts) {
    EXPECT_GE(count[0], 80) << name;
    EXPECT_GE(count[1], 0.89 * count[0]) << name;
    all += count[0], within += count[1];
  }
  EXPECT_GE(within, 0.94 * all);
}

// 20 % stiffer in its swings and 20 % softer under weights: 1.5 times.
TEST(CourseSymptoms, StiffnessSwingingOverAtRest) {
  CourseData made;
  made.add_noise(1);
  const double w = 2.0 * pi * MadeData::frequency * std::sqrt(1.2);
  const double z = MadeData::damping, d = w * z / std::sqrt(1.0 - z * z);
  made.change([&](int trial, double t, int, const Vec3& p) -> Vec3 {
    const double share = std::pow(p.z() / 0.6, 2);
    if (trial == weights && t >= 4.0) return {0.25 * share * 0.03, 0, 0};
    if (trial != release || t < 1.0) return Vec3::Zero();
    const double w0 = 2.0 * pi * MadeData::frequency, d0 = w0 * z / std::sqrt(1.0 - z * z);
    const double s = t - 1.0;
    const double top =
        0.04 * (std::exp(-d * s) * std::cos(w * s) - std::exp(-d0 * s) * std::cos(w0 * s));
    return {share * top, 0, 0};
  });
  // The pushes are as stiff as the weights say.
  for (int t = push; t < static_cast<int>(made.predictions.size()); ++t)
    made.experiment.trials[t].force.value -= 0.2 * made.predictions[t].force;
  const auto all = made.symptoms();
  expect_value(all, "dynamic_over_static", "", 50.0);
  EXPECT_EQ(strongest(all, "dynamic_over_static")->speaks_for.front(), "relaxation");
}

// A viscous force c v costs pi c w A^2 a cycle; way times force is 4 A k A.
TEST(CourseSymptoms, AViscousLoopGrowsWithTheRate) {
  CourseData made;
  made.add_noise(2);
  const double c = 1.0;  // N s/m
  made.change_force([&](double t, double period) { return c * CourseData::speed(t, period); });
  const auto of = [&](double period) {
    return 100.0 * pi * c * (2.0 * pi / period) / (4.0 * spring);
  };
  // On a logarithmic scale; the push of MadeData lies between the two and has no loop.
  CourseData alone = made;
  std::erase_if(alone.experiment.trials, [](const Trial& one) { return one.name == "push"; });
  alone.predictions.erase(alone.predictions.begin() + push);
  expect_value(alone.symptoms(), "loop_area_by_rate", "", of(periods[1]) - of(periods[0]));
}

TEST(CourseSymptoms, ALoopOfFrictionDoesNot) {
  CourseData made;
  made.add_noise(3);
  made.change_force([](double t, double period) {
    return 0.1 * (CourseData::speed(t, period) > 0.0 ? 1.0 : -1.0);
  });
  std::erase_if(made.experiment.trials, [](const Trial& one) { return one.name == "push"; });
  made.predictions.erase(made.predictions.begin() + push);
  const auto all = made.symptoms();
  EXPECT_TRUE(strongest(all, "loop_area")->shows());
  expect_value(all, "loop_area_by_rate", "", 0.0);
}

TEST(CourseSymptoms, AForceThatLags) {
  CourseData made;
  made.add_noise(4);
  const double lag = 0.03;
  made.change_force([&](double t, double period) {
    return spring * (CourseData::way(t - lag, period) - CourseData::way(t, period));
  });
  const auto all = made.symptoms();
  expect_value(all, "force_lag", "quick", 1e3 * lag);
  expect_value(all, "drive_history", "quick", 0.0);
  EXPECT_EQ(strongest(all, "force_lag")->speaks_for.front(), "sensor_lag");
}

// A third of the force goes by the exponential mean of the drive over the memory that is asked for.
TEST(CourseSymptoms, AForceThatRemembers) {
  CourseData made;
  made.add_noise(5);
  const double memory = 16.0 / std::sqrt(16.0 * rate);  // s
  for (int s = 0; s < 2; ++s) {
    Samples& force = made.experiment.trials[CourseData::first_sine() + s].force;
    double past = 0.0;
    for (int i = 0; i < force.size(); ++i) {
      const double now = spring * CourseData::way(force.time[i], periods[s]);
      past += (1.0 - std::exp(-1.0 / (rate * memory))) * (now - past);
      force.value(i, 0) += (past - now) / 3.0;
    }
  }
  const auto all = made.symptoms();
  expect_value(all, "drive_history", "slow", 100.0 / 3.0);
  expect_value(all, "drive_history", "quick", 100.0 / 3.0);
}

// Late where it is slow and in time where it is quick, as no delay of an instrument is.
TEST(CourseSymptoms, ADelayThatHangsOnTheFrequency) {
  CourseData made;
  made.add_noise(6);
  made.experiment.trials.erase(made.experiment.trials.begin(),
                               made.experiment.trials.begin() + CourseData::first_sine());
  made.predictions.erase(made.predictions.begin(),
                         made.predictions.begin() + CourseData::first_sine());
  const double late = 0.02;
  const auto delay = [&](int trial) {
    made.experiment.trials[trial].markers.value -= late * made.predictions[trial].marker_velocity;
  };
  delay(0);
  expect_value(made.symptoms(), "delay_by_frequency", "", -1e3 * late);
  delay(1);  // late in both: a delay, and nothing else
  const auto all = made.symptoms();
  EXPECT_TRUE(strongest(all, "time_shift")->shows());
  expect_value(all, "delay_by_frequency", "", 0.0);
}

TEST(SymptomNumbers, AreTheClearestOfEachKind) {
  CourseData made;
  made.add_noise(7);
  made.change_force([](double t, double period) { return CourseData::speed(t, period); });
  Verdict verdict;
  verdict.outcome = Outcome::unknown;
  EXPECT_FALSE(nlohmann::json::parse(to_json(verdict)).contains("symptoms"));
  EXPECT_EQ(symptoms_text(verdict, 3), "");
  verdict.symptoms = symptom_numbers(made.symptoms());
  ASSERT_GT(verdict.symptoms.size(), 8u);
  EXPECT_TRUE(verdict.symptoms.front().shows);
  EXPECT_FALSE(verdict.symptoms.front().speaks_for.empty());
  std::set<std::string> seen;
  for (const SymptomNumber& one : verdict.symptoms) {
    EXPECT_TRUE(seen.insert(one.name).second) << one.name;
    EXPECT_GT(one.error, 0.0) << one.name;
  }
  const std::string json = to_json(verdict), text = symptoms_text(verdict, 2);
  EXPECT_NE(json.find("\"symptoms\""), std::string::npos);
  EXPECT_NE(json.find("\"speaks_for\""), std::string::npos);
  EXPECT_EQ(std::ranges::count(text, '\n'), 2);
  EXPECT_TRUE(text.starts_with("Seen: ")) << text;
  EXPECT_NE(text.find(" Speaks for "), std::string::npos) << text;
}

}  // namespace
}  // namespace pedicel::discrepancy
