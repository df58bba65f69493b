#include "app/steer/steered_run.h"

#include <gtest/gtest.h>

#include "app/steer/steered_worlds.h"
#include "app/steer/visibility.h"
#include "engine/core/check.h"
#include "tests/support/places.h"

namespace pedicel::app {
namespace {

// A twig with a berry, and a second one before it where `hidden`.
plant::PlantFile twig(bool hidden = false) {
  plant::PlantFile file;
  file.name = "twig";
  file.material = {2.0e7, 0.35, 700.0, 0.01};
  file.connect = 0.01;
  file.distance = 0.02;
  plant::PlantCurve stem;
  stem.name = "stem";
  stem.points = {{0, 0, 0}, {0, 0, 0.15}, {0.02, 0, 0.3}};
  stem.radius = {0.003};
  file.curves = {stem};
  file.fruits.push_back({"berry", {"stem", 1.0, {}}, 0.01, 950.0, {}, {}});
  if (hidden) {
    stem.name = "screen";
    stem.points = {{0, 0, 0.01}, {0.02, -0.05, 0.1}, {0.02, -0.1, 0.4}};
    stem.radius = {0.02};
    file.curves.push_back(stem);
  }
  return file;
}

std::shared_ptr<const SteeredScene> scene_of_twig(bool hidden = false) {
  Document document = empty_document();
  document.plants.push_back({{}, std::make_shared<const plant::PlantFile>(twig(hidden))});
  document.plants.back().entry.name = "twig";
  return std::make_shared<const SteeredScene>(std::move(document), std::vector<std::string>{});
}

void push(SteeredRun& run, double force) {
  run.act({0, Act::Kind::force, "twig/berry", {1.0, force, 0, 0, 0, 0, 0}});
}

TEST(SteeredRun, ARestoredStateGoesOnToTheSameBits) {
  const auto scene = scene_of_twig();
  SteeredRun run(scene), other(scene);
  push(run, 0.02);
  for (int i = 0; i < 10; ++i) run.step();
  const SavedRun saved = run.save();
  push(run, -0.01);
  for (int i = 0; i < 10; ++i) run.step();
  const std::uint64_t end = run.simulation().state_hash();
  for (SteeredRun* one : {&run, &other}) {
    one->restore(saved);
    EXPECT_EQ(one->steps(), 10);
    EXPECT_EQ(one->simulation().state_hash(), saved.state);
    push(*one, -0.01);
    for (int i = 0; i < 10; ++i) one->step();
    EXPECT_EQ(one->simulation().state_hash(), end);
  }
}

TEST(SteeredRun, ARefusedActIsNotKept) {
  SteeredRun run(scene_of_twig());
  EXPECT_THROW(run.act({0, Act::Kind::force, "twig/apple", {1, 0, 0, 0, 0, 0, 0}}), UsageError);
  EXPECT_THROW(run.act({0, Act::Kind::force, "twig/berry", {1, 0}}), UsageError);
  EXPECT_THROW(run.act({0, Act::Kind::position, "", {0.0}}), UsageError);
  EXPECT_THROW(run.act({0, Act::Kind::set, "dt=0.001", {}}), UsageError);
  EXPECT_TRUE(run.save().acts.empty());
}

std::size_t quantity(std::string_view name) {
  const auto all = simulation::quantities();
  return static_cast<std::size_t>(std::ranges::find(all, name, &Quantity::name) - all.begin());
}

TEST(SteeredRun, OnlyWhatWasAskedForIsWritten) {
  SteeredRun run(scene_of_twig());
  StateArrays state(RowLayout(run.simulation()), 1);
  EXPECT_TRUE(state.want(quantity("positions")));
  EXPECT_FALSE(state.want(quantity("positions")));
  state.fill(run.simulation(), 0);
  const int last = state.layout().rows(Rows::segment) - 1;
  EXPECT_GT(state.numbers(quantity("positions"))[3 * last + 2], 0.29);
  EXPECT_EQ(state.numbers(quantity("orientations"))[3], 0.0);
  state.want(quantity("orientations"));
  state.fill(run.simulation(), 0);
  EXPECT_NE(state.numbers(quantity("orientations"))[3], 0.0);
}

TEST(SteeredWorlds, AreSingleRuns) {
  const auto scene = scene_of_twig();
  SteeredWorlds worlds(scene, 3, 2);
  for (int w = 0; w < 3; ++w) push(worlds.run(w), 0.01 * (w + 1));
  worlds.step(12, {});
  const std::vector<std::uint8_t> first = {1, 0, 0};
  worlds.reset(first);
  worlds.step(5, first);
  for (int w = 0; w < 3; ++w) {
    SteeredRun single(scene);
    if (w > 0) push(single, 0.01 * (w + 1));
    for (int i = 0; i < (w > 0 ? 12 : 5); ++i) single.step();
    EXPECT_EQ(worlds.run(w).simulation().state_hash(), single.simulation().state_hash()) << w;
  }
}

TEST(VisibleShare, IsOneInTheOpenAndNoneBehindAStem) {
  const SteeredRun open(scene_of_twig()), hidden(scene_of_twig(true));
  const Vec3 eye(0.02, -1.0, 0.3);
  EXPECT_EQ(visible_share(open.simulation(), "twig/berry", eye), 1.0);
  EXPECT_EQ(visible_share(hidden.simulation(), "twig/berry", eye), 0.0);
  // From the other side nothing is before it, and from below the ground is.
  EXPECT_EQ(visible_share(hidden.simulation(), "twig/berry", {0.02, 1.0, 0.3}), 1.0);
  EXPECT_EQ(visible_share(open.simulation(), "twig/berry", {0.5, 0.0, -1.0}), 0.0);
  EXPECT_THROW(visible_share(open.simulation(), "twig/apple", eye), UsageError);
}

// The shipped scene of leaf blades: an arm turns a neighbour's leaf aside, which hides the fruit
// again when it is let go. From the time where it lies on the fingers a saved state goes on alike.
TEST(VisibleShare, ALeafThatIsTurnedAsideUncoversTheFruit) {
  const auto scene = std::make_shared<const SteeredScene>(
      open_document(pedicel::test::source_folder() / "assets/scenes/leaf_aside.scene.yaml"),
      std::vector<std::string>{});
  SteeredRun run(scene), other(scene);
  const auto seen = [&] {
    return visible_share(run.simulation(), "bearer/berry", camera_place(run.simulation(), "watch"));
  };
  EXPECT_LT(seen(), 0.05);
  for (int i = 0; i < 600; ++i) run.step();
  EXPECT_GT(seen(), 0.95);
  const SavedRun saved = run.save();
  for (int i = 0; i < 600; ++i) run.step();
  EXPECT_LT(seen(), 0.05);
  other.restore(saved);
  for (int i = 0; i < 600; ++i) other.step();
  EXPECT_EQ(other.simulation().state_hash(), run.simulation().state_hash());
}

}  // namespace
}  // namespace pedicel::app
