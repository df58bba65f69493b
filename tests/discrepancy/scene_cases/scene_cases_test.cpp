#include <gtest/gtest.h>

#include "discrepancy/scene_cases/scene_case.h"
#include "pedicel/discrepancy/scene_procedure/scene_diagnosis.h"
#include "support/temporary_folder.h"

namespace pedicel::discrepancy {
namespace {

// Hidden in data of another engine, and found by the diagnosis.
class SceneCases : public testing::Test {
 protected:
  SceneDiagnosis diagnose(std::uint64_t seed, const std::vector<scene_case::Hidden>& hidden) {
    scene_case::Setting setting;
    setting.seed = seed;
    scene_case::draw(setting);
    setting.hidden = hidden;
    scene_case::write_case(folder_ / "", setting);
    Diagnostics diagnostics;
    const auto experiment = read_scene_experiment(folder_ / "", diagnostics);
    if (!experiment) throw InvalidFile(diagnostics);
    SceneDiagnosisOptions options;
    options.threads = 2;
    return diagnose_scene(*experiment, options);
  }
  TemporaryFolder folder_;
};

TEST_F(SceneCases, NothingIsHidden) {
  const SceneDiagnosis found = diagnose(1, {});
  EXPECT_EQ(found.verdict.outcome, Outcome::adequate) << found.text;
}

TEST_F(SceneCases, ASmoothFinger) {
  const SceneDiagnosis found = diagnose(1, {{"contact_friction", {{"coefficient", {0.25}}}}});
  EXPECT_EQ(found.verdict.outcome, Outcome::named) << found.text;
  ASSERT_EQ(found.verdict.causes.size(), 1u) << found.text;
  const NamedCause& cause = found.verdict.causes.front();
  EXPECT_EQ(cause.name, "contact_friction");
  EXPECT_NEAR(cause.parameters.at("coefficient").front().value, 0.25, 0.02);
}

}  // namespace
}  // namespace pedicel::discrepancy
