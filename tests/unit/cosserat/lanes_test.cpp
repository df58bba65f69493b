// Eight elements side by side: the same solution as block by block, whatever stands beside a plant,
// however many threads share it, and (to rounding) whatever instruction set computes it.
#include <gtest/gtest.h>

#include <array>
#include <set>

#include "plugins/cosserat/lanes/lane_kernels.h"
#include "plugins/cosserat/lanes/lane_layout.h"
#include "plugins/plant/reference_plants.h"
#include "tests/support/rod_tips.h"
#include "tests/unit/cosserat/extension_cases.h"
#include "tests/unit/cosserat/step_potential.h"

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
  const LaneLayout layout(pointers(plants), false);
  std::set<std::pair<int, int>> taken;
  for (std::size_t p = 0; p < plants.size(); ++p)
    for (int e = 0; e < plants[p].size(); ++e) {
      const Slot slot = layout.slot(static_cast<int>(p), e);
      EXPECT_TRUE(taken.emplace(slot.row, slot.lane).second);
      EXPECT_LT(slot.row, layout.rows());
    }
  for (const Chain& chain : layout.chains()) {
    const RodModel& model = plants[chain.plant];
    const int parent = model.elements[chain.elements.front()].parent;
    ASSERT_EQ(parent < 0, chain.parent < 0);
    if (parent >= 0) {
      const Chain& from = layout.chains()[chain.parent];
      EXPECT_EQ(layout.slot(chain.plant, parent).row - layout.first_row(from.pack),
                1 + (std::ranges::find(from.elements, parent) - from.elements.begin()));
    }
    for (std::size_t i = 1; i < chain.elements.size(); ++i) {
      if (chain.loops) continue;
      EXPECT_EQ(model.elements[chain.elements[i]].parent, chain.elements[i - 1]);
      EXPECT_EQ(layout.slot(chain.plant, chain.elements[i]).row,
                layout.slot(chain.plant, chain.elements[i - 1]).row + 1);
    }
  }
}

// Packs are eliminated in order: a chain's pack must come before that of the chain it starts from.
TEST(LaneLayout, BranchesComeBeforeWhatCarriesThem) {
  const std::vector<RodModel> plants = garden();
  const LaneLayout layout(pointers(plants), false);
  const std::vector<std::vector<int>> on = layout.needs();
  for (const Chain& chain : layout.chains()) {
    EXPECT_FALSE(layout.from_clamp(chain.pack));
    if (chain.parent < 0) continue;
    const int from = layout.chains()[chain.parent].pack;
    EXPECT_LT(chain.pack, from);
    EXPECT_EQ(std::ranges::count(on[from], chain.pack), 1);
  }
}

TEST(LaneLayout, FillsLanesWithEqualPlantsAndEqualBranches) {
  std::vector<RodModel> forest;
  for (int p = 0; p < plant::forest_size; ++p) forest.push_back(plant::forest_plant(p));
  // 38 stems of 19 and 190 branches of 8: 5 x 19 + 24 x 8 rows, one more a pack.
  EXPECT_EQ(LaneLayout(pointers(forest), false).rows(), 287 + 29);
}

// Its last branch, with a longer path below it, is no part of the trunk, and each piece of the
// trunk carries one pack of branches. What the first piece carries is eliminated into it from the
// clamp on, while the others are from the tip; they meet in its last element.
TEST(LaneLayout, CutsTheTrunkOfALargePlantAlone) {
  const std::vector<RodModel> tree = {plant::hanging_tree()};
  LaneLayout layout(pointers(tree), false);
  // 132 twigs of 10, 22 branches of 40, a trunk of 42 in three pieces; one more row a pack.
  EXPECT_EQ(layout.rows(), 17 * 10 + 3 * 40 + 42 + 17 + 3 + 3);
  const std::vector<std::vector<int>> on = layout.needs();
  ASSERT_EQ(layout.packs(), 23);
  ASSERT_EQ(on.size(), 24u);
  for (int p = 0; p < layout.packs(); ++p) EXPECT_EQ(layout.from_clamp(p), p == 20);
  EXPECT_EQ(layout.slot(0, 0).row, layout.first_row(20) + 1);
  EXPECT_EQ(layout.pack_of(23), 20);
  EXPECT_EQ(layout.task_of(20, layout.end_row(20) - 2), 20);
  EXPECT_EQ(layout.task_of(20, layout.end_row(20) - 1), 23);
  EXPECT_EQ(on[20], (std::vector<int>{17}));
  EXPECT_EQ(on[21], (std::vector<int>{19}));
  EXPECT_EQ(on[22], (std::vector<int>{18, 21}));
  EXPECT_EQ(on[23], (std::vector<int>{20, 22}));
}

