// The symbolic phase against the theorem on fill, and the fill of the loops that plants have.
#include "plugins/cosserat/solver/block_structure.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <utility>

#include "tests/unit/cosserat/loop_graphs.h"

namespace pedicel::cosserat::cases {
namespace {

using Pairs = std::set<std::pair<int, int>>;  // (eliminated first, eliminated later)

std::vector<int> places(const BlockStructure& structure) {
  std::vector<int> place(structure.columns.size());
  for (std::size_t i = 0; i < place.size(); ++i)
    place[structure.columns[i].element] = static_cast<int>(i);
  return place;
}

Pairs blocks_of(const BlockStructure& structure) {
  Pairs pairs;
  for (const auto& [element, begin, end] : structure.columns)
    for (int i = begin; i < end; ++i) pairs.emplace(element, structure.entries[i].row);
  return pairs;
}

// Rose, Tarjan & Lueker (1976): the factor has a block for two elements exactly where a path joins
// them whose elements between are eliminated before both.
Pairs by_paths(const RodModel& model, const std::vector<int>& place) {
  std::vector<std::vector<int>> near(model.elements.size());
  const auto join = [&](int a, int b) {
    near[a].push_back(b);
    near[b].push_back(a);
  };
  for (int e = 0; e < model.size(); ++e)
    if (model.elements[e].parent >= 0) join(e, model.elements[e].parent);
  for (const Weld& weld : model.welds) join(weld.a, weld.b);
  Pairs pairs;
  for (int from = 0; from < model.size(); ++from) {
    std::set<int> seen = {from};
    std::vector<int> open = {from};
    while (!open.empty()) {
      const int at = open.back();
      open.pop_back();
      for (const int n : near[at]) {
        if (!seen.insert(n).second) continue;
        if (place[n] > place[from])
          pairs.emplace(from, n);
        else
          open.push_back(n);
      }
    }
  }
  return pairs;
}

TEST(BlockStructure, HasTheBlocksThatPathsDemand) {
  for (int seed = 0; seed < 50; ++seed) {
    Random random(seed);
    const RodModel model = random_graph(random, 30, random.integer(0, 15));
    const BlockStructure structure(model);
    EXPECT_EQ(blocks_of(structure), by_paths(model, places(structure))) << "seed " << seed;
  }
}

// Blocks of the factor, none of them stored where another one is or where a weld is added up; each
// part of the matrix is at its block, or is moved there.
TEST(BlockStructure, PutsTheMatrixWhereTheFactorHasIt) {
  Random random(1);
  const RodModel model = random_graph(random, 30, 15);
  const BlockStructure structure(model);
  using Pair = std::pair<int, int>;  // (rows, columns)
  std::map<int, Pair> held;
  for (const auto& [element, begin, end] : structure.columns) {
    EXPECT_TRUE(held.try_emplace(structure.diagonal(element), element, element).second);
    for (int i = begin; i < end; ++i) {
      const auto [row, block] = structure.entries[i];
      EXPECT_TRUE(held.try_emplace(block, element, row).second);
    }
  }
  EXPECT_LT(held.rbegin()->first, structure.blocks());
  std::map<int, Pair> added;
  for (int e = 0; e < model.size(); ++e)
    if (const int p = model.elements[e].parent; p >= 0) added[structure.coupling(e)] = {e, p};
  for (int w = 0; w < 15; ++w) {
    EXPECT_FALSE(held.contains(structure.weld(w)));
    added[structure.weld(w)] = {model.welds[w].b, model.welds[w].a};
  }
  for (const auto& [from, to, transposed] : structure.moves) {
    const auto [row, column] = added.at(from);
    EXPECT_EQ(held.at(to), transposed ? Pair(column, row) : Pair(row, column));
    added.erase(from);
  }
  for (const auto& [block, pair] : added) EXPECT_EQ(held.at(block), pair);
}

TEST(BlockStructure, ATreeIsEliminatedFromItsLastElementWithoutFill) {
  Random random(2);
  RodModel model = random_graph(random, 100, 0);
  for (int e = 1; e < 3; ++e) model.elements[e].parent = 0;
  const BlockStructure structure(model);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(structure.columns[i].element, 99 - i);
  EXPECT_EQ(structure.entries.size(), 99u);
  EXPECT_EQ(structure.targets.size(), 99u);
  EXPECT_EQ(structure.blocks(), 200);
}

// A tip tied back to the foot of its stem: every element of the loop sees the foot as well.
TEST(BlockStructure, ALoopFillsItsPath) {
  RodModel model;
  for (int e = 0; e < 10; ++e) add_bare(model, e - 1);
  connect(model, 0, 9);
  EXPECT_EQ(BlockStructure(model).entries.size(), 9u + 8u);
}

struct Cost {
  long blocks, products;
};
Cost cost(const RodModel& model) {
  const BlockStructure structure(model);
  return {static_cast<long>(structure.entries.size()), static_cast<long>(structure.targets.size())};
}

// Linear: twice as many more cost twice as much more, to the block.
TEST(BlockStructure, CostsInProportionToItsLoops) {
  const auto expect_linear = [](const Cost& one, const Cost& two, const Cost& four) {
    EXPECT_EQ(four.blocks - two.blocks, 2 * (two.blocks - one.blocks));
    EXPECT_EQ(four.products - two.products, 2 * (two.products - one.products));
  };
  expect_linear(cost(leafy_stem(25)), cost(leafy_stem(50)), cost(leafy_stem(100)));
  for (const int every : {1, 5})
    expect_linear(cost(staked_stem(50, every)), cost(staked_stem(100, every)),
                  cost(staked_stem(200, every)));
}

}  // namespace
}  // namespace pedicel::cosserat::cases
