// The comparison of the solvers on a rod that sags: with the paper's solver fewer nodes are
// stiffer, with the direct one they are not, and enough sub-steps make the two equal.
#include "app/report/solver_comparison.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "engine/core/diagnostics.h"
#include "engine/io/atomic_file.h"
#include "engine/world/scene_reader.h"
#include "tests/support/temporary_folder.h"

namespace pedicel::app {
namespace {

class SolverComparisonTest : public ::testing::Test {
 protected:
  world::Scene scene(const std::string& sweep) {
    io::write_file_atomically(
        folder_ / "rod.plant.yaml",
        "format: pedicel-plant\nversion: 1\nname: rod\nshape: rest\n"
        "material: {youngs_modulus: 2.0e7, poisson_ratio: 0.35, density: 600, damping_time: 0.05}\n"
        "sampling: {connect: 0.01, distance: 0.02}\nroot: [0, 0, 0.5]\n"
        "curves:\n  - {name: stem, points: [[0, 0, 0.5], [0.2, 0, 0.5]], radius: 0.004}\n");
    const auto file = folder_ / "rod.scene.yaml";
    io::write_file_atomically(
        file,
        "format: pedicel-scene\nversion: 1\npurpose: p\nsee: s\nduration: 3\n"
        "dt: 0.004166666666666667\nplants: [{name: rod, file: rod.plant.yaml}]\n" +
            sweep + "expect:\n  - {quantity: end_drop_m, with_sweep: steady, within: 0.5}\n");
    Diagnostics diagnostics;
    const auto read = world::read_scene(file, diagnostics);
    EXPECT_TRUE(read) << diagnostics.text();
    return *read;
  }
  static std::vector<SweepRun> runs_of(const world::Scene& scene) {
    RunOptions options;
    options.quiet = true;
    std::vector<SweepRun> runs;
    for (const double value : scene.sweep->values)
      runs.push_back({value, run_scene(scene_of_value(scene, value), options)});
    return runs;
  }
  TemporaryFolder folder_;
  RunOptions quiet_ = [] {
    RunOptions options;
    options.quiet = true;
    return options;
  }();
};

TEST_F(SolverComparisonTest, ShowsThePapersObservationAndTheCostOfEqualError) {
  const world::Scene swept = scene("sweep: {set: sampling.distance, values: [0.02, 0.05]}\n");
  const auto found = compare_solvers(swept, runs_of(swept), quiet_);
  ASSERT_TRUE(found);
  ASSERT_EQ(found->rows.size(), 2u);
  const auto& [near, far] = std::pair(found->rows[0], found->rows[1]);
  EXPECT_NEAR(far.direct / near.direct, 1.0, 0.1);
  EXPECT_GT(near.position_based, 1.2 * near.direct);
  EXPECT_GT(near.position_based, 1.2 * far.position_based);  // fewer nodes are stiffer
  EXPECT_EQ(found->fine_distance, 0.0025);
  EXPECT_TRUE(found->equal);
  const double direct = found->speeds.front().error;
  EXPECT_EQ(found->speeds.front().solver, "direct");
  // Sub-steps are doubled until twice in a row the error is that of the direct solver.
  const std::size_t last = found->speeds.size() - 1;
  for (std::size_t i = 1; i <= last; ++i) EXPECT_EQ(found->speeds[i].substeps, 1 << (i - 1));
  for (std::size_t i = 2; i <= last; ++i) {
    const double larger = std::max(found->speeds[i - 1].error, found->speeds[i].error);
    EXPECT_EQ(larger <= 1.1 * direct, i == last) << i;
  }
  const std::string csv = to_csv(*found);
  EXPECT_THAT(csv,
              testing::StartsWith(
                  "solver,distance_m,substeps_1,end_drop_m,error_end_drop_m,real_time_factor_1\n"
                  "direct,0.02,1,"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'),
            static_cast<long>(1 + 4 + 1 + found->speeds.size()));
}

TEST_F(SolverComparisonTest, LeavesOtherSweepsAlone) {
  const world::Scene density = scene("sweep: {set: material.density, values: [300, 600]}\n");
  EXPECT_FALSE(compare_solvers(density, runs_of(density), quiet_));
  const world::Scene none = scene("sweep: {set: sampling.distance, values: [0.02, 0.05]}\n");
  EXPECT_FALSE(compare_solvers(none, {}, quiet_));
}

}  // namespace
}  // namespace pedicel::app
