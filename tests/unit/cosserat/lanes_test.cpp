// Eight elements side by side: the same solution as block by block, whatever stands beside a plant,
// however many threads share it, and (to rounding) whatever instruction set computes it.
#include <gtest/gtest.h>

#include <array>
#include <set>

#include "cosserat/lane_kernels.h"
#include "cosserat/lane_layout.h"
#include "plant/reference_plants.h"
#include "support/rod_tips.h"
#include "unit/cosserat/random_plants.h"
#include "unit/cosserat/step_potential.h"

namespace pedicel::cosserat::cases {
namespace {

constexpr double dt = 1.0 / 240.0;
const Vec3 gravity(0, 0, -9.81);

std::vector<RodModel> garden() {
  std::vector<RodModel> plants;
  for (int p = 0; p < 9; ++p) {
    Random random(p);
    plants.push_back(random_plant(random, 5 + 17 * p, p % 4 == 3));
  }
  return plants;
}

std::vector<const RodModel*> pointers(const std::vector<RodModel>& plants) {
  std::vector<const RodModel*> result;
  for (const RodModel& plant : plants) result.push_back(&plant);
  return result;
}

TEST(LaneLayout, EveryElementHasOneSlotUnderItsParents) {
  const std::vector<RodModel> plants = garden();
  for (const int threads : {1, 2, 3}) {
    const LaneLayout layout(pointers(plants), threads, false);
    std::set<std::pair<int, int>> taken;
    for (std::size_t p = 0; p < plants.size(); ++p)
      for (int e = 0; e < plants[p].size(); ++e) {
        const Slot slot = layout.slot(static_cast<int>(p), e);
        EXPECT_TRUE(taken.emplace(slot.row, slot.lane).second);
        EXPECT_LT(slot.row, layout.rows());
      }
    for (const Chain& chain : layout.chains())
      for (std::size_t i = 1; i < chain.elements.size(); ++i) {
        const RodModel& model = plants[chain.plant];
        EXPECT_EQ(model.elements[chain.elements[i]].parent, chain.elements[i - 1]);
        EXPECT_EQ(layout.slot(chain.plant, chain.elements[i]).row,
                  layout.slot(chain.plant, chain.elements[i - 1]).row + 1);
      }
  }
}

// Packs are eliminated in order: a chain's pack must come before that of the chain it starts from.
TEST(LaneLayout, BranchesComeBeforeWhatCarriesThem) {
  const std::vector<RodModel> plants = garden();
  for (const int threads : {1, 2, 3}) {
    const LaneLayout layout(pointers(plants), threads, false);
    for (const Chain& chain : layout.chains()) {
      if (chain.parent < 0) continue;
      EXPECT_LT(chain.pack, layout.chains()[chain.parent].pack);
    }
  }
}

TEST(LaneLayout, FillsLanesWithEqualPlantsAndEqualBranches) {
  std::vector<RodModel> forest;
  for (int p = 0; p < plant::forest_size; ++p) forest.push_back(plant::forest_plant(p));
  // 38 stems of 19 and 190 branches of 8: 5 x 19 + 24 x 8 rows, one more a pack.
  EXPECT_EQ(LaneLayout(pointers(forest), 1, false).rows(), 287 + 29);
}

TEST(LaneLayout, OneLargePlantIsSharedOutByItsBranches) {
  const std::vector<RodModel> tree = {plant::hanging_tree()};
  const LaneLayout layout(pointers(tree), 2, false);
  ASSERT_EQ(layout.groups(), 3);  // two and what carries them
  for (int group = 0; group < 3; ++group)
    EXPECT_LT(layout.group_begin(group), layout.group_end(group));
  // Only the trunk is on top: its last branch, with a longer path below it, is not part of it.
  ASSERT_EQ(layout.group_end(2) - layout.group_begin(2), 1);
  const int trunk = layout.group_begin(2);
  EXPECT_EQ(layout.end_row(trunk) - layout.first_row(trunk), 1 + 42);
  // 132 twigs of 10, 22 branches of 40.
  EXPECT_EQ(LaneLayout(pointers(tree), 1, false).rows(), 42 + 3 * 40 + 17 * 10 + 21);
}

// The rows' elimination against the block system, which is tested against dense matrices.
TEST(RodRows, SolvesAsTheBlockSystemDoes) {
  for (const int threads : {1, 2}) {
    for (int seed = 0; seed < 5; ++seed) {
      Random random(seed);
      const RodModel model = random_plant(random, seed < 4 ? 40 : 900, false);
      const RodState state = random_state(model, random, 1e-3, 0.3);
      const RodHistory history = random_history(model, state, random, dt);
      StepPotential step(model);
      BlockSystem system(model);
      step.prepare(state, {dt, gravity, {}, {}}, &history);
      step.linearise(model, state, system);
      ASSERT_TRUE(system.solve());

      RodRows rows(std::array{&model}, threads);
      rows.set_gravity(gravity);
      rows.set_scheme(0, dt, dt, state.root);
      rows.set_history(0, history);
      const std::array states{&state};
      if (rows.has_top()) rows.prepare(rows.groups(), states);
      for (int g = 0; g < rows.groups(); ++g) rows.prepare(g, states);
      rows.read_iterate(0, state);
      for (int g = 0; g < rows.groups(); ++g) rows.eliminate(g);
      if (rows.has_top()) rows.eliminate(rows.groups());
      if (rows.has_top()) rows.substitute(rows.groups());
      for (int g = 0; g < rows.groups(); ++g) rows.substitute(g);
      ASSERT_TRUE(rows.healthy(0));
      double largest = 0.0, worst = 0.0;
      for (int e = 0; e < model.size(); ++e) {
        largest = std::max(largest, system.solution(e).norm());
        worst = std::max(worst, (rows.change(0, e) - system.solution(e)).norm());
      }
      EXPECT_LT(worst, 1e-9 * largest) << seed;  // stretch over inertia: conditions of 1e6
    }
  }
}

TEST(RodRows, APlantAloneMovesAsItDoesAmongOthers) {
  const std::vector<RodModel> plants = garden();
  const std::vector<Vec3> together = tips_after(plants, 1, 100);
  for (std::size_t p = 0; p < plants.size(); ++p)
    EXPECT_EQ(together[p], tips_after({plants[p]}, 1, 100)[0]) << p;
}

TEST(RodRows, ThreadsThatShareOnePlantGiveTheSameBits) {
  Random random(3);
  const std::vector<RodModel> plants = {plant::hanging_tree(), random_plant(random, 1200, false)};
  for (const RodModel& one : plants) {
    const std::vector<Vec3> alone = tips_after({one}, 1, 30);
    EXPECT_EQ(alone, tips_after({one}, 2, 30));
    EXPECT_EQ(alone, tips_after({one}, 3, 30));
  }
}

// Fused and separate multiply-adds round differently, by some 1e-16 an operation; over 100 steps of
// falling plants that grows, but stays far below a nanometre.
TEST(RodRows, InstructionSetsAgree) {
  const std::vector<RodModel> plants = garden();
  const std::vector<Vec3> best = tips_after(plants, 1, 100);
  for (const std::string& name : available_instruction_sets()) {
    use_instruction_set(name);
    const std::vector<Vec3> tips = tips_after(plants, 1, 100);
    for (std::size_t p = 0; p < plants.size(); ++p)
      EXPECT_LT((tips[p] - best[p]).norm(), 1e-9) << name << " plant " << p;
  }
  use_instruction_set("");
}

}  // namespace
}  // namespace pedicel::cosserat::cases