// Only first pieces of the same length stand side by side, since their last elements must; and a
// plant with a large loop, which is not eliminated row by row, has none.
TEST(LaneLayout, FirstPiecesOfTrunksEndInTheSameRow) {
  Random random(1);
  const std::vector<RodModel> plants = {plant::hanging_tree(), random_plant(random, 900, false),
                                        plant::hanging_tree(), random_plant(random, 900, true)};
  const LaneLayout layout(pointers(plants), false);
  std::vector<int> pack_of_plant(plants.size(), -1);
  for (const Chain& chain : layout.chains()) {
    EXPECT_EQ(chain.from_clamp, layout.from_clamp(chain.pack));
    if (!chain.from_clamp) continue;
    EXPECT_EQ(chain.parent, -1);
    EXPECT_EQ(layout.slot(chain.plant, chain.elements.back()).row, layout.end_row(chain.pack) - 1);
    pack_of_plant[chain.plant] = chain.pack;
  }
  EXPECT_GE(pack_of_plant[0], 0);
  EXPECT_GE(pack_of_plant[1], 0);
  EXPECT_NE(pack_of_plant[1], pack_of_plant[0]);
  EXPECT_EQ(pack_of_plant[2], pack_of_plant[0]);
  EXPECT_EQ(pack_of_plant[3], -1);
}

TEST(LaneLayout, RowsLieInTheOrderThatIsAskedFor) {
  const std::vector<RodModel> tree = {plant::hanging_tree()};
  LaneLayout layout(pointers(tree), false);
  std::vector<int> order(layout.packs());
  for (int p = 0; p < layout.packs(); ++p) order[p] = p % 2 == 0 ? p : layout.packs() - 1 - p;
  layout.place(order);
  int row = 0;
  for (const int p : order) {
    EXPECT_EQ(layout.first_row(p), row);
    row = layout.end_row(p);
  }
  EXPECT_EQ(row, layout.rows());
  for (const Chain& chain : layout.chains())
    for (std::size_t i = 0; i < chain.elements.size(); ++i) {
      const Slot slot = layout.slot(0, chain.elements[i]);
      EXPECT_EQ(slot.row, layout.first_row(chain.pack) + 1 + static_cast<int>(i));
      EXPECT_EQ(layout.elements(slot.row)[slot.lane], chain.elements[i]);
    }
}

// The rows' elimination against the block system, which is tested against dense matrices. The rows
// keep L and W in single precision: each number is off by up to 6e-8 of itself, and what an element
// gets follows from its parent's, so that such errors add up along a branch as those of lengths do.
// Found: 4e-8 of the largest change. The large plants are eliminated towards the end of their
// stem's first piece.
TEST(RodRows, SolvesAsTheBlockSystemDoes) {
  for (const int threads : {1, 2}) {
    for (int seed = 0; seed < 8; ++seed) {
      Random random(seed);
      RodModel model =
          seed == 7 ? plant::hanging_tree() : random_plant(random, seed < 4 ? 40 : 900, false);
      if (seed == 6) extend(model, random);
      RodState state = random_state(model, random, 1e-3, 0.3);
      start_memory(model, state);
      const RodHistory history = random_history(model, state, random, dt);
      const LaneLayout layout(std::array<const RodModel*, 1>{&model}, false);
      ASSERT_EQ(layout.tasks() > layout.packs(), seed >= 4);
      if (seed == 5) {  // most of it has come off
        const std::vector<int>& piece = layout.chains().front().elements;
        const int broken = piece[piece.size() / 2];
        state.alive[broken] = false;
        for (int e = broken + 1; e < model.size(); ++e)
          if (!state.alive[model.elements[e].parent]) state.alive[e] = false;
      }
      StepPotential step(model);
      BlockSystem system(model);
      step.prepare(state, {dt, gravity, {}, {}}, &history, &model);
      step.linearise(model, state, system);
      ASSERT_TRUE(system.solve());

      RodRows rows(std::array{&model}, threads);
      rows.store.gravity = gravity;
      rows.states.set_scheme(0, dt, dt, std::array{own_clamp(state)});
      rows.extensions.begin_step(0, model, state.time, dt, false);
      rows.states.set_history(0, history);
      const std::array<const RodState*, 1> states{&state};
      ThreadPool pool(threads);
      rows.states.prepare(pool, states);
      rows.states.read_iterate(0, state);
      rows.elimination.eliminate(pool);
      rows.elimination.substitute(pool);
      ASSERT_TRUE(rows.elimination.healthy(0));
      double largest = 0.0, worst = 0.0;
      for (int e = 0; e < model.size(); ++e) {
        largest = std::max(largest, system.solution(e).norm());
        worst = std::max(worst, (rows.elimination.change(0, e) - system.solution(e)).norm());
      }
      EXPECT_LT(worst, 2e-7 * largest) << seed;
    }
  }
}

