// Symptoms lead a search: which causes come first, and with which sizes they start. What no symptom
// speaks for is neither moved nor left out.
#include "plugins/discrepancy/select/symptom_starts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "plugins/discrepancy/select/candidate_starts.h"
#include "plugins/discrepancy/select/candidates.h"
#include "plugins/effects/registry/effect_definition.h"
#include "tests/unit/discrepancy/beam_experiment.h"

namespace pedicel::discrepancy {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A beam that is pulled aside and let go, and pushed while its force is measured.
Experiment pulled_and_pushed() {
  Experiment e = testing::experiment_of({}, 1.0, 0.02);
  Trial& trial = e.trials[0];
  trial.holds.push_back({testing::on_stem(0.8), testing::resting_at(Vec3(0.03, 0, 0.32)), 0.05});
  return e;
}

struct Led {
  Experiment experiment = pulled_and_pushed();
  effects::StartContext context = start_context(experiment, scales_of(experiment));
  std::vector<Cause> causes = candidate_causes(experiment, scales_of(experiment));

  const Cause& cause(const std::string& name) const {
    return *std::ranges::find(causes, name, &Cause::name);
  }
  /// The number of a start of a cause.
  double size(const std::string& name, const std::string& parameter) const {
    const Cause& one = cause(name);
    if (one.led.empty()) return std::nan("");
    const Hypothesis& start = one.led.front();
    const auto free = std::ranges::find(start.free, parameter, &FreeParameter::name);
    return start.value(static_cast<int>(free - start.free.begin()));
  }
};

Symptom symptom(const std::string& name, double value, double error) {
  Symptom made;
  made.name = name;
  made.value = value;
  made.standard_error = error;
  return made;
}

// To first order, from what the symptoms are defined as.
TEST(SymptomStarts, TakeTheirSizesFromTheNumbers) {
  Led led;
  const std::string told =
      lead(led.causes,
           {symptom("time_shift", 29.6, 0.5), symptom("force_lag", 12.0, 0.5),
            symptom("force_scale", -8.0, 0.2), symptom("length_scale", 1.5, 0.1),
            symptom("dynamic_over_static", 25.0, 1.0), symptom("clock_trend", 6.0, 0.5),
            symptom("base_rotation", 2.0, 0.05), symptom("frequency_by_amplitude", -3.0, 0.2)},
           led.context);
  EXPECT_NEAR(led.size("latency", "delay"), 0.0296, 1e-12);
  EXPECT_NEAR(led.size("force_gain", "gain"), 0.92, 1e-12);
  EXPECT_NEAR(led.size("marker_scale", "factor"), 1.015, 1e-12);
  EXPECT_NEAR(led.size("relaxation", "fraction"), 0.2, 1e-12);
  EXPECT_NEAR(led.size("creep", "fraction"), 0.2, 1e-12);
  EXPECT_NEAR(led.size("material_nonlinearity", "coefficient"), -0.08, 1e-12);
  // One trial of 1 s: 6 % in that.
  EXPECT_NEAR(led.size("stiffness_drift", "rate"), 0.06, 1e-12);
  const Scales& scales = led.context.scales;
  EXPECT_NEAR(led.size("base_compliance", "stiffness") * 2.0 * std::numbers::pi / 180.0,
              scales.root_stiffness * scales.length * scales.curvature, 1e-12);
  // Markers by the shift of times, the force by its own.
  std::map<std::string, double> lags;
  for (const Hypothesis& start : led.cause("sensor_lag").led)
    lags[start.effects[0].words.at("what")] = start.value(0);
  EXPECT_THAT(lags, ::testing::UnorderedElementsAre(
                        ::testing::Pair("markers", ::testing::DoubleNear(0.0296, 1e-12)),
                        ::testing::Pair("force", ::testing::DoubleNear(0.012, 1e-12))));
  EXPECT_THAT(told, HasSubstr("latency delay 0.0296 by time_shift"));
  // A start is the cause's own but for that number.
  const Cause& relaxation = led.cause("relaxation");
  for (const Hypothesis& start : relaxation.led)
    EXPECT_TRUE(std::ranges::any_of(relaxation.starts, [&](const Hypothesis& own) {
      return own.effects[0].words == start.effects[0].words && own.value(1) == start.value(1);
    }));
}

TEST(SymptomStarts, OfWhatDoesNotShowOrCannotBeThereAreNone) {
  Led led;
  lead(led.causes,
       {symptom("time_shift", 1.0, 0.5), symptom("force_lag", -12.0, 0.5),
        symptom("dynamic_over_static", -25.0, 1.0)},
       led.context);
  EXPECT_THAT(led.cause("latency").led, IsEmpty());  // 2 deviations
  EXPECT_EQ(led.cause("latency").spoken_for, 0.0);
  EXPECT_THAT(led.cause("sensor_lag").led, IsEmpty());  // ahead of the drive is no lag
  EXPECT_THAT(led.cause("relaxation").led, IsEmpty());  // softer when it swings
  EXPECT_GT(led.cause("relaxation").spoken_for, 0.0);
  // Another model's symptoms say nothing of this one.
  EXPECT_EQ(lead(led.causes, {}, led.context), "");
  EXPECT_EQ(led.cause("relaxation").spoken_for, 0.0);
}

TEST(SymptomStarts, PutWhatIsSpokenForFirstAndLeaveNothingOut) {
  Led led;
  lead(led.causes, {symptom("length_scale", 1.0, 0.1), symptom("time_shift", 30.0, 0.5)},
       led.context);
  std::vector<double> score(led.causes.size(), 0.0);
  score.back() = 7.0;
  const std::vector<int> order = symptoms_first(led.causes, score);
  std::vector<std::string> names;
  for (const int i : order) names.push_back(led.causes[i].name);
  // 60 deviations, half of them for a lag, 10, half of them for an offset of a marker.
  EXPECT_THAT(std::vector<std::string>(names.begin(), names.begin() + 5),
              ElementsAre("latency", "sensor_lag", "marker_scale", "marker_offset",
                          led.causes.back().name));
  std::ranges::sort(names);
  EXPECT_EQ(std::ranges::adjacent_find(names), names.end());
  EXPECT_EQ(names.size(), led.causes.size());
}

// Every number that a definition promises is one that its fits have, and every word one of its own.
TEST(SymptomStarts, AreOfNumbersThatFitsHave) {
  Led led;
  int promised = 0;
  for (const effects::EffectDefinition& one : effects::effect_definitions())
    for (const effects::Sign& sign : one.speaks_for) {
      EXPECT_EQ(sign.parameter.empty(), sign.value == nullptr) << one.name;
      if (!sign.value) continue;
      ++promised;
      EXPECT_TRUE(one.find(sign.parameter)) << one.name << " " << sign.parameter;
      const std::vector<effects::Start> starts = one.starts(led.context);
      EXPECT_TRUE(std::ranges::any_of(
          starts,
          [&](const effects::Start& start) {
            const bool word = sign.word.empty() ||
                              std::ranges::any_of(start.effect().words, [&](const auto& own) {
                                return own.second == sign.word;
                              });
            return word && std::ranges::find(start.free(), sign.parameter,
                                             &effects::FreeParameter::name) != start.free().end();
          }))
          << one.name << " " << sign.parameter;
    }
  EXPECT_GE(promised, 12);
}

// The best start of a cause is the one that the symptom gives, where its own are far off: a swing
// seen 60 ms late, in the second half of its first period.
TEST(SymptomStarts, LeadNearerThanTheCausesOwn) {
  Led led;
  const Numerics numerics{0.05, 1.0 / 240.0};
  const double late = 0.06;
  Simulator simulator(led.experiment, numerics, 1);
  Variant variant;
  variant.effects = {testing::effect("latency", "delay", {late})};
  const Simulator::Request request{&variant, 0};
  led.experiment.trials[0].markers.value = simulator.run(std::span(&request, 1)).front().markers;
  DataSet data(led.experiment);
  data.set_noise(white_noise(2e-4), white_noise(1.0));
  Evaluator evaluator(simulator, data);
  FitOptions options;
  options.trials = {0};
  FitOptions none = options;
  none.iterations = 0;
  const FitSummary base = fit(evaluator, Hypothesis{}, none);
  Cause latency = led.cause("latency");
  const auto cost = [&] {
    const std::vector<Hypothesis> best = best_starts(evaluator, base, latency, options, 1);
    return scan(evaluator, best, options).cost.front();
  };
  const double own = cost();
  std::vector<Cause> causes{latency};
  // A tenth off, as symptoms of large delays are.
  lead(causes, {symptom("time_shift", 1e3 * 0.9 * late, 0.5)}, led.context);
  latency = causes.front();
  EXPECT_LT(cost(), 0.1 * own);
}

}  // namespace
}  // namespace pedicel::discrepancy
