// Every scene that we ship is run whole, with its sweep and without pictures, and must meet its own
// criteria.
#include <gtest/gtest.h>

#include "app/report/headless.h"
#include "engine/world/scene_reader.h"
#include "tests/scenes/shipped_scenes.h"

namespace pedicel {
namespace {

class ShippedScene : public ::testing::TestWithParam<std::filesystem::path> {};

TEST_P(ShippedScene, MeetsItsOwnCriteria) {
  Diagnostics diagnostics;
  const auto scene = world::read_scene(GetParam(), diagnostics);
  ASSERT_TRUE(scene) << diagnostics.text();
  ASSERT_FALSE(scene->expectations.empty()) << "a scene without a criterion shows nothing";
  app::RunOptions options;
  options.out = std::filesystem::path(::testing::TempDir()) / "pedicel_scenes" / scene->name;
  options.pictures = false;
  options.video = false;
  options.comparison = false;  // tests/unit/app/solver_comparison_test.cpp
  options.quiet = true;
  const app::SceneResult result = app::run_with_sweep(*scene, options);
  EXPECT_EQ(result.exit_code, 0) << result.error;
  EXPECT_EQ(result.verdicts.size(), scene->expectations.size());
  for (const world::ExpectationResult& verdict : result.verdicts)
    EXPECT_TRUE(verdict.met) << world::to_string(verdict);
}

INSTANTIATE_TEST_SUITE_P(Assets, ShippedScene, ::testing::ValuesIn(shipped_scenes()), scene_name);

}  // namespace
}  // namespace pedicel
