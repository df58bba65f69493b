// How much of the misfit each cause explains, on a beam whose data were simulated with known
// effects: shares and changes have plain values there.
#include "plugins/discrepancy/procedure/shares.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/core/random.h"
#include "tests/unit/discrepancy/beam_experiment.h"
#include "tests/unit/discrepancy/made_diagnosis.h"

namespace pedicel::discrepancy {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double noise = 2.0e-4;  // m
constexpr Numerics numerics{0.05, 1.0 / 240.0};

std::vector<std::string> names(const std::vector<NamedCause>& causes) {
  std::vector<std::string> all;
  for (const NamedCause& cause : causes) all.push_back(cause.name);
  return all;
}

Hypothesis offset_of_the_tip(double x) {
  Hypothesis offset;
  offset.name = "marker_offset";
  plant::Effect effect = testing::effect("marker_offset", "offset", {x, 0.0, 0.0});
  effect.words["marker"] = "tip";
  offset.effects = {effect};
  FreeParameter free;
  free.name = "offset";
  free.unit = "m";
  free.low = -0.1;
  free.high = 0.1;
  free.scale = 1.0e-3;
  free.logarithmic = false;
  free.vanishes = Vanishes::at_zero;
  offset.free = {free};
  return offset;
}

/// Pulled aside and let go: along x and y for the fit, along both for the check.
struct Pulled {
  Experiment experiment;
  DataSet data;
  Simulator simulator;
  Evaluator evaluator;
  FitOptions options;
  Diagnosis diagnosis;
  Findings findings;

  explicit Pulled(const std::vector<plant::Effect>& effects)
      : experiment(made(effects)),
        data(experiment),
        simulator(experiment, numerics, 1),
        evaluator(simulator, data) {
    data.set_noise(white_noise(noise), white_noise(1.0));
    options.trials = diagnosis.fit_trials = findings.fit_trials = {0, 1};
    diagnosis.check_trials = {2};
    diagnosis.admission.experiment = experiment;
    findings.data = &data;
    diagnosis.base = fit(evaluator, baseline(), options);
  }

  static Experiment made(const std::vector<plant::Effect>& effects) {
    testing::Beam beam;
    beam.damping_time = 0.01;
    Experiment e = testing::experiment_of(beam, 1.0, 0.02);
    e.plant().distance = 0.05;
    e.trials[0].force = {};
    e.trials[0].gravity = Vec3(0, 0, -9.81);
    e.trials.resize(3, e.trials[0]);
    const Vec3 held(0, 0, 0.8 * beam.length);
    const std::array aside{Vec3(0.03, 0, 0), Vec3(0, 0.03, 0), Vec3(0.02, 0.02, 0)};
    Variant variant;
    variant.effects = effects;
    Simulator simulator(e, numerics, 1);
    for (int t = 0; t < 3; ++t)
      e.trials[t].holds.push_back(
          {testing::on_stem(0.8), testing::resting_at(held + aside[t]), 0.2, 20.0});
    Random random(21);
    for (int t = 0; t < 3; ++t) {
      const Simulator::Request request{&variant, t};
      Eigen::MatrixXd seen = simulator.run(std::span(&request, 1)).front().markers;
      for (double& x : seen.reshaped()) x += noise * random.normal();
      e.trials[t].markers.value = seen;
    }
    return e;
  }

