#include "plugins/cosserat/solver/block_structure.h"

#include <algorithm>
#include <set>
#include <utility>

#include "engine/core/check.h"

namespace pedicel::cosserat {

namespace {

/// The graph that is left while elements are eliminated one by one.
class Elimination {
 public:
  explicit Elimination(const RodModel& model)
      : model_(model), near_(model.elements.size()), children_(model.elements.size()) {
    for (int e = 0; e < model.size(); ++e) {
      const int p = model.elements[e].parent;
      if (p < 0) continue;
      join(e, p);
      ++children_[p];
    }
    for (const Weld& weld : model.welds) {
      PEDICEL_ASSERT(weld.a != weld.b);
      join(weld.a, weld.b);
    }
    for (const Strand& strand : model.strands) {
      PEDICEL_ASSERT(strand.a != strand.b);
      join(strand.a, strand.b);
    }
    for (int e = 0; e < model.size(); ++e) left_.insert(key(e));
  }

  bool done() const { return left_.empty(); }

  /// Takes the next element out; what was next to it is next to each other from now on.
  int next() {
    const int e = -left_.begin()->second, p = model_.elements[e].parent;
    left_.erase(left_.begin());
    for (const int n : near_[e]) left_.erase(key(n));
    for (const int n : near_[e]) {
      near_[n].erase(e);
      near_[n].insert(near_[e].begin(), near_[e].end());
      near_[n].erase(n);
      if (n == p) --children_[n];
    }
    for (const int n : near_[e]) left_.insert(key(n));
    return e;
  }

  /// What stood next to an element when it was taken out.
  const std::set<int>& near(int element) const { return near_[element]; }

 private:
  using Key = std::pair<std::size_t, int>;

  Key key(int e) const { return {near_[e].size() + children_[e], -e}; }
  void join(int a, int b) {
    near_[a].insert(b);
    near_[b].insert(a);
  }

  const RodModel& model_;
  std::vector<std::set<int>> near_;  // neighbours that are left
  std::vector<int> children_;        // how many are left
  std::set<Key> left_;               // what is left, the next one first
};

}  // namespace

BlockStructure::BlockStructure(const RodModel& model)
    : place_(model.elements.size()),
      elements_(model.size()),
      welds_(static_cast<int>(model.welds.size())) {
  order(model);
  number_blocks(model);
  for (const Column& column : columns)
    for (int i = column.begin; i < column.end; ++i)
      for (int j = i; j < column.end; ++j)
        targets.push_back(block_of(entries[i].row, entries[j].row));
  for (int e = 0; e < elements_; ++e) {
    const int p = model.elements[e].parent;
    if (p >= 0 && place_[p] < place_[e]) add_move(coupling(e), e, p);
  }
  for (std::size_t w = 0; w < model.welds.size(); ++w)
    add_move(weld(static_cast<int>(w)), model.welds[w].b, model.welds[w].a);
  for (std::size_t s = 0; s < model.strands.size(); ++s)
    add_move(strand(static_cast<int>(s)), model.strands[s].b, model.strands[s].a);
}

void BlockStructure::add_move(int from, int row, int column) {
  const bool transposed = place_[column] < place_[row];
  moves.push_back({from, transposed ? block_of(column, row) : block_of(row, column), transposed});
}

void BlockStructure::order(const RodModel& model) {
  Elimination elimination(model);
  while (!elimination.done()) {
    const int e = elimination.next(), begin = static_cast<int>(entries.size());
    place_[e] = static_cast<int>(columns.size());
    for (const int n : elimination.near(e)) entries.push_back({n, 0});
    columns.push_back({e, begin, static_cast<int>(entries.size())});
  }
  const auto earlier = [&](const Entry& a, const Entry& b) {
    return place_[a.row] < place_[b.row];
  };
  for (const Column& column : columns)
    std::sort(entries.begin() + column.begin, entries.begin() + column.end, earlier);
}

void BlockStructure::number_blocks(const RodModel& model) {
  blocks_ = strand(static_cast<int>(model.strands.size()));
  for (const Column& column : columns)
    for (int i = column.begin; i < column.end; ++i)
      entries[i].block = entries[i].row == model.elements[column.element].parent
                             ? coupling(column.element)
                             : blocks_++;
}

int BlockStructure::block_of(int first, int later) const {
  if (first == later) return diagonal(first);
  const Column& column = columns[place_[first]];
  int i = column.begin;
  while (i < column.end && entries[i].row != later) ++i;
  PEDICEL_ASSERT(i < column.end);  // an elimination joins all that is next to it
  return entries[i].block;
}

}  // namespace pedicel::cosserat
