// What data of a robot at a plant could not show.
#include <gtest/gtest.h>

#include "plugins/discrepancy/files/experiment_files.h"
#include "tests/unit/discrepancy_scene/diagnosed_scene.h"

namespace pedicel::discrepancy {
namespace {

/// A stem that is seen along all of its length, below the push, too.
class DiagnosedPlant : public DiagnosedScene {
 protected:
  DiagnosedPlant() {
    at_.instruments =
        "markers:\n"
        "  - {name: tip, curve: stem, at: 1}\n"
        "  - {name: middle, curve: stem, at: 0.6}\n"
        "  - {name: nail, link: finger, offset: [0, 0, 0.1]}\n"
        "  - {name: low, curve: stem, at: 0.15}\n"
        "  - {name: below, curve: stem, at: 0.3}\n"
        "wrenches:\n  - {name: wrist, link: finger}\n"
        "noise: {position_std: 0.0003, force_std: 0.03, moment_std: 0.002, joint_std: 0.00002}\n";
  }
  /// All markers are seen, no camera is there.
  void write_tables() {
    std::string markers = "time";
    for (const char* name : {"tip", "middle", "nail", "low", "below"})
      for (const char* axis : {".x", ".y", ".z"}) markers += std::string(",") + name + axis;
    markers += "\n";
    for (int i = 0; i <= 120; ++i)
      markers += std::to_string(0.01 * i) + std::string(15, ',') + "\n";
    more_ = {{"push/markers.csv", markers}};
  }
};

TEST_F(DiagnosedPlant, DetectableLimitsAreSmallerThanWhatIsFound) {
  write_tables();
  const SceneDiagnosis found = diagnose({});
  ASSERT_EQ(found.verdict.outcome, Outcome::adequate) << found.text;
  const auto limit =
      std::ranges::find(found.verdict.detectable_limits, "wrench_bias", &DetectableLimit::name);
  ASSERT_NE(limit, found.verdict.detectable_limits.end());
  EXPECT_EQ(limit->unit, "N");
  // A force of 0.03 N of noise: a tenth of it shifts the mean of 360 samples by less than what
  // solvers differ by.
  EXPECT_GT(limit->smallest, 0.003);
  EXPECT_LT(limit->smallest, 0.1);
  const SceneDiagnosis below =
      diagnose({"{name: wrench_bias, force: [" + std::to_string(0.5 * limit->smallest) +
                ", 0, 0], moment: [0, 0, 0]}"});
  EXPECT_EQ(below.verdict.outcome, Outcome::adequate) << below.text;
  const SceneDiagnosis above =
      diagnose({"{name: wrench_bias, force: [" + std::to_string(3.0 * limit->smallest) +
                ", 0, 0], moment: [0, 0, 0]}"});
  EXPECT_EQ(above.verdict.outcome, Outcome::named) << above.text;
}

}  // namespace
}  // namespace pedicel::discrepancy