  /// The verdict names the offset alone, as it was found beside a silently refitted baseline.
  void find_offset() {
    Candidate candidate;
    candidate.cause = "marker_offset";
    Hypothesis with = diagnosis.base.hypothesis;
    with.add(offset_of_the_tip(1.0e-4));
    diagnosis.best = candidate.fit = fit(evaluator, with, options);
    findings.chain = {candidate};
    diagnosis.ranking = {candidate};
    diagnosis.verdict.outcome = Outcome::named;
    diagnosis.verdict.causes = {findings.named(candidate, diagnosis.best, 3, {})};
  }
};

plant::Effect hidden_offset(double x) {
  return offset_of_the_tip(x).effects.front();
}

// One of two markers sits 2 mm elsewhere in all trials: the RMS of what that changes is
// 2 mm / sqrt(2), and it explains all that is wrong but for the noise of some 600 samples.
TEST(Shares, OfTheOnlyCauseIsAll) {
  Pulled pulled({hidden_offset(2.0e-3)});
  pulled.find_offset();
  tell_shares(pulled.evaluator, pulled.findings, pulled.options, pulled.diagnosis);
  const Verdict& v = pulled.diagnosis.verdict;
  ASSERT_THAT(names(v.causes), ElementsAre("marker_offset"));
  EXPECT_THAT(v.details, IsEmpty());
  EXPECT_NEAR(v.causes[0].share.fit.value(), 1.0, 0.02);
  EXPECT_NEAR(v.causes[0].share.check.value(), 1.0, 0.04);
  EXPECT_NEAR(v.causes[0].change.marker.value(), 2.0e-3 / std::sqrt(2.0), 5.0e-5);
  EXPECT_FALSE(v.causes[0].change.force);
}

// Beside a modulus that is 30 % off, a marker that sits a third of a millimetre elsewhere is real
// and does not matter.
TEST(Shares, PutWhatMattersFirst) {
  Pulled pulled({testing::effect("youngs_modulus", "factor", {0.7}), hidden_offset(0.3e-3)});
  pulled.find_offset();
  tell_shares(pulled.evaluator, pulled.findings, pulled.options, pulled.diagnosis);
  const Verdict& v = pulled.diagnosis.verdict;
  ASSERT_THAT(names(v.causes), ElementsAre("youngs_modulus"));
  ASSERT_THAT(names(v.details), ElementsAre("marker_offset"));
  EXPECT_EQ(v.outcome, Outcome::named);
  EXPECT_GT(v.causes[0].share.fit.value(), 0.98);
  EXPECT_LT(v.details[0].share.fit.value(), 0.02);
  EXPECT_GT(v.details[0].share.fit.value(), 0.0);
  EXPECT_NEAR(v.details[0].change.marker.value(), 0.3e-3 / std::sqrt(2.0), 3.0e-5);
  EXPECT_NEAR(v.causes[0].parameters.at("factor")[0].value, 0.7, 0.01);
  EXPECT_THAT(headline(v),
              HasSubstr("% softer than the file says (youngs_modulus): this explains"));
  EXPECT_THAT(headline(v), HasSubstr("Beside it a marker that sits elsewhere"));
}

// The plant file may say that the modulus is known to no better than that.
TEST(Shares, KeepAParameterWithinWhatIsKnownOutOfTheCauses) {
  Pulled pulled({testing::effect("youngs_modulus", "factor", {0.9}), hidden_offset(3.0e-3)});
  pulled.experiment.plant().material.known_to.youngs_modulus = 0.2;
  pulled.find_offset();
  tell_shares(pulled.evaluator, pulled.findings, pulled.options, pulled.diagnosis);
  EXPECT_THAT(names(pulled.diagnosis.verdict.causes), ElementsAre("marker_offset"));
  pulled.experiment.plant().material.known_to.youngs_modulus = 0.05;
  pulled.find_offset();
  tell_shares(pulled.evaluator, pulled.findings, pulled.options, pulled.diagnosis);
  EXPECT_THAT(names(pulled.diagnosis.verdict.causes),
              ::testing::UnorderedElementsAre("marker_offset", "youngs_modulus"));
}

// What excludes each other stays a choice; the modulus stands beside it.
TEST(Shares, LeaveAnAmbiguityAsItIsWhereItMatters) {
  Pulled pulled({testing::effect("youngs_modulus", "factor", {0.95}), hidden_offset(5.0e-3)});
  pulled.find_offset();
  Verdict& v = pulled.diagnosis.verdict;
  v.outcome = Outcome::ambiguous;
  v.causes.push_back(v.causes.front());
  tell_shares(pulled.evaluator, pulled.findings, pulled.options, pulled.diagnosis);
  EXPECT_EQ(v.outcome, Outcome::ambiguous);
  EXPECT_THAT(names(v.causes), ElementsAre("marker_offset", "marker_offset"));
  EXPECT_THAT(names(v.details), ElementsAre("youngs_modulus"));
}

// The extended model of made data leaves their noise alone, and the refitted one a turned root.
TEST(Left, IsNoiseWhereTheCauseIsRightAndAllWhereItWasTakenBack) {
  Diagnosis d = made_diagnosis();
  DataSet data(d.admission.experiment);
  data.set_noise(d.position_noise, d.force_noise);
  Findings findings;
  findings.data = &data;
  tell_left(findings, d);
  const LeftMisfit& left = d.verdict.left;
  EXPECT_NEAR(left.share.fit.value(), 0.0, 0.01);
  EXPECT_NEAR(left.share.check.value(), 0.0, 0.01);
  EXPECT_NEAR(left.times_noise.fit.value(), 1.0, 0.05);
  EXPECT_NEAR(left.times_noise.check.value(), 1.0, 0.05);
  ASSERT_EQ(left.channels.size(), 2u);
  EXPECT_EQ(left.channels[0].name, "force");
  EXPECT_FALSE(left.channels[0].share) << "the force is right in both";
  EXPECT_EQ(left.channels[1].name, "position");
  EXPECT_NEAR(left.channels[1].share.value(), 0.0, 0.01);
  EXPECT_THAT(left.symptoms, IsEmpty());
  d.verdict.causes.clear();
  tell_left(findings, d);
  EXPECT_DOUBLE_EQ(left.share.fit.value(), 1.0);
  EXPECT_GT(left.times_noise.fit.value(), 5.0);
  EXPECT_THAT(left.symptoms, ::testing::Contains("base_rotation"));
}

}  // namespace
}  // namespace pedicel::discrepancy
