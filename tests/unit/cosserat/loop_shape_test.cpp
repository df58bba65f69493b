// Parts of plants with loops: what belongs to them, and their elimination in lanes against the
// block system.
#include "plugins/cosserat/lanes/loop_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <set>

#include "plugins/cosserat/lanes/lane_kernels.h"
#include "plugins/cosserat/solver/rod_system.h"
#include "tests/unit/cosserat/extension_cases.h"
#include "tests/unit/cosserat/loop_graphs.h"
#include "tests/unit/cosserat/random_leaves.h"
#include "tests/unit/cosserat/step_potential.h"

namespace pedicel::cosserat::cases {
namespace {

constexpr double dt = 1.0 / 240.0;
const Vec3 gravity(0, 0, -9.81);

std::set<int> way_to_clamp(const RodModel& model, int e) {
  std::set<int> way;
  for (; e >= 0; e = model.elements[e].parent) way.insert(e);
  return way;
}

// Of each weld both ways to where they meet.
std::set<int> on_loops(const RodModel& model) {
  std::set<int> result;
  for (const Weld& weld : model.welds) {
    const std::set<int> a = way_to_clamp(model, weld.a), b = way_to_clamp(model, weld.b);
    std::ranges::set_symmetric_difference(a, b, std::inserter(result, result.end()));
  }
  return result;
}

TEST(LoopParts, HoldWhatLiesOnLoopsAndHangOnOneElement) {
  for (int seed = 0; seed < 200; ++seed) {
    Random random(seed);
    const RodModel model = random_graph(random, 40, random.integer(0, 6));
    const auto parts = loop_parts(model);
    ASSERT_TRUE(parts);
    std::set<int> all, welds;
    for (const LoopPart& part : *parts) {
      const std::set<int> own(part.elements.begin(), part.elements.end());
      for (const int e : own) {
        EXPECT_TRUE(all.insert(e).second);
        const int parent = model.elements[e].parent;
        EXPECT_TRUE(own.contains(parent) || parent == part.from) << "seed " << seed;
      }
      EXPECT_FALSE(own.contains(part.from));
      for (const int w : part.welds) {
        EXPECT_TRUE(welds.insert(w).second);
        for (const int e : {model.welds[w].a, model.welds[w].b})
          EXPECT_TRUE(own.contains(e) || e == part.from) << "seed " << seed;
      }
    }
    EXPECT_EQ(all, on_loops(model)) << "seed " << seed;
    EXPECT_EQ(welds.size(), model.welds.size());
  }
}

TEST(LoopParts, EqualLeavesHaveTheSameShape) {
  const auto parts = loop_parts(leafy_stem(5));
  ASSERT_TRUE(parts);
  ASSERT_EQ(parts->size(), 5u);
  for (const LoopPart& part : *parts) {
    EXPECT_EQ(part.elements.size(), 12u);
    EXPECT_EQ(part.shape, parts->front().shape);
    EXPECT_EQ(part.shape.columns().size(), 12u);
  }
}

TEST(LoopParts, ALargePartHasNoShape) {
  EXPECT_TRUE(loop_parts(staked_stem(20, 5)));
  EXPECT_FALSE(loop_parts(staked_stem(LoopShape::most_elements, 5)));
}

TEST(LoopParts, LeavesOfOneShapeStandSideBySide) {
  const RodModel model = leafy_stem(12);
  const LaneLayout layout(std::array{&model}, false);
  EXPECT_FALSE(layout.plant_keeps_blocks(0));
  int packs = 0, leaves = 0;
  for (int p = 0; p < layout.packs(); ++p) packs += layout.loops(p) != nullptr;
  EXPECT_EQ(packs, 2);
  for (const Chain& chain : layout.chains()) {
    if (!chain.loops) continue;
    EXPECT_EQ(chain.welds.size(), 8u);
    EXPECT_EQ(layout.loops(chain.pack), chain.loops);
    ++leaves;
  }
  EXPECT_EQ(leaves, 12);
}

// The part of a step that is tested twice: by a block system that holds the whole plant, and by
// lanes, on one thread and on two.
void compare(const RodModel& model, const RodState& state, const RodHistory& history, int seed) {
  StepPotential step(model);
  BlockSystem system(model);
  step.prepare(state, {dt, gravity, {}, {}}, &history, &model);
  const double energy = step.linearise(model, state, system);
  ASSERT_TRUE(system.solve());
  std::vector<Vec6> first;
  for (const int threads : {1, 2}) {
    RodRows rows(std::array{&model}, threads);
    ASSERT_FALSE(rows.store.layout.plant_keeps_blocks(0));
    rows.store.gravity = gravity;
    rows.states.set_scheme(0, dt, dt, std::array{own_clamp(state)});
    rows.extensions.begin_step(0, model, state.time, dt, false);
    rows.states.set_history(0, history);
    ThreadPool pool(threads);
    rows.states.prepare(pool, std::array<const RodState*, 1>{&state});
    rows.states.read_iterate(0, state);
    rows.elimination.eliminate(pool);
    EXPECT_NEAR(rows.search.energy_before(0), energy, 1e-9 * (1.0 + std::abs(energy))) << seed;
    rows.search.measure(pool);
    EXPECT_NEAR(rows.search.energy(0), energy, 1e-9 * (1.0 + std::abs(energy))) << seed;
    rows.elimination.substitute(pool);
    ASSERT_TRUE(rows.elimination.healthy(0)) << seed;
    std::vector<Vec6> changes;
    double largest = 0.0, worst = 0.0;
    for (int e = 0; e < model.size(); ++e) {
      changes.push_back(rows.elimination.change(0, e));
      largest = std::max(largest, system.solution(e).norm());
      worst = std::max(worst, (changes.back() - system.solution(e)).norm());
    }
    EXPECT_LT(worst, 3e-7 * largest) << seed;
    if (threads == 1) first = changes;
    EXPECT_EQ(first, changes) << seed;
  }
}

TEST(LoopParts, AreSolvedInLanesAsByTheBlockSystem) {
  for (const std::string& name : available_instruction_sets()) {
    use_instruction_set(name);
    for (int seed = 0; seed < 12; ++seed) {
      Random random(seed);
      RodModel model = random_plant(random, seed % 4 == 3 ? 900 : 30, false);
      add_leaves(model, random, seed % 4 == 3 ? 60 : 11);
      if (seed % 3 == 1) extend(model, random);
      RodState state = random_state(model, random, 1e-3, 0.3);
      start_memory(model, state);
      if (seed % 3 == 2) {  // something has come off, with all that it carries
        state.alive[model.size() / 2] = 0;
        for (int e = model.size() / 2; e < model.size(); ++e) {
          const int parent = model.elements[e].parent;
          if (parent >= 0 && !state.alive[parent]) state.alive[e] = 0;
        }
      }
      compare(model, state, random_history(model, state, random, dt), seed);
    }
  }
  use_instruction_set("");
}

// A leafy plant moves as it does among others, on any number of threads, to the bit.
TEST(LoopParts, MoveWithTheSameBitsAloneAndAmongOthers) {
  std::vector<RodModel> plants;
  for (int p = 0; p < 5; ++p) {
    Random random(p);
    plants.push_back(random_plant(random, p == 4 ? 850 : 30, false));
    add_leaves(plants.back(), random, 3 + 5 * p);
  }
  const auto run = [&](std::span<const RodModel> some, int threads) {
    RodSystem system(RodSettings{}, threads);
    for (const RodModel& one : some) system.add_plant(one);
    for (int i = 0; i < 40; ++i) system.step(dt, gravity);
    std::vector<std::vector<Vec3>> places;
    for (int p = 0; p < system.size(); ++p) places.push_back(system.state(p).position);
    return places;
  };
  const auto together = run(plants, 1);
  EXPECT_EQ(together, run(plants, 2));
  for (std::size_t p = 0; p < plants.size(); ++p)
    EXPECT_EQ(together[p], run(std::span(plants).subspan(p, 1), 1)[0]) << p;
}

}  // namespace
}  // namespace pedicel::cosserat::cases
