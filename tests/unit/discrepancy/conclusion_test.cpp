// What is concluded from fits and alarms that are written down: which causes are named, which are
// competing models, and what is said of the rest.
#include "plugins/discrepancy/procedure/conclusion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "plugins/discrepancy/procedure/seen_ratios.h"
#include "tests/unit/discrepancy/made_diagnosis.h"

namespace pedicel::discrepancy {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Hypothesis with(const Hypothesis& base, const Hypothesis& added) {
  Hypothesis both = base;
  both.add(added);
  return both;
}

/// The first two of three trials are fitted. The baseline's modulus stands at 1.2 +- 0.01 (of its
/// logarithm) and leaves four times the noise variance; `best` and its competing model leave the
/// noise alone.
struct Case {
  MadeData made;
  DataSet data{made.experiment};
  Diagnosis diagnosis;
  Findings findings;

  Case() {
    diagnosis.admission.experiment = made.experiment;
    diagnosis.admission.points = 5000;
    diagnosis.fit_trials = findings.fit_trials = {0, 1};
    diagnosis.check_trials = {2};
    findings.data = &data;
    diagnosis.before = {50.0, 5.0, 0, true};
    diagnosis.base.hypothesis = hypothesis_of("youngs_modulus", "factor", 1.2, "1");
    diagnosis.base.standard_error = Eigen::VectorXd::Constant(1, 0.01);
    diagnosis.base.cost = 2.0 * findings.samples();
    findings.needed = {{"youngs_modulus"}, diagnosis.base, {}};
    diagnosis.ranking = {candidate("base_compliance", "stiffness", 640.0, 631.0)};
  }
  Candidate candidate(const std::string& cause, const std::string& parameter, double gain,
                      double evidence) const {
    Candidate made_one;
    made_one.cause = cause;
    made_one.fit.hypothesis =
        with(diagnosis.base.hypothesis, hypothesis_of(cause, parameter, 0.8, "1"));
    made_one.fit.hypothesis.free[1].unit = "N m/rad";
    made_one.fit.standard_error = Eigen::Vector2d(0.01, 0.02);
    made_one.fit.cost = 0.5 * findings.samples();
    made_one.gain = gain;
    made_one.evidence = evidence;
    made_one.whole = true;
    return made_one;
  }
  Verdict concluded() {
    if (!diagnosis.ranking.empty()) {
      if (findings.chain.empty()) findings.chain = {diagnosis.ranking.front()};
      diagnosis.best = diagnosis.ranking.front().fit;
    }
    conclude(findings, diagnosis);
    return diagnosis.verdict;
  }
};

std::vector<std::string> names(const Verdict& verdict) {
  std::vector<std::string> all;
  for (const NamedCause& cause : verdict.causes) all.push_back(cause.name);
  return all;
}

TEST(Conclusion, NamesTheBestWithItsNumbers) {
  Case c;
  const Verdict v = c.concluded();
  EXPECT_EQ(v.outcome, Outcome::named);
  ASSERT_THAT(names(v), ElementsAre("base_compliance"));
  const NamedCause& cause = v.causes.front();
  EXPECT_EQ(cause.evidence, 631.0);
  ASSERT_TRUE(cause.where);  // the end of the stem that is clamped, which no fit says
  EXPECT_EQ(cause.where->curve, "stem");
  EXPECT_EQ(cause.where->at, 0.0);
  // Of a logarithm: 0.8 exp(+- 1.96 x 0.02).
  const Estimate& stiffness = cause.parameters.at("stiffness").front();
  EXPECT_NEAR(stiffness.value, 0.8, 1e-12);
  EXPECT_NEAR(stiffness.low, 0.8 * std::exp(-0.0392), 1e-12);
  EXPECT_NEAR(stiffness.high, 0.8 * std::exp(0.0392), 1e-12);
  EXPECT_EQ(stiffness.unit, "N m/rad");
}

// A delay that the data alone would give to 0.01 ms, from fits with steps of 2 ms: uniformly within
// one, with a deviation of 2 ms / sqrt(12). A time constant stays as sharp as the data.
TEST(Conclusion, KnowsATimeToAStepAtBest) {
  Case c;
  c.findings.step = 0.002;
  Candidate& late = c.diagnosis.ranking.front();
  late.cause = "latency";
  late.fit.hypothesis =
      with(c.diagnosis.base.hypothesis, hypothesis_of("latency", "delay", 0.03, "s"));
  late.fit.hypothesis.free[1].logarithmic = false;
  late.fit.hypothesis.free[1].scale = 0.01;
  late.fit.standard_error = Eigen::Vector2d(0.01, 0.001);
  const Verdict v = c.concluded();
  ASSERT_THAT(names(v), ElementsAre("latency"));
  const Estimate& delay = v.causes.front().parameters.at("delay").front();
  const double deviation = std::hypot(0.002 / std::sqrt(12.0), 1.0e-5);
  EXPECT_NEAR(delay.high - delay.value, 1.96 * deviation, 1e-9);
  EXPECT_NEAR(delay.value - delay.low, 1.96 * deviation, 1e-9);

  Case other;
  other.findings.step = 0.002;
  Candidate& memory = other.diagnosis.ranking.front();
  memory = late;
  memory.cause = memory.fit.hypothesis.effects[1].name = "relaxation";
  memory.fit.hypothesis.free[1].name = "time";
  memory.fit.hypothesis.effects[1].numbers = {{"time", {0.03}}};
  const Verdict w = other.concluded();
  const Estimate& time = w.causes.front().parameters.at("time").front();
  EXPECT_NEAR(time.high - time.value, 1.96 * 1.0e-5, 1e-9);
}

// The margin is 3 nats and 0.2 % of the gain of 640: 4.28.
TEST(Conclusion, IsAmbiguousWithinTheMargin) {
  Case c;
  c.diagnosis.ranking.push_back(c.candidate("weak_segment", "factor", 630.0, 631.0 - 4.2));
  c.diagnosis.ranking.push_back(c.candidate("creep", "fraction", 630.0, 631.0 - 4.4));
  const Verdict v = c.concluded();
  EXPECT_EQ(v.outcome, Outcome::ambiguous);
  EXPECT_THAT(names(v), ElementsAre("base_compliance", "weak_segment"));
  ASSERT_EQ(v.competing.size(), 1u);
  EXPECT_EQ(v.competing[0].name, "creep");
  EXPECT_NEAR(v.competing[0].behind, 4.4, 1e-9);
}

// By 6 nats and 1.28 both others are too near.
TEST(Conclusion, TakesTheMarginFromItsSettings) {
  Case c;
  DiagnosisSettings settings;
  settings.levels.clear_odds = 6.0;
  c.findings.settings = &settings;
  c.diagnosis.ranking.push_back(c.candidate("weak_segment", "factor", 630.0, 631.0 - 4.2));
  c.diagnosis.ranking.push_back(c.candidate("creep", "fraction", 630.0, 631.0 - 4.4));
  EXPECT_THAT(names(c.concluded()), ElementsAre("base_compliance", "weak_segment", "creep"));
}

// A soft foot has three numbers where a soft root has one; where both leave the same, the data tell
// nothing. Evidence 10 nats behind is beyond the margin of 4.3.
TEST(Conclusion, FewerNumbersAloneDoNotRefute) {
  Case c;
  c.diagnosis.ranking.push_back(c.candidate("weak_segment", "factor", 639.5, 631.0 - 10.0));
  EXPECT_THAT(names(c.concluded()), ElementsAre("base_compliance", "weak_segment"));
  Case worse;
  worse.diagnosis.ranking.push_back(worse.candidate("weak_segment", "factor", 638.0, 621.0));
  EXPECT_THAT(names(worse.concluded()), ElementsAre("base_compliance"));
  Case much;
  much.diagnosis.ranking.push_back(much.candidate("gust", "drag_area", 640.0, 631.0 - 35.0));
  EXPECT_THAT(names(much.concluded()), ElementsAre("base_compliance"));
  Case more;
  Candidate competitor = more.candidate("force_gain", "gain", 640.0, 631.0 - 10.0);
  for (int i = 0; i < 3; ++i)
    competitor.fit.hypothesis.free.push_back(competitor.fit.hypothesis.free.back());
  competitor.fit.standard_error = Eigen::VectorXd::Constant(5, 0.02);
  more.diagnosis.ranking.push_back(competitor);
  EXPECT_THAT(names(more.concluded()), ElementsAre("base_compliance"));
}

TEST(Conclusion, OfALargeGainHasAMarginOf13Nats) {
  Case c;
  c.diagnosis.ranking[0].gain = 1e5;
  c.diagnosis.ranking.push_back(c.candidate("weak_segment", "factor", 0.0, 631.0 - 13.5));
  EXPECT_EQ(c.concluded().outcome, Outcome::named);
}

// The first trial pulls the number by 0.01, the second as much the other way: without either of
// them it moves by that, half of its deviation of 0.02.
TEST(Conclusion, SaysHowFarTheNumbersMoveWithoutATrial) {
  Case c;
  const int size = c.data.size(c.findings.fit_trials), first = c.data.size(std::array{0});
  FitSummary& fit = c.diagnosis.ranking[0].fit;
  fit.jacobian = Eigen::MatrixXd::Zero(size, 2);
  fit.jacobian.col(1).setOnes();
  fit.residual = Eigen::VectorXd::Constant(size, -0.01);
  fit.residual.head(first).setConstant(0.01);
  EXPECT_THAT(c.concluded().causes.front().because,
              HasSubstr("Without any one of the trials its numbers move by 0.5 deviations"));
}

TEST(Conclusion, PassesOverWhatWasNotFittedOrExplainsNothing) {
  Case c;
  c.diagnosis.ranking.push_back(c.candidate("weak_segment", "factor", 630.0, 630.0));
  c.diagnosis.ranking.back().whole = false;
  EXPECT_TRUE(c.concluded().competing.empty());
  Case d;
  d.diagnosis.ranking.push_back(d.candidate("weak_segment", "factor", 1.0, -1.0));
  EXPECT_TRUE(d.concluded().competing.empty());
}

TEST(Conclusion, DoesNotCallAWindOfNoSpeedACompetitorOfDrag) {
  Case c;
  c.diagnosis.ranking = {c.candidate("leaf_drag", "drag_area", 640.0, 631.0),
                         c.candidate("wind", "drag_area", 640.0, 628.0)};
  const Verdict v = c.concluded();
  EXPECT_EQ(v.outcome, Outcome::named);
  ASSERT_EQ(v.competing.size(), 1u);
  Case other;
  other.diagnosis.ranking = {other.candidate("wind", "drag_area", 640.0, 631.0),
                             other.candidate("leaf_drag", "drag_area", 640.0, 628.0)};
  EXPECT_EQ(other.concluded().outcome, Outcome::ambiguous);
}

// A gust has two more numbers than its wind, which gain 4.6 nats by chance once in a hundred times
// (half of chi-squared, 9.21). It is no competing model that gains 3; one that gains 6 is, 2 nats
// behind in evidence, and one that without the other trials stands another 5 nats before the wind.
TEST(Conclusion, CallsAGustACompetitorOfItsWindWhereItGainsMoreThanByChance) {
  Case c;
  c.findings.fit_trials = {0, 1, 2};
  const int size = c.data.size(c.findings.fit_trials);
  const std::array last{2};
  const int rest = size - c.data.size(last);
  const auto conclude = [&](double gain, double in_first, double in_last) {
    Candidate wind = c.candidate("wind", "drag_area", 640.0, 631.0);
    Candidate gust = c.candidate("gust", "drag_area", 640.0 + gain, 629.0);
    gust.fit.hypothesis.add(hypothesis_of("gust", "frequency", 1.0, "Hz"));
    gust.fit.hypothesis.add(hypothesis_of("gust", "amplitude", 0.5, "1"));
    gust.fit.standard_error = Eigen::Vector4d(0.01, 0.02, 0.1, 0.1);
    wind.fit.residual = gust.fit.residual = Eigen::VectorXd::Zero(size);
    wind.fit.residual[0] = std::sqrt(2.0 * in_first);
    wind.fit.residual[rest] = std::sqrt(2.0 * in_last);
    wind.fit.cost = in_first + in_last;
    gust.fit.cost = 0.0;
    c.diagnosis.ranking = {wind, gust};
    c.diagnosis.verdict = {};
    c.findings.chain.clear();
    return c.concluded().outcome;
  };
  EXPECT_EQ(conclude(3.0, 1.5, 1.5), Outcome::named);
  EXPECT_EQ(conclude(6.0, 3.0, 3.0), Outcome::ambiguous);
  EXPECT_EQ(conclude(3.0, 9.0, 0.0), Outcome::named);
  EXPECT_EQ(conclude(3.0, 10.0, 0.0), Outcome::ambiguous);
}

// 20 nats behind in all, because of the last trial alone: without it, ahead.
TEST(Conclusion, IsAmbiguousWhereOneTrialAloneDecides) {
  Case c;
  c.findings.fit_trials = {0, 1, 2};
  const int size = c.data.size(c.findings.fit_trials);
  const std::array last{2};
  const int rest = size - c.data.size(last);
  Candidate& best = c.diagnosis.ranking.front();
  best.fit.residual = Eigen::VectorXd::Zero(size);
  Candidate competitor = c.candidate("weak_segment", "factor", 620.0, 611.0);
  competitor.fit.residual = best.fit.residual;
  best.fit.residual[0] = std::sqrt(2.0 * 10.0);           // 10 nats worse there
  competitor.fit.residual[rest] = std::sqrt(2.0 * 30.0);  // 30 worse here
  best.fit.cost = 10.0, competitor.fit.cost = 30.0;
  c.diagnosis.ranking.push_back(competitor);
  EXPECT_EQ(c.concluded().outcome, Outcome::ambiguous);
  Case even = c;
  even.findings.data = &even.data;
  even.findings.chain.clear();
  even.diagnosis.verdict = {};
  even.diagnosis.ranking[0].fit.residual[0] = 0.0;
  even.diagnosis.ranking[0].fit.cost = 0.0;
  even.diagnosis.ranking[1].fit.residual[rest] = std::sqrt(2.0 * 15.0);
  even.diagnosis.ranking[1].fit.residual[0] = std::sqrt(2.0 * 15.0);
  EXPECT_EQ(even.concluded().outcome, Outcome::named);
}

TEST(Conclusion, OfSeveralCausesHasNoCompetitorsAmongThem) {
  Case c;
  c.diagnosis.ranking.push_back(c.candidate("weak_segment", "factor", 640.0, 630.0));
  Candidate both = c.diagnosis.ranking.front();
  c.findings.chain = {both, both};
  c.findings.chain[1].cause = "latency";
  c.diagnosis.ranking[0].fit.hypothesis.add(hypothesis_of("latency", "delay", 0.01, "s"));
  c.diagnosis.ranking[0].fit.standard_error = Eigen::Vector3d(0.01, 0.02, 0.1);
  const Verdict v = c.concluded();
  EXPECT_EQ(v.outcome, Outcome::named);
  EXPECT_THAT(names(v), ElementsAre("base_compliance", "latency"));
  EXPECT_EQ(v.causes[1].parameters.count("delay"), 1u);
  EXPECT_EQ(v.competing.size(), 1u);
}

// The alarm's direction would still gain half its square, and a tenth of the 640 nats that the
// cause gained is 64: 11.3^2 / 2.
TEST(Conclusion, IsUnknownWhereAnAlarmWouldStillGainMuch) {
  Case little, much;
  little.diagnosis.after = {11.0, 5.0, 0, true};
  much.diagnosis.after = {11.6, 5.0, 0, true};
  EXPECT_EQ(little.concluded().outcome, Outcome::named);
  EXPECT_EQ(much.concluded().outcome, Outcome::unknown);
}

// The baseline left 1.5 times the samples above the noise; of that 0.3 are a fifth.
TEST(Conclusion, IsUnknownWhereTooMuchIsLeft) {
  Case c;
  c.diagnosis.after = {8.0, 5.0, 0, true};
  c.diagnosis.ranking[0].fit.cost = (0.5 + 0.3) * c.findings.samples();
  const Verdict v = c.concluded();
  EXPECT_EQ(v.outcome, Outcome::unknown);
  EXPECT_EQ(v.remainder, "known causes leave 20 % of what the refitted model left above the noise");
  Verdict told = v;
  name_nothing(told);
  EXPECT_TRUE(told.causes.empty());
  EXPECT_EQ(told.remainder, v.remainder + "; the nearest known cause is base_compliance");
}

// The change that the cause makes on the held-out trials would gain 200 nats if it were right; the
// data there give it half of its size and less, or all of it.
TEST(Conclusion, IsUnknownWhereACauseDoesNotCarryOver) {
  Case c, d;
  c.diagnosis.ranking[0].held_out = {-50.0, 200.0};
  d.diagnosis.ranking[0].held_out = {200.0, 200.0};
  const Verdict v = c.concluded();
  EXPECT_EQ(v.outcome, Outcome::unknown);
  EXPECT_EQ(v.remainder, "what was fitted does not carry over to the held-out trials");
  EXPECT_EQ(d.concluded().outcome, Outcome::named);
}

// The first of two causes looks wrong there as long as the other one is missing: together they
// count.
TEST(Conclusion, SeveralCausesCarryOverTogether) {
  Case c;
  c.diagnosis.ranking[0].held_out = {-50.0, 200.0};
  const Candidate first = c.diagnosis.ranking[0];
  c.findings.chain = {first, first};
  c.findings.chain[1].cause = "latency";
  c.diagnosis.ranking[0].fit.hypothesis.add(hypothesis_of("latency", "delay", 0.01, "s"));
  c.diagnosis.ranking[0].fit.standard_error = Eigen::Vector3d(0.01, 0.02, 0.1);
  c.findings.held_out = {200.0, 200.0};
  EXPECT_EQ(c.concluded().outcome, Outcome::named);
  c.findings.held_out = {-50.0, 200.0};
  EXPECT_EQ(c.concluded().outcome, Outcome::unknown);
}

// What is in the data grows with time; the cause that was fitted dies out, and gains less than the
// same run backwards. Where it is the other way round, the decoys are told and lose.
TEST(Conclusion, IsUnknownWhereADecoyDoesAsWell) {
  Eigen::VectorXd dying = Eigen::VectorXd::Zero(Case().data.size(std::array{0, 1}));
  for (int i = 0; i < 301; ++i) dying[i] = 10.0 * std::exp(-0.02 * i);
  Eigen::VectorXd growing = dying;
  growing.head(301) = dying.head(301).reverse();
  const auto concluded = [&](const Eigen::VectorXd& in_the_data) {
    Case c;
    c.diagnosis.base.residual = in_the_data;
    c.diagnosis.ranking[0].fit.residual = in_the_data - dying;
    return c.concluded();
  };
  const Verdict wrong = concluded(growing), right = concluded(dying);
  EXPECT_EQ(wrong.outcome, Outcome::unknown);
  EXPECT_THAT(wrong.remainder, HasSubstr("backwards in time"));
  EXPECT_EQ(right.outcome, Outcome::named);
  EXPECT_THAT(right.causes[0].because, HasSubstr("Decoys of it gain less"));
}

TEST(Conclusion, IsUnknownWhereNothingExplainsTheAlarm) {
  Case c;
  c.diagnosis.ranking.clear();
  EXPECT_EQ(c.concluded().outcome, Outcome::unknown);
}

// Density that went far from what it was weighed to be took a mass over: no alarm, but a cause.
TEST(Conclusion, NamesWhatAPulledParameterHadTakenOver) {
  Case c;
  c.diagnosis.before.raised = false;
  c.findings.needed = {};
  const Verdict v = c.concluded();
  EXPECT_EQ(v.outcome, Outcome::named);
  EXPECT_THAT(names(v), ElementsAre("base_compliance"));
}

TEST(Conclusion, AParameterWithinWhatIsKnownIsADetail) {
  Case c;
  c.diagnosis.before.raised = false;
  c.diagnosis.ranking.clear();
  c.diagnosis.base.cost = 0.5 * c.findings.samples();
  c.made.experiment.plant().material.known_to.youngs_modulus = 0.25;
  const Verdict v = c.concluded();
  EXPECT_EQ(v.outcome, Outcome::adequate);
  EXPECT_THAT(v.causes, ::testing::IsEmpty());
  ASSERT_EQ(v.details.size(), 1u);
  EXPECT_EQ(v.details[0].name, "youngs_modulus");
  EXPECT_THAT(headline(v), HasSubstr("the plant is 20 % stiffer than the file says"));
}

TEST(Conclusion, WithoutAnAlarmNamesAParameterThatLeavesOutOne) {
  Case c;
  c.diagnosis.before.raised = false;
  c.diagnosis.ranking.clear();
  c.diagnosis.ranking.clear();
  c.diagnosis.base.cost = 0.5 * c.findings.samples();
  const Verdict v = c.concluded();
  EXPECT_EQ(v.outcome, Outcome::named);
  ASSERT_THAT(names(v), ElementsAre("youngs_modulus"));
  EXPECT_EQ(v.causes[0].because, "The refitted value is 1.2 times the nominal one.");
  // (ln 1.2 / 0.01)^2 / 2 nats
  EXPECT_NEAR(v.causes[0].evidence, 0.5 * std::pow(std::log(1.2) / 0.01, 2), 1e-6);
  // ln 1.2 = 0.182 against 3.5 deviations of 0.04, 0.002 that solvers differ by, and what is left
  // of our own error's shift.
  const double limit = (std::log(1.2) - 0.142) / Accuracy{}.left_uncorrected;
  for (const double shift : {0.95 * limit, -1.05 * limit}) {
    Case d;
    d.diagnosis.before.raised = false;
    d.diagnosis.ranking.clear();
    d.diagnosis.ranking.clear();
    d.diagnosis.base.standard_error[0] = 0.04;
    d.findings.needed.model = d.diagnosis.base;
    d.findings.parameter_shift = Eigen::VectorXd::Constant(1, shift);
    EXPECT_EQ(d.concluded().outcome, shift > 0.0 ? Outcome::named : Outcome::adequate) << shift;
  }
}

// A modulus that is 1.2 times nominal, or a density that is 1 / 1.2.
TEST(Conclusion, OfAParameterThatAnotherOneCouldStandForIsAmbiguous) {
  Case c;
  c.diagnosis.before.raised = false;
  c.diagnosis.ranking.clear();
  c.diagnosis.ranking.clear();
  c.findings.needed.instead = {{c.diagnosis.base, 2.5}};
  Hypothesis& instead = c.findings.needed.instead[0].model.hypothesis;
  instead = hypothesis_of("density", "factor", 1.0 / 1.2, "1");
  instead.name = "density";
  const Verdict v = c.concluded();
  EXPECT_EQ(v.outcome, Outcome::ambiguous);
  ASSERT_EQ(v.causes.size(), 2u);
  EXPECT_EQ(v.causes[0].name, "youngs_modulus");
  EXPECT_EQ(v.causes[1].name, "density");
  EXPECT_NEAR(v.causes[1].parameters.at("factor")[0].value, 1.0 / 1.2, 1e-12);
  EXPECT_NEAR(v.causes[0].evidence - v.causes[1].evidence, 2.5, 1e-9);
}

// 30 nats better than the parameter: worth a name of its own. At 10 it is but the likelier one.
TEST(Conclusion, ALawThatExplainsFarMoreThanTheParameterIsNamedAlone) {
  for (const double better : {30.0, 10.0}) {
    Case c;
    c.diagnosis.before.raised = false;
    c.diagnosis.ranking.clear();
    c.diagnosis.ranking.clear();
    c.findings.needed.instead = {{c.diagnosis.base, -better}};
    Hypothesis& instead = c.findings.needed.instead[0].model.hypothesis;
    instead = hypothesis_of("mass_damping", "rate", 3.0, "1/s");
    instead.name = "mass_damping";
    const Verdict v = c.concluded();
    if (better == 30.0) {
      EXPECT_EQ(v.outcome, Outcome::named);
      EXPECT_THAT(names(v), ElementsAre("mass_damping"));
      ASSERT_EQ(v.competing.size(), 1u);
      EXPECT_NEAR(v.competing[0].behind, 30.0, 1e-9);
      EXPECT_NE(v.causes[0].because.find("Another youngs_modulus"), std::string::npos);
    } else {
      EXPECT_EQ(v.outcome, Outcome::ambiguous);
      EXPECT_THAT(names(v), ElementsAre("mass_damping", "youngs_modulus"));
      EXPECT_TRUE(v.competing.empty());
    }
  }
}

// Its error says so, but the others can stand for it.
TEST(Conclusion, DoesNotBlameAParameterThatMayBeNominal) {
  Case c;
  c.diagnosis.before.raised = false;
  c.diagnosis.ranking.clear();
  c.diagnosis.ranking.clear();
  c.findings.needed.names.clear();
  EXPECT_EQ(c.concluded().outcome, Outcome::adequate);
}

TEST(Conclusion, OfASteadyDifferenceWithoutExcessIsAdequate) {
  Case c;
  c.diagnosis.ranking.clear();
  c.diagnosis.base.cost = 0.5 * 1.005 * c.findings.samples();
  c.diagnosis.base.standard_error[0] = 1.0;
  c.findings.needed.model = c.diagnosis.base;
  const Verdict v = c.concluded();
  EXPECT_EQ(v.outcome, Outcome::adequate);
  EXPECT_THAT(v.remainder, HasSubstr("a steady difference of 50 noise units in all"));
}

TEST(Conclusion, SaysWhichSymptomIsGone) {
  Case c;
  c.diagnosis.verdict.fit = {4.0, 2.0, 1.01};
  Symptom other, turn;
  other.value = turn.value = 1.0, other.standard_error = turn.standard_error = 0.01;
  other.sentence = "The loop is wide.";
  other.speaks_for = {"internal_friction"};
  turn.sentence = "At rest the plant is turned about its root.";
  turn.speaks_for = {"frame_rotation", "base_compliance"};
  c.findings.symptoms = {other, turn};
  const Verdict v = c.concluded();
  EXPECT_EQ(v.causes[0].because,
            "At rest the plant is turned about its root. With a root that turns elastically the "
            "residual falls from 2 to 1.01 times the noise in the fitted trials.");
}

// Not the first that shows: of two that speak for the cause the one with more deviations.
TEST(Conclusion, SaysTheClearestSymptom) {
  Case c;
  Symptom bend, turn, clearer;
  bend.value = turn.value = clearer.value = 1.0;
  bend.standard_error = 0.1, turn.standard_error = 0.01, clearer.standard_error = 0.001;
  bend.speaks_for = turn.speaks_for = {"base_compliance"};
  bend.sentence = "It is bent.";
  turn.sentence = "It is turned.";
  clearer.sentence = "It is late.";
  clearer.speaks_for = {"latency"};
  c.findings.symptoms = {bend, turn, clearer};
  EXPECT_THAT(c.concluded().causes[0].because, ::testing::StartsWith("It is turned. With a root"));
}

// A modulus that is known to 1 %: within it for certain, within it by chance, and off.
TEST(Conclusion, KnowsParametersThatCannotBeOff) {
  Case c;
  FitSummary model = c.diagnosis.base;
  model.cost = 0.5 * c.findings.samples();
  const auto knows = [&](double factor, double error) {
    model.hypothesis.set_value(0, factor);
    model.standard_error[0] = error;
    return knows_parameters(c.findings, model);
  };
  EXPECT_TRUE(knows(1.001, 0.002));
  EXPECT_TRUE(knows(0.999, 0.002));
  EXPECT_FALSE(knows(1.001, 0.004));
  EXPECT_FALSE(knows(1.2, 0.001));
  EXPECT_FALSE(knows(1.0, INFINITY));
  // Where more than noise is left its error is larger by that.
  model.cost *= 9.0;
  EXPECT_FALSE(knows(1.001, 0.002));
}

TEST(Conclusion, NamesOutliersBesideWhatIsKnown) {
  for (const Outcome outcome : {Outcome::adequate, Outcome::named, Outcome::unknown}) {
    Case c;
    c.diagnosis.verdict.outcome = outcome;
    c.diagnosis.admission.outliers = 50;
    conclude_outliers(c.diagnosis);
    const Verdict& v = c.diagnosis.verdict;
    if (outcome == Outcome::unknown) {
      EXPECT_TRUE(v.causes.empty());
      continue;
    }
    EXPECT_EQ(v.outcome, Outcome::named);
    ASSERT_EQ(names(v).back(), "outliers");
    // 50 of 5000, Poisson: 0.01 +- 1.96 sqrt(50) / 5000
    EXPECT_NEAR(v.causes.back().parameters.at("fraction")[0].value, 0.01, 1e-12);
    EXPECT_NEAR(v.causes.back().parameters.at("fraction")[0].high, 0.01277, 1e-5);
  }
  Case few;
  few.diagnosis.admission.outliers = 11;
  conclude_outliers(few.diagnosis);
  EXPECT_TRUE(few.diagnosis.verdict.causes.empty());
}

TEST(Conclusion, MeasuresErrorsAndTheGainOnTrialsKeptBack) {
  Case c;
  c.data.set_noise(white_noise(1e-3), white_noise(1.0));
  c.findings.chain = {c.diagnosis.ranking.front()};
  for (const int model : {nominal, refitted, extended}) {
    const double off = model == nominal ? 4e-3 : model == refitted ? 3e-3 : 1.5e-3;
    c.diagnosis.predictions[model] = c.made.predictions;
    for (Prediction& p : c.diagnosis.predictions[model]) p.markers.array() += off;
  }
  measure_errors(c.findings, c.diagnosis);
  const Verdict& v = c.diagnosis.verdict;
  EXPECT_NEAR(*v.fit.nominal, 4.0, 1e-9);
  EXPECT_NEAR(*v.fit.extended, 1.5, 1e-9);
  // The third trial has a force, too, which is predicted exactly.
  const double share = std::sqrt(18.0 / 21.0);
  EXPECT_NEAR(*v.check.refitted, 3.0 * share, 1e-9);
  EXPECT_NEAR(*v.gain, 1.5 * share / (3.0 * share - 1.0), 1e-9);
}

TEST(Conclusion, SaysWhereARefitMisleads) {
  for (const double nominal_error : {2.9e-3, 2.7e-3}) {
    Case c;
    c.data.set_noise(white_noise(1e-3), white_noise(1.0));
    for (const int model : {nominal, refitted, extended}) {
      c.diagnosis.predictions[model] = c.made.predictions;
      for (Prediction& p : c.diagnosis.predictions[model])
        p.markers.array() += model == nominal ? nominal_error : 3e-3;
    }
    measure_errors(c.findings, c.diagnosis);
    EXPECT_EQ(c.diagnosis.verdict.refit_misleads, nominal_error < 2.8e-3);
  }
}

// The derivatives of a swing by the logarithms of modulus and density are nearly opposite.
TEST(Conclusion, TellsTheRatioThatAloneIsSeen) {
  Case c;
  FitSummary& fit = c.diagnosis.best;
  fit.hypothesis = with(hypothesis_of("youngs_modulus", "factor", 1.5, "1"),
                        hypothesis_of("density", "factor", 1.25, "1"));
  fit.cost = 0.5 * c.findings.samples();
  fit.jacobian.resize(200, 2);
  for (int i = 0; i < 200; ++i) {
    const double ratio = std::sin(0.3 * i), both = 0.01 * std::cos(0.7 * i);
    fit.jacobian.row(i) << 10.0 * (ratio + both), 10.0 * (both - ratio);
  }
  report_ratios(c.findings, c.diagnosis);
  ASSERT_EQ(c.diagnosis.verdict.ratios.size(), 1u);
  const Estimate ratio = c.diagnosis.verdict.ratios.at("youngs_modulus/density");
  EXPECT_NEAR(ratio.value, 1.2, 1e-12);
  // 100 cycles' worth of squares: the error of the logarithm is 1 / (10 sqrt 100).
  EXPECT_NEAR(std::log(ratio.high / ratio.value), 1.96 * 0.01, 0.1 * 1.96 * 0.01);

  fit.jacobian.col(1).setRandom();
  c.diagnosis.verdict.ratios.clear();
  report_ratios(c.findings, c.diagnosis);
  EXPECT_TRUE(c.diagnosis.verdict.ratios.empty()) << "each is seen as closely";
}

TEST(Conclusion, ReportsTheMaterialInItsOwnUnits) {
  Case c;
  c.diagnosis.admission.experiment.plant().material.youngs_modulus = 2.0e8;
  c.diagnosis.best = c.diagnosis.base;
  c.diagnosis.best.cost = 0.5 * c.findings.samples();
  report_parameters(c.findings, c.diagnosis);
  const Estimate& modulus = c.diagnosis.verdict.parameters.at("youngs_modulus");
  EXPECT_NEAR(modulus.value, 2.4e8, 1.0);
  EXPECT_NEAR(modulus.high, 2.4e8 * std::exp(0.0196), 1.0);
  EXPECT_EQ(modulus.unit, "Pa");
}

}  // namespace
}  // namespace pedicel::discrepancy
