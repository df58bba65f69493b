// The same scene and seed give the same bits: in two runs, in two worlds that are stepped in turns,
// and with any number of threads. Every scene that we ship is tried, to its end.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/world/scene_reader.h"
#include "plugins/simulation/simulation.h"
#include "tests/scenes/shipped_scenes.h"

namespace pedicel {
namespace {

class Determinism : public ::testing::TestWithParam<std::filesystem::path> {
 protected:
  void SetUp() override {
    Diagnostics diagnostics;
    scene_ = world::read_scene(GetParam(), diagnostics);
    ASSERT_TRUE(scene_) << diagnostics.text();
  }
  std::optional<world::Scene> scene_;
};

TEST_P(Determinism, TwoWorldsInTurnsWithOneAndTwoThreadsGiveTheSameBits) {
  world::Scene threaded = *scene_;
  threaded.threads = 2;
  simulation::Simulation first(*scene_, {}), second(threaded, {});
  EXPECT_EQ(first.state_hash(), second.state_hash());
  const std::uint64_t before = first.state_hash();
  const long steps = std::lround(scene_->duration / scene_->dt);
  for (long i = 0; i < steps; ++i) {
    first.step();
    second.step();
    // Where they part, the first step in which they do is what one wants to know.
    if (i % 100 == 0) {
      ASSERT_EQ(first.state_hash(), second.state_hash()) << "after step " << i;
    }
  }
  EXPECT_EQ(first.state_hash(), second.state_hash());
  EXPECT_NE(first.state_hash(), before);
}

INSTANTIATE_TEST_SUITE_P(Assets, Determinism, ::testing::ValuesIn(shipped_scenes()), scene_name);

}  // namespace
}  // namespace pedicel
