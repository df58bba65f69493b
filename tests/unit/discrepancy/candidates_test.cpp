// Refits of a handful of causes on a beam whose data were simulated with one of them: it must be
// first, with its size, and the alarm must be about it. Without it there must be no alarm.
#include "plugins/discrepancy/select/candidates.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/core/random.h"
#include "plugins/discrepancy/select/candidate_starts.h"
#include "plugins/discrepancy/select/evidence.h"
#include "plugins/discrepancy/select/needed_parameters.h"
#include "plugins/discrepancy/test/score_test.h"
#include "tests/unit/discrepancy/beam_experiment.h"

namespace pedicel::discrepancy {
namespace {

constexpr double noise = 2.0e-4;  // m
constexpr Numerics numerics{0.05, 1.0 / 240.0};

/// Pulled aside along x and along y and let go; measured with white noise.
struct Hidden {
  Experiment experiment;
  DataSet data;
  std::vector<std::unique_ptr<Simulator>> simulators;
  std::vector<Evaluator> workers;
  FitOptions options;
  FitSummary base;
  std::vector<Cause> causes;

  explicit Hidden(const std::vector<plant::Effect>& effects)
      : experiment(made(effects)), data(experiment) {
    data.set_noise(white_noise(noise), white_noise(1.0));
    options.trials = {0, 1};
    for (int i = 0; i < 2; ++i) {
      simulators.push_back(std::make_unique<Simulator>(experiment, numerics, 1));
      workers.emplace_back(*simulators.back(), data);
    }
    base = fit(workers[0], baseline(), options);
    for (Cause& cause : candidate_causes(experiment, scales_of(experiment)))
      for (const char* chosen : {"base_compliance", "latency", "marker_scale", "anisotropy"})
        if (cause.name == chosen) causes.push_back(std::move(cause));
  }

