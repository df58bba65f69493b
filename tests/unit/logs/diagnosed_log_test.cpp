// Logs of scripted runs as measured data: what was not hidden is not found, what was is named.
#include <gtest/gtest.h>

#include "app/verbs/import_log.h"
#include "plugins/discrepancy/files/experiment_files.h"
#include "plugins/discrepancy/scene_procedure/scene_diagnosis.h"
#include "tests/unit/logs/logged_run.h"

namespace pedicel::app {
namespace {

using discrepancy::ArmAtStem;

class DiagnosedLog : public ::testing::Test {
 protected:
  /// Runs a scene in which something is other than believed three times, with other motions of the
  /// arm, and diagnoses their logs by the scene as it is believed to be: a stem of 1e9 Pa, 30 mm
  /// beside the finger.
  discrepancy::SceneDiagnosis diagnose(const std::function<void(ArmAtStem&)>& hide = {}) {
    ArmAtStem believed;
    believed.coupling = "{friction: 0.5, contact_stiffness: 1.0e5, margin: 1.0e-5}";
    believed.write_all();
    ImportArguments a;
    int number = 0;
    for (const double swing : {0.12, 0.16, 0.09}) {
      const LoggedRun run("0.03", 1.2, [&](ArmAtStem& files) {
        files.swing = swing;
        if (hide) hide(files);
        files.coupling = "{friction: 0.5, contact_stiffness: 1.0e5, margin: 1.0e-5}";
      });
      const auto log = believed.path() / ("push_" + std::to_string(++number) + ".mcap");
      std::filesystem::copy_file(run.log_file(), log);
      a.files.push_back(log.string());
    }
    a.scene = (believed.path() / "scene.yaml").string();
    a.out = (believed.path() / "experiment").string();
    a.quiet = true;
    EXPECT_EQ(import_verb(a), 0);
    Diagnostics diagnostics;
    const auto experiment = discrepancy::read_experiment(a.out, diagnostics);
    if (!experiment) throw InvalidFile(diagnostics);
    discrepancy::SceneDiagnosisOptions options;
    options.threads = 2;
    return discrepancy::diagnose_scene(*experiment, options);
  }
};

TEST_F(DiagnosedLog, OfTheSceneItselfIsAdequate) {
  const discrepancy::SceneDiagnosis found = diagnose();
  EXPECT_EQ(found.verdict.outcome, discrepancy::Outcome::adequate) << found.text;
  EXPECT_TRUE(found.verdict.causes.empty()) << found.text;
}

TEST_F(DiagnosedLog, NamesWhatTheRunHad) {
  const discrepancy::SceneDiagnosis found =
      diagnose([](ArmAtStem& files) { files.modulus = "1.2e9"; });
  EXPECT_EQ(found.verdict.outcome, discrepancy::Outcome::named) << found.text;
  ASSERT_EQ(found.verdict.causes.size(), 1U) << found.text;
  const discrepancy::NamedCause& cause = found.verdict.causes.front();
  EXPECT_EQ(cause.name, "youngs_modulus") << found.text;
  EXPECT_NEAR(cause.parameters.at("factor").front().value, 1.2, 0.05);
}

TEST_F(DiagnosedLog, NamesAPlantThatStoodElsewhere) {
  const discrepancy::SceneDiagnosis found = diagnose([](ArmAtStem& files) { files.gap = "0.033"; });
  EXPECT_EQ(found.verdict.outcome, discrepancy::Outcome::named) << found.text;
  ASSERT_EQ(found.verdict.causes.size(), 1U) << found.text;
  const discrepancy::NamedCause& cause = found.verdict.causes.front();
  EXPECT_EQ(cause.name, "plant_pose") << found.text;
  EXPECT_NEAR(cause.parameters.at("offset")[1].value, 0.003, 3.0e-4) << found.text;
}

}  // namespace
}  // namespace pedicel::app
