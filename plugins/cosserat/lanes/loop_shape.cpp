#include "plugins/cosserat/lanes/loop_shape.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numeric>
#include <utility>

#include "engine/core/check.h"

namespace pedicel::cosserat {

namespace {

using Neighbours = std::uint64_t;  // a bit an element, the last one for what carries them

constexpr Neighbours bit(int element) {
  return Neighbours{1} << element;
}

}  // namespace

LoopShape::LoopShape(std::vector<int> parents, std::vector<Joint> welds)
    : parents_(std::move(parents)), welds_(std::move(welds)) {
  if (size() > most_elements) return;
  order();
  place_couplings();
  place_products();
}

bool LoopShape::fits() const {
  return size() <= most_elements && static_cast<int>(entries_.size()) <= most_entries &&
         std::ranges::all_of(columns_,
                             [](const Column& c) { return c.end - c.begin <= most_in_column; });
}

void LoopShape::order() {
  const int carrier = size();
  std::vector<Neighbours> near(carrier + 1, 0);
  const auto join = [&](int a, int b) {
    a = a < 0 ? carrier : a;
    b = b < 0 ? carrier : b;
    near[a] |= bit(b);
    near[b] |= bit(a);
  };
  for (int e = 0; e < size(); ++e) join(e, parents_[e]);
  for (const Joint& weld : welds_) join(weld.a, weld.b);
  place_.assign(carrier + 1, carrier);
  std::vector<int> left(size());
  std::iota(left.begin(), left.end(), 0);
  while (!left.empty()) {
    const auto next = std::ranges::min_element(
        left, std::ranges::less{}, [&](int e) { return std::pair(std::popcount(near[e]), -e); });
    const int e = *next, begin = static_cast<int>(entries_.size());
    left.erase(next);
    place_[e] = static_cast<int>(columns_.size());
    for (int n = 0; n <= carrier; ++n) {
      if (!(near[e] & bit(n))) continue;
      entries_.push_back({n == carrier ? -1 : n, false});
      near[n] = (near[n] | near[e]) & ~(bit(e) | bit(n));
    }
    columns_.push_back({e, begin, static_cast<int>(entries_.size())});
  }
  const auto place = [&](const Entry& entry) {
    return entry.column < 0 ? carrier : place_[entry.column];
  };
  for (const Column& column : columns_)
    std::ranges::sort(entries_.begin() + column.begin, entries_.begin() + column.end, {}, place);
}

int LoopShape::entry_of(int first, int later) const {
  const Column& column = columns_[place_[first]];
  int i = column.begin;
  while (i < column.end && entries_[i].column != later) ++i;
  PEDICEL_ASSERT(i < column.end);  // an elimination joins all that is next to it
  return i;
}

LoopShape::Place LoopShape::place_of(int row, int column) const {
  const auto place = [&](int e) { return place_[e < 0 ? size() : e]; };
  const bool turned = place(column) < place(row);
  return {turned ? entry_of(column, row) : entry_of(row, column), turned, true};
}

void LoopShape::place_couplings() {
  std::vector<char> taken(entries_.size(), 0);
  const auto take = [&](Place place, bool half) {
    Entry& entry = entries_[place.entry];
    place.first = !taken[place.entry];
    entry.half = half && (place.first || entry.half);
    taken[place.entry] = 1;
    return place;
  };
  for (int e = 0; e < size(); ++e) {
    const Place place = place_of(e, parents_[e]);
    couplings_.push_back(take(place, !place.turned));
  }
  for (const Joint& weld : welds_) weld_couplings_.push_back(take(place_of(weld.b, weld.a), true));
}

// A product fills its target in full.
void LoopShape::place_products() {
  std::vector<char> taken(entries_.size(), 0);
  for (const std::vector<Place>* places : {&couplings_, &weld_couplings_})
    for (const Place& place : *places) taken[place.entry] = 1;
  for (const Column& column : columns_)
    for (int i = column.begin; i < column.end; ++i)
      for (int j = i + 1; j < column.end; ++j) {
        const int target = entry_of(entries_[i].column, entries_[j].column);
        targets_.push_back({target, !taken[target]});
        taken[target] = 1;
        entries_[target].half = false;
      }
}

namespace {

/// Which elements lie on a common loop.
class JoinedElements {
 public:
  explicit JoinedElements(const RodModel& model)
      : model_(model), depth_(model.size()), other_(model.size()), joined_(model.size(), 0) {
    std::iota(other_.begin(), other_.end(), 0);
    for (int e = 0; e < model.size(); ++e) depth_[e] = depth_of(model.elements[e].parent) + 1;
    // A loop is both paths to where they meet. What lies there carries the part, unless another
    // loop goes through both it and them.
    for (const Weld& weld : model.welds) {
      int a = weld.a, b = weld.b, last = -1;
      while (a != b) {
        int& deeper = depth_of(a) > depth_of(b) ? a : b;
        joined_[deeper] = 1;
        if (last >= 0) unite(deeper, last);
        last = deeper;
        deeper = model_.elements[deeper].parent;
      }
    }
  }

  bool is_joined(int e) const { return joined_[e]; }
  /// An end of a weld that lies on its loop: the other one may be what carries that.
  int on_loop(const Weld& weld) const { return depth_[weld.a] > depth_[weld.b] ? weld.a : weld.b; }
  /// The same for all of a part.
  int first(int e) {
    while (other_[e] != e) e = other_[e] = other_[other_[e]];
    return e;
  }

 private:
  int depth_of(int e) const { return e < 0 ? -1 : depth_[e]; }
  void unite(int a, int b) {
    a = first(a);
    b = first(b);
    other_[std::max(a, b)] = std::min(a, b);
  }

  const RodModel& model_;
  std::vector<int> depth_, other_;
  std::vector<char> joined_;
};

}  // namespace

std::optional<std::vector<LoopPart>> loop_parts(const RodModel& model) {
  if (!model.strands.empty()) return std::nullopt;  // they join trees, which no lane has beside it
  JoinedElements joined(model);
  std::vector<std::vector<int>> elements, welds;  // by part
  std::vector<int> part(model.size(), -1), place(model.size(), -1);
  for (int e = 0; e < model.size(); ++e) {
    if (!joined.is_joined(e)) continue;
    const int first = joined.first(e);
    if (first == e) {
      part[e] = static_cast<int>(elements.size());
      elements.emplace_back();
      welds.emplace_back();
    }
    part[e] = part[first];
    place[e] = static_cast<int>(elements[part[e]].size());
    elements[part[e]].push_back(e);
  }
  for (std::size_t w = 0; w < model.welds.size(); ++w)
    welds[part[joined.on_loop(model.welds[w])]].push_back(static_cast<int>(w));
  std::vector<LoopPart> parts;
  for (std::size_t p = 0; p < elements.size(); ++p) {
    const auto place_in = [&](int e) {
      return e >= 0 && part[e] == static_cast<int>(p) ? place[e] : -1;
    };
    std::vector<int> parents;
    std::vector<LoopShape::Joint> joints;
    for (const int e : elements[p]) parents.push_back(place_in(model.elements[e].parent));
    for (const int w : welds[p])
      joints.push_back({place_in(model.welds[w].a), place_in(model.welds[w].b)});
    const int from = model.elements[elements[p].front()].parent;
    parts.push_back({std::move(elements[p]), from, std::move(welds[p]),
                     LoopShape(std::move(parents), std::move(joints))});
    if (!parts.back().shape.fits()) return std::nullopt;
  }
  return parts;
}

}  // namespace pedicel::cosserat