  static Experiment made(const std::vector<plant::Effect>& effects) {
    testing::Beam beam;
    beam.damping_time = 0.01;
    Experiment e = testing::experiment_of(beam, 1.0, 0.02);
    e.plant().distance = 0.05;
    Trial& trial = e.trials[0];
    trial.force = {};
    trial.gravity = Vec3(0, 0, -9.81);
    trial.holds.push_back(
        {testing::on_stem(0.8), testing::resting_at(Vec3(0.03, 0, 0.8 * beam.length)), 0.2, 20.0});
    e.trials.push_back(trial);
    e.trials[1].name = "two";
    e.trials[1].holds[0].path = testing::resting_at(Vec3(0, 0.03, 0.8 * beam.length));
    Variant variant;
    variant.effects = effects;
    Simulator simulator(e, numerics, 1);
    Random random(21);
    for (int t = 0; t < 2; ++t) {
      const Simulator::Request request{&variant, t};
      Eigen::MatrixXd seen = simulator.run(std::span(&request, 1)).front().markers;
      for (double& x : seen.reshaped()) x += noise * random.normal();
      e.trials[t].markers.value = seen;
    }
    return e;
  }
};

TEST(Candidates, PutTheHiddenCauseFirstWithItsSize) {
  const double stiffness = 15.0 * scales_of(Hidden::made({})).root_stiffness;
  Hidden hidden({testing::effect("base_compliance", "stiffness", {stiffness})});
  std::vector<Direction> directions =
      directions_of(hidden.workers[0], hidden.base, hidden.causes, hidden.options);
  const Alarm alarm = judge(directions, hidden.base, {}, 1, {});
  EXPECT_TRUE(alarm.raised);
  // Directions hold nothing that the baseline can take up, what is known beforehand counted.
  const Eigen::VectorXd weight = prior_rows(hidden.base).weight;
  for (const Direction& direction : directions)
    EXPECT_LT((hidden.base.jacobian.transpose() * direction.change +
               weight.cwiseProduct(direction.against))
                  .norm(),
              1e-6 * hidden.base.jacobian.norm() * (1.0 + direction.change.norm()));
  const std::vector<Candidate> ranking =
      refit_all({hidden.workers, hidden.workers}, hidden.base, hidden.causes, directions,
                {hidden.options, {}, {}, nullptr});
  ASSERT_EQ(ranking.size(), hidden.causes.size());
  const Candidate& best = ranking.front();
  EXPECT_EQ(best.cause, "base_compliance");
  EXPECT_TRUE(best.whole);
  const int last = best.fit.hypothesis.size() - 1;
  EXPECT_NEAR(std::log(best.fit.hypothesis.value(last) / stiffness), 0.0,
              5.0 * best.fit.standard_error[last]);
  EXPECT_GT(best.evidence, 25.0);
  EXPECT_TRUE(std::ranges::is_sorted(
      ranking, [](const Candidate& a, const Candidate& b) { return a.evidence > b.evidence; }));
  // Nothing but noise is left: the cost is half of chi-square with as many numbers, sqrt(n / 2).
  const int samples = hidden.data.samples(hidden.options.trials);
  EXPECT_NEAR(best.fit.cost, 0.5 * samples, 5.0 * std::sqrt(0.5 * samples));
}

// The same where the data are far from the base, so that first parts rank: whatever symptoms speak
// for, the cause that none speaks for is not cut. What is done only grows.
TEST(Candidates, AreNotCutWhereOtherSymptomsLead) {
  const double stiffness = 1.5 * scales_of(Hidden::made({})).root_stiffness;
  Hidden hidden({testing::effect("base_compliance", "stiffness", {stiffness})});
  ASSERT_GT(2.0 * hidden.base.cost,
            2.0 * Evidence{}.far_from_data * hidden.data.samples(hidden.options.trials));
  std::vector<Direction> directions =
      directions_of(hidden.workers[0], hidden.base, hidden.causes, hidden.options);
  judge(directions, hidden.base, {}, 1, {});
  DiagnosisSettings settings;
  settings.budget.first_led = 2;
  // Far below what is there, so that the mark counts.
  settings.budget.large_gain = 10.0;
  settings.budget.lost_by = 5.0;
  hidden.options.settings = &settings;
  for (Cause& cause : hidden.causes)
    if (cause.name == "latency" || cause.name == "marker_scale") {
      cause.spoken_for = 1e3;
      cause.led = {cause.starts.front().shrunk(3.0)};
    }
  std::vector<double> shares;
  std::vector<Evaluator> one{hidden.workers[0]};
  const std::vector<Candidate> ranking =
      refit_all({one, one}, hidden.base, hidden.causes, directions,
                {hidden.options, {1}, [&](double share) { shares.push_back(share); }, nullptr});
  ASSERT_EQ(ranking.size(), hidden.causes.size());
  EXPECT_EQ(ranking.front().cause, "base_compliance");
  const FitSummary& best = ranking.front().fit;
  EXPECT_NEAR(std::log(best.hypothesis.value(best.hypothesis.size() - 1) / stiffness), 0.0,
              5.0 * best.standard_error[best.hypothesis.size() - 1]);
  ASSERT_GT(shares.size(), 6u);
  EXPECT_TRUE(std::ranges::is_sorted(shares));
  EXPECT_LE(shares.back(), 1.0);
  EXPECT_GT(shares.back(), 0.9);
}

TEST(Candidates, OfNothingHiddenRaiseNoAlarm) {
  Hidden nothing({});
  std::vector<Direction> directions =
      directions_of(nothing.workers[0], nothing.base, nothing.causes, nothing.options);
  EXPECT_FALSE(judge(directions, nothing.base, {}, 1, {}).raised);
  EXPECT_LT(std::ranges::max(score_statistics(nothing.causes, directions)), 5.0);
}

// A threshold just below the sharpest bend lies between one that does nothing and one that does too
// much: with either as it stands the fit has nowhere to go.
TEST(Candidates, FindAThresholdBetweenTwoStarts) {
  Hidden plain({});
  Cause yield;
  for (Cause& cause : candidate_causes(plain.experiment, scales_of(plain.experiment)))
    if (cause.name == "yield") yield = std::move(cause);
  const auto with = [&](double curvature) {
    Hypothesis model = plain.base.hypothesis;
    model.add(yield.starts[0]);
    model.set_value(model.size() - 1, curvature);
    return model;
  };
  const auto change = [&](double curvature) {
    const Hypothesis model = with(curvature);
    const Eigen::MatrixXd r = plain.workers[0].residuals(std::span(&model, 1), plain.options);
    return (r.col(0) - plain.base.residual).norm();
  };
  std::size_t still = 0;  // the first start that does nothing
  while (still < yield.starts.size() && change(yield.starts[still].value(0)) > 1e-3) ++still;
  ASSERT_GT(still, 0u);
  ASSERT_LT(still, yield.starts.size());
  double low = yield.starts[still - 1].value(0), high = yield.starts[still].value(0);
  ASSERT_GT(change(low), 100.0);
  double hidden_at = low, changes = 0.0;
  for (int i = 0; i < 60 && (changes < 20.0 || changes > 40.0); ++i) {
    hidden_at = std::sqrt(low * high);
    changes = change(hidden_at);
    (changes > 40.0 ? low : high) = hidden_at;
  }
  Hidden hidden({testing::effect("yield", "curvature", {hidden_at})});
  // About a model that has taken up nothing of it.
  FitOptions none = hidden.options;
  none.iterations = 0;
  const FitSummary base = fit(hidden.workers[0], plain.base.hypothesis, none);
  const auto start = best_plain_start(hidden.workers[0], base, yield, hidden.options);
  ASSERT_TRUE(start);
  EXPECT_NEAR(start->value(start->size() - 1) / hidden_at, 1.0, 0.01);
  const Scan found = scan(hidden.workers[0], std::span(&*start, 1), hidden.options);
  EXPECT_LT(found.cost[0], base.cost - 50.0);
}

// Of a single upright stem the twin is the same plant: EI along the direction and across it are
// what they were. Only the stretch differs, by a part of (r/L)^2.
TEST(Candidates, TwinOfAnAnisotropyIsTheSameUprightStem) {
  Hidden hidden({});
  Hypothesis model = hidden.base.hypothesis;
  for (const Cause& cause : hidden.causes)
    if (cause.name == "anisotropy") model.add(cause.starts[0]);
  for (int p = 0; p < model.size(); ++p)
    if (model.free[p].name == "ratio")
      model.set_value(p, 1.4);
    else if (model.free[p].name == "heading")
      model.set_value(p, 0.5);
  const std::optional<Hypothesis> twin = twin_of(model);
  ASSERT_TRUE(twin);
  EXPECT_NEAR(twin->value(twin->factor_on("youngs_modulus")),
              1.4 * model.value(model.factor_on("youngs_modulus")), 1e-12);
  const std::vector<Hypothesis> both{model, *twin};
  const Eigen::MatrixXd r = hidden.workers[0].residuals(both, hidden.options);
  const double change = (r.col(0) - hidden.base.residual).norm();
  EXPECT_LT((r.col(1) - r.col(0)).norm(), 0.01 * change);
  EXPECT_GT(change, 10.0);
  EXPECT_FALSE(twin_of(hidden.base.hypothesis));
}

// Modulus and damping move the prediction alike, along one shape. Asked for more of the modulus
// than its bound, damping takes over the rest; asked for within the bounds, both do what they were
// asked.
TEST(Candidates, StartsLeaveToOthersWhatABoundForbids) {
  FitSummary model;
  model.hypothesis = baseline();
  const int modulus = model.hypothesis.factor_on("youngs_modulus"),
            damping = model.hypothesis.factor_on("damping_time");
  model.jacobian = Eigen::MatrixXd::Zero(2, 3);
  model.jacobian(0, modulus) = 1e4;
  model.jacobian(0, damping) = 1e4;
  model.jacobian(1, damping) = 1e2;
  const double bound = model.hypothesis.high()[modulus];
  Eigen::VectorXd wanted = Eigen::VectorXd::Zero(3);
  wanted[modulus] = bound + 0.7;
  Eigen::VectorXd step = allowed_step(model, wanted, {});
  EXPECT_NEAR(step[modulus], bound, 1e-9);
  EXPECT_NEAR(step[damping], 0.7, 1e-3);
  wanted << 0.0, 0.0, 0.0;
  wanted[modulus] = 0.3;
  wanted[damping] = -0.1;
  step = allowed_step(model, wanted, {});
  EXPECT_NEAR(step[modulus] + step[damping], 0.2, 1e-6);
  EXPECT_NEAR(step[damping], -0.1, 1e-3);
}

// ln(1000) / 2 a number, and the choice between 20.
TEST(Candidates, CostHalfALogarithmANumber) {
  EXPECT_NEAR(cost_of(3, 1000, 20), 1.5 * std::log(1000.0) + std::log(20.0), 1e-12);
}

// Modulus and density nearly make up for each other in a swing, damping stands apart: only what was
// changed may be called needed.
TEST(NeededParameters, AreThoseThatWereChanged) {
  const auto needed = [](const std::vector<plant::Effect>& effects) {
    Hidden hidden(effects);
    return needed_parameters(hidden.workers[0], hidden.base, hidden.causes, hidden.options).names;
  };
  EXPECT_TRUE(needed({}).empty());
  EXPECT_EQ(needed({testing::effect("youngs_modulus", "factor", {1.1})}),
            std::vector<std::string>{"youngs_modulus"});
  EXPECT_EQ(needed({testing::effect("damping_time", "factor", {0.8})}),
            std::vector<std::string>{"damping_time"});
}

}  // namespace
}  // namespace pedicel::discrepancy
