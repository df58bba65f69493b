// Worlds without rods: bodies alone, and an optional plant whose file is not there.
#include <gtest/gtest.h>

#include "app/report/headless.h"
#include "engine/io/atomic_file.h"
#include "engine/world/scene_reader.h"
#include "tests/support/temporary_folder.h"

namespace pedicel::app {
namespace {

class NoPlant : public testing::Test {
 protected:
  SceneResult run(const std::string& rest) {
    const std::filesystem::path file = folder_ / "alone.scene.yaml";
    io::write_file_atomically(
        file,
        "format: pedicel-scene\nversion: 1\npurpose: no rods\nsee: a box falls\n"
        "duration: 0.1\nground: {height: 0}\n"
        "bodies:\n  - {name: box, box: [0.1, 0.1, 0.1], position: [0, 0, 0.2], mass: 1}\n" +
            rest);
    Diagnostics diagnostics;
    const auto scene = world::read_scene(file, diagnostics);
    EXPECT_TRUE(scene) << diagnostics.text();
    RunOptions options;
    options.out = folder_ / "out";
    options.pictures = options.video = false;
    options.quiet = true;
    return run_with_sweep(*scene, options);
  }
  const TemporaryFolder folder_;
};

TEST_F(NoPlant, BodiesRunAlone) {
  const SceneResult result = run("expect:\n  - {quantity: detached_count, is: 0}\n");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_GT(result.steps, 0);
  ASSERT_EQ(result.verdicts.size(), 1u);
  EXPECT_TRUE(result.verdicts[0].met);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/report.html"));
}

// What is expected of a plant that may be missing, and is, cannot be judged.
TEST_F(NoPlant, AnOptionalPlantThatIsNotThereFailsNoExpectation) {
  const std::string plants = "plants:\n  - {name: tree, mtg: nowhere.mtg, optional: true}\n";
  for (const std::string of : {"", ", plant: tree"}) {
    const SceneResult result =
        run(plants + "expect:\n  - {quantity: max_drift_m, below: 1.0e-6" + of + "}\n");
    EXPECT_EQ(result.exit_code, 0) << of;
    EXPECT_TRUE(result.verdicts.empty()) << of;
  }
}

}  // namespace
}  // namespace pedicel::app
