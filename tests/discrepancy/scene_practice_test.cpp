#include <gtest/gtest.h>

#include <filesystem>

#include "plugins/discrepancy/files/experiment_files.h"
#include "plugins/discrepancy/scene_procedure/scene_diagnosis.h"
#include "tests/support/places.h"

namespace pedicel::discrepancy {
namespace {

// Scene experiments with known answers, made by another engine, which lie beside the project.
class ScenePractice : public ::testing::Test {
 protected:
  SceneDiagnosis diagnose(const std::string& name) {
    const std::filesystem::path folder =
        pedicel::test::shared_folder() / "data/scene_practice" / name;
    if (!std::filesystem::exists(folder)) return {};
    Diagnostics diagnostics;
    const auto experiment = read_experiment(folder, diagnostics);
    if (!experiment) throw InvalidFile(diagnostics);
    SceneDiagnosisOptions options;
    options.threads = 2;
    return diagnose_scene(*experiment, options);
  }
  static bool has(const SceneDiagnosis& found, const std::string& name) {
    for (const NamedCause& one : found.verdict.causes)
      if (one.name == name) return true;
    return false;
  }
};

#define SKIP_WHERE_ABSENT(found) \
  if ((found).nominal.empty()) GTEST_SKIP() << "../shared/data/scene_practice is not there"

TEST_F(ScenePractice, NothingHidden) {
  const SceneDiagnosis found = diagnose("null");
  SKIP_WHERE_ABSENT(found);
  EXPECT_EQ(found.verdict.outcome, Outcome::adequate) << found.text;
}

TEST_F(ScenePractice, ASmoothContact) {
  const SceneDiagnosis found = diagnose("friction");
  SKIP_WHERE_ABSENT(found);
  EXPECT_EQ(found.verdict.outcome, Outcome::named) << found.text;
  ASSERT_EQ(found.verdict.causes.size(), 1u) << found.text;
  EXPECT_EQ(found.verdict.causes.front().name, "contact_friction");
  EXPECT_NEAR(found.verdict.causes.front().parameters.at("coefficient").front().value, 0.25, 0.02);
}

TEST_F(ScenePractice, APlantThatStandsElsewhere) {
  const SceneDiagnosis found = diagnose("moved");
  SKIP_WHERE_ABSENT(found);
  EXPECT_EQ(found.verdict.outcome, Outcome::named) << found.text;
  EXPECT_TRUE(has(found, "plant_pose")) << found.text;
  EXPECT_TRUE(has(found, "youngs_modulus")) << found.text;
  EXPECT_EQ(found.verdict.causes.size(), 2u) << found.text;
}

TEST_F(ScenePractice, AnArmThatGivesWay) {
  const SceneDiagnosis found = diagnose("gives");
  SKIP_WHERE_ABSENT(found);
  EXPECT_EQ(found.verdict.outcome, Outcome::named) << found.text;
  ASSERT_EQ(found.verdict.causes.size(), 1u) << found.text;
  EXPECT_EQ(found.verdict.causes.front().name, "reaction");
  EXPECT_NEAR(found.verdict.causes.front().parameters.at("joint_stiffness").front().value, 150.0,
              15.0);
}

TEST_F(ScenePractice, APostThatTheSceneDoesNotHave) {
  const SceneDiagnosis found = diagnose("wire");
  SKIP_WHERE_ABSENT(found);
  EXPECT_EQ(found.verdict.outcome, Outcome::unknown) << found.text;
  EXPECT_TRUE(found.verdict.unknown) << found.text;
  EXPECT_TRUE(has(found, "youngs_modulus")) << found.text;
}

}  // namespace
}  // namespace pedicel::discrepancy
