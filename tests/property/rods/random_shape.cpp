// Shapes of trees: what a layout of chains, packs and pieces may meet.
#include <algorithm>

#include "tests/property/rods/random_garden.h"

namespace pedicel::plain {

namespace {

using Parents = std::vector<int>;

Parents chain(int n) {
  Parents parents(n);
  for (int e = 0; e < n; ++e) parents[e] = e - 1;
  return parents;
}

// All from one element, or from the clamp itself.
Parents star(Random& random, int n) {
  Parents parents(n, random.integer(0, 1) ? 0 : -1);
  parents[0] = -1;
  return parents;
}

// A stem with a branch of `tooth` elements at every `gap`th of its elements.
Parents comb(Random& random, int n) {
  const int gap = random.integer(1, 5), tooth = random.integer(1, 12);
  const int teeth = random.integer(1, 3);  // at a place
  Parents parents;
  int stem = -1;
  while (static_cast<int>(parents.size()) < n) {
    for (int i = 0; i < gap; ++i) {
      parents.push_back(stem);
      stem = static_cast<int>(parents.size()) - 1;
    }
    for (int k = 0; k < teeth; ++k)
      for (int i = 0, from = stem; i < tooth; ++i) {
        parents.push_back(from);
        from = static_cast<int>(parents.size()) - 1;
      }
  }
  parents.resize(n);
  return parents;
}

// A stem that ends in many twigs of equal or of different lengths.
Parents broom(Random& random, int n) {
  const int stem = random.integer(1, std::max(1, n / 2));
  Parents parents = chain(stem);
  const int longest = random.integer(1, 30);
  const bool equal = random.integer(0, 1);
  while (static_cast<int>(parents.size()) < n) {
    int from = stem - 1;
    for (int i = equal ? longest : random.integer(1, longest); i > 0; --i) {
      parents.push_back(from);
      from = static_cast<int>(parents.size()) - 1;
    }
  }
  parents.resize(n);
  return parents;
}

// Each starts from one of the `window` before it: 1 is a chain, all of them a bush.
Parents random_tree(Random& random, int n) {
  static constexpr int windows[] = {2, 3, 5, 8, 20, 100, 1 << 20};
  const int window = windows[random.integer(0, 6)];
  Parents parents(n, -1);
  for (int e = 1; e < n; ++e) parents[e] = random.integer(std::max(0, e - window), e - 1);
  return parents;
}

// Each element carries so many: 2 doubles at every node.
Parents regular(Random& random, int n) {
  const int children = random.integer(2, 12);
  Parents parents(n, -1);
  for (int e = 1; e < n; ++e) parents[e] = (e - 1) / children;
  return parents;
}

// A short stem, thick with branches that have twigs: its pieces are a few elements long.
Parents crowded(Random& random, int n) {
  const int stem = random.integer(2, 12);
  Parents parents = chain(std::min(stem, n));
  const int branch = random.integer(3, 40);
  while (static_cast<int>(parents.size()) < n) {
    int from = random.integer(0, std::min(stem, n) - 1);
    for (int i = random.integer(1, branch); i > 0; --i) {
      parents.push_back(from);
      from = static_cast<int>(parents.size()) - 1;
      if (random.integer(0, 4) == 0) parents.push_back(from);
    }
  }
  parents.resize(n);
  return parents;
}

// The children of a few more elements stand at clamps of their own.
void add_clamps(Random& random, Parents& parents) {
  const int n = static_cast<int>(parents.size());
  for (int i = random.integer(1, 4); i > 0; --i) parents[random.integer(0, n - 1)] = -1;
}

std::vector<int> draw_organs(Random& random, const Parents& parents) {
  const double another = random.integer(0, 1) ? 0.0 : random.uniform(0.0, 0.5);
  std::vector<int> organs(parents.size(), 0);
  int last = 0;
  for (std::size_t e = 0; e < parents.size(); ++e) {
    organs[e] = parents[e] < 0 ? 0 : organs[parents[e]];
    if (random.uniform() < another) organs[e] = ++last;
  }
  return organs;
}

}  // namespace

Shape draw_shape(Random& random, int n) {
  Shape shape;
  switch (random.integer(0, 7)) {
    case 0:
      shape = {"chain", chain(n)};
      break;
    case 1:
      shape = {"star", star(random, n)};
      break;
    case 2:
      shape = {"comb", comb(random, n)};
      break;
    case 3:
      shape = {"broom", broom(random, n)};
      break;
    case 4:
      shape = {"regular tree", regular(random, n)};
      break;
    case 5:
      shape = {"crowded stem", crowded(random, n)};
      break;
    default:
      shape = {"random tree", random_tree(random, n)};
      break;
  }
  if (random.integer(0, 5) == 0) {
    add_clamps(random, shape.parents);
    shape.name += " on several clamps";
  }
  shape.leafy = random.integer(0, 7) == 0;
  shape.organs = draw_organs(random, shape.parents);
  return shape;
}

}  // namespace pedicel::plain