void set_all(Lanes& lanes, double value) {
  std::fill(std::begin(lanes), std::end(lanes), value);
}

// What is asked for ahead ends with the pack: the rows beside it may be another pack's, or none.
// Here whoever looks there reads an index that is nowhere near any source.
TEST(RodRows, AShortPackAsksForNothingBeyondItsRows) {
  constexpr int nowhere = 1 << 28, beside = 4;
  for (const int elements : {2, 3, 4, 5}) {
    const int count = elements + 1;
    std::vector<ElementRow> element(count);
    std::vector<PoseRow> iterate(count);
    std::vector<TermRow> term(count);
    std::vector<FactorRow> factor(count);
    for (int row = 0; row < count; ++row) {
      for (Lanes& inertia : element[row].inertia) set_all(inertia, 1.0);
      for (Lanes* one : {&element[row].length, &element[row].mass, &element[row].alive,
                         &element[row].rest_rotation[3], &iterate[row].orientation[3],
                         &term[row].rotation_target[3], &term[row].inertia_scale})
        set_all(*one, 1.0);
    }
    const std::vector<int> first_branch(count, -1);
    std::vector<int> first_extra(beside + count + beside, nowhere);
    std::fill_n(first_extra.begin() + beside, count, -1);
    RowArrays rows;
    rows.element = element.data();
    rows.iterate = iterate.data();
    rows.term = term.data();
    rows.factor = factor.data();
    rows.first_branch = first_branch.data();
    rows.first_extra = first_extra.data() + beside;
    for (const auto& kernel : {eliminate_from_clamp, linearise_and_eliminate}) {
      Pack pack{};
      pack.end = count;
      kernel(rows, pack);
      EXPECT_EQ(pack.healthy[0], 1.0) << elements;
    }
  }
}

// To the same place, and the potential there is the same when it is asked for afterwards.
TEST(RodRows, AMoveNeedNotBeMeasured) {
  for (const auto& [elements, damping_time] :
       {std::pair(60, 0.0), std::pair(60, 0.05), std::pair(900, 0.05)}) {
    Random random(2);
    RodModel model = random_plant(random, elements, false);
    for (Element& element : model.elements) element.damping_time = damping_time;
    finish(model);
    const RodState state = random_state(model, random, 1e-3, 0.3);
    const RodHistory history = random_history(model, state, random, dt);
    ThreadPool pool(1);
    std::vector<double> energies;
    std::vector<RodState> ends;
    for (const bool measured : {true, false}) {
      RodRows rows(std::array{&model}, 1);
      rows.store.gravity = gravity;
      rows.states.set_scheme(0, dt, dt, std::array{own_clamp(state)});
      rows.states.set_history(0, history);
      rows.states.prepare(pool, std::array{&state});
      rows.search.set_share(0, 1.0);
      ends.push_back(state);
      rows.search.solve_and_move(pool, measured, std::array{&ends.back()});
      if (!measured) rows.search.measure(pool);
      energies.push_back(rows.search.energy(0));
      EXPECT_LT(energies.back(), rows.search.energy_before(0));
    }
    EXPECT_EQ(energies[0], energies[1]);
    EXPECT_EQ(ends[0].position, ends[1].position);
  }
}

TEST(RodRows, APlantAloneMovesAsItDoesAmongOthers) {
  const std::vector<RodModel> plants = garden();
  const std::vector<Vec3> together = tips_after(plants, 1, 100);
  for (std::size_t p = 0; p < plants.size(); ++p)
    EXPECT_EQ(together[p], tips_after({plants[p]}, 1, 100)[0]) << p;
}

TEST(RodRows, ALargePlantAloneMovesAsItDoesAmongOthers) {
  Random random(6);
  const std::vector<RodModel> plants = {random_plant(random, 900, false), plant::hanging_tree(),
                                        random_plant(random, 1000, false), plant::hanging_tree()};
  const std::vector<Vec3> together = tips_after(plants, 1, 20);
  EXPECT_EQ(together, tips_after(plants, 2, 20));
  for (std::size_t p = 0; p < plants.size(); ++p)
    EXPECT_EQ(together[p], tips_after({plants[p]}, 1, 20)[0]) << p;
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
  std::vector<RodModel> plants = garden();
  plants.push_back(plant::hanging_tree());
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
