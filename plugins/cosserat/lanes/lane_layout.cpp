#include "plugins/cosserat/lanes/lane_layout.h"

#include <algorithm>
#include <numeric>

namespace pedicel::cosserat {

namespace {

// Elements of a plant that several threads may share, and how many stems at most are few: more of
// them fill lanes side by side.
constexpr int large_plant = 800, few_stems = lane_count / 2;

// By element, the part with loops that it lies in; -1: none.
std::vector<int> part_of_elements(const RodModel& model, const std::vector<LoopPart>& parts) {
  std::vector<int> part(model.size(), -1);
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (const int e : parts[i].elements) part[e] = static_cast<int>(i);
  return part;
}

// The child that an element's chain goes on to; -1: none.
std::vector<int> next_of_chains(const RodModel& model, const std::vector<int>& part) {
  const int n = model.size();
  std::vector<int> height(n, 1);  // elements on the longest path
  std::vector<int> next(n, -1);
  const auto rank = [&](int parent, int child) {
    return std::pair(model.elements[child].organ == model.elements[parent].organ, height[child]);
  };
  for (int e = n - 1; e >= 0; --e) {
    const int p = model.elements[e].parent;
    if (p < 0) continue;
    height[p] = std::max(height[p], height[e] + 1);
    if (part[e] >= 0 || part[p] >= 0) continue;
    // Of equal ones the first child goes on: it is the last to come by here.
    if (next[p] < 0 || rank(p, e) >= rank(p, next[p])) next[p] = e;
  }
  return next;
}

bool starts_at_end_of(const Chain& chain, const Chain& parent) {
  return chain.from == parent.elements.back();
}

// What comes together in the last element of a first piece is no matter of the piece.
void set_levels(std::vector<Chain>& chains) {
  for (Chain& chain : chains) chain.level = 0;
  for (auto chain = chains.rbegin(); chain != chains.rend(); ++chain) {
    if (chain->parent < 0) continue;
    Chain& parent = chains[chain->parent];
    if (parent.from_clamp && starts_at_end_of(*chain, parent)) continue;
    parent.level = std::max(parent.level, chain->level + 1);
  }
}

// In the order of their first elements; parents are indices here.
std::vector<Chain> chains_of(const RodModel& model, const std::vector<int>& next,
                             const std::vector<LoopPart>& parts, const std::vector<int>& part) {
  std::vector<int> chain_of(model.size(), -1);
  std::vector<Chain> chains;
  for (int e = 0; e < model.size(); ++e) {
    const int p = model.elements[e].parent;
    if (p >= 0 && next[p] == e) continue;
    Chain chain;
    chain.parent = p < 0 ? -1 : chain_of[p];
    chain.from = p;
    if (part[e] >= 0) {
      const LoopPart& loops = parts[part[e]];
      if (loops.elements.front() != e) continue;
      chain.elements = loops.elements;
      chain.loops = &loops.shape;
      chain.welds = loops.welds;
    }
    for (int i = e; i >= 0 && part[e] < 0; i = next[i]) chain.elements.push_back(i);
    for (const int i : chain.elements) chain_of[i] = static_cast<int>(chains.size());
    chains.push_back(std::move(chain));
  }
  set_levels(chains);
  return chains;
}

// A stem of few lanes that is computed in one go keeps threads waiting until its last branch is
// done. In pieces that carry a pack of branches each it is computed while others still are.
void cut_few_stems(const RodModel& model, const std::vector<Chain>& chains,
                   std::vector<int>& next) {
  std::vector<int> on(model.size()), of_level(1);  // chains
  for (const Chain& chain : chains) {
    if (chain.from >= 0) ++on[chain.from];
    if (chain.level >= static_cast<int>(of_level.size())) of_level.resize(chain.level + 1);
    ++of_level[chain.level];
  }
  for (const Chain& chain : chains) {
    if (chain.loops || of_level[chain.level] > few_stems) continue;
    int carried = 0;
    for (std::size_t i = 0; i < chain.elements.size(); ++i) {
      const int here = on[chain.elements[i]];
      if (carried > 0 && carried + here > lane_count) {
        next[chain.elements[i - 1]] = -1;
        carried = 0;
      }
      carried += here;
    }
  }
}

// A path goes on at its end only if it was cut there.
void mark_first_pieces(std::vector<Chain>& chains) {
  for (const Chain& chain : chains) {
    if (chain.parent < 0 || chain.loops) continue;
    Chain& parent = chains[chain.parent];
    if (!parent.loops && parent.parent < 0 && parent.elements.size() > 1 &&
        starts_at_end_of(chain, parent))
      parent.from_clamp = true;
  }
  set_levels(chains);
}

}  // namespace

LaneLayout::LaneLayout(std::span<const RodModel* const> plants, bool keep_blocks) {
  std::vector<bool> keeps;
  for (const RodModel* const plant : plants) {
    std::optional<std::vector<LoopPart>> parts;
    if (!keep_blocks) parts = loop_parts(*plant);
    keeps.push_back(!parts);
    if (!parts) parts.emplace();
    const std::vector<int> part = part_of_elements(*plant, *parts);
    std::vector<int> next = next_of_chains(*plant, part);
    std::vector<Chain> chains = chains_of(*plant, next, *parts, part);
    if (plant->size() >= large_plant) {
      cut_few_stems(*plant, chains, next);
      chains = chains_of(*plant, next, *parts, part);
      if (!keeps.back()) mark_first_pieces(chains);
    }
    for (Chain& chain : chains)
      if (chain.loops) chain.loops = shared(*chain.loops);
    slots_.emplace_back(plant->elements.size());
    add_chains(std::move(chains));
  }
  pack(keeps);
}

// The one of the layout that is the same: there are as many as sorts of leaves.
const LoopShape* LaneLayout::shared(LoopShape shape) {
  for (const auto& known : shapes_)
    if (*known == shape) return known.get();
  shapes_.push_back(std::make_shared<const LoopShape>(std::move(shape)));
  return shapes_.back().get();
}

// Those of the next plant.
void LaneLayout::add_chains(std::vector<Chain> chains) {
  const int first = static_cast<int>(chains_.size());
  const int plant = static_cast<int>(chains_of_plant_.size());
  std::vector<int>& own = chains_of_plant_.emplace_back(chains.size());
  std::iota(own.begin(), own.end(), first);
  for (Chain& chain : chains) {
    chain.plant = plant;
    if (chain.parent >= 0) chain.parent += first;
    chains_.push_back(std::move(chain));
  }
}

std::vector<std::vector<int>> LaneLayout::needs() const {
  std::vector<std::vector<int>> result(tasks());
  for (const Chain& chain : chains_) {
    if (chain.parent < 0) continue;
    const int parent = chains_[chain.parent].pack;
    result[task_of(parent, slot(chain.plant, chain.from).row)].push_back(chain.pack);
  }
  for (const int pack : packs_from_clamp_) result[last_row_task_[pack]].push_back(pack);
  for (std::vector<int>& on : result) {
    std::sort(on.begin(), on.end());
    on.erase(std::unique(on.begin(), on.end()), on.end());
  }
  return result;
}

void LaneLayout::place(std::span<const int> packs) {
  std::vector<int> shift(packs.size());
  std::vector<std::array<int, lane_count>> elements;
  elements.reserve(elements_.size());
  for (const int p : packs) {
    shift[p] = static_cast<int>(elements.size()) - first_row_[p];
    elements.insert(elements.end(), elements_.begin() + first_row_[p],
                    elements_.begin() + end_row_[p]);
    first_row_[p] += shift[p];
    end_row_[p] += shift[p];
  }
  elements_ = std::move(elements);
  for (const Chain& chain : chains_)
    for (const int e : chain.elements) slots_[chain.plant][e].row += shift[chain.pack];
}

void LaneLayout::pack(const std::vector<bool>& keeps) {
  lanes_of_plant_.resize(keeps.size());
  std::vector<int> chains(chains_.size());
  std::iota(chains.begin(), chains.end(), 0);
  const auto kept = [&](int c) { return static_cast<bool>(keeps[chains_[c].plant]); };
  const auto number = [&](const LoopShape* loops) {  // no address decides where things stand
    const auto of_same = [&](const auto& shape) { return shape.get() == loops; };
    return loops ? std::ranges::find_if(shapes_, of_same) - shapes_.begin() : -1;
  };
  const auto key = [&](int c) {
    const Chain& chain = chains_[c];
    return std::tuple(chain.level, kept(c), !chain.from_clamp, number(chain.loops),
                      -static_cast<int>(chain.elements.size()), c);
  };
  std::sort(chains.begin(), chains.end(), [&](int a, int b) { return key(a) < key(b); });
  const auto side_by_side = [&](int c, int first) {
    const Chain &a = chains_[c], &b = chains_[first];
    return a.level == b.level && kept(c) == kept(first) && a.from_clamp == b.from_clamp &&
           a.loops == b.loops && (!a.from_clamp || a.elements.size() == b.elements.size());
  };
  for (std::size_t i = 0; i < chains.size();) {
    const int first = chains[i], begin = rows();
    std::array<int, lane_count> nothing;
    nothing.fill(-1);
    elements_.resize(begin + 1 + chains_[first].elements.size(), nothing);
    for (int lane = 0; lane < lane_count && i < chains.size(); ++lane, ++i) {
      const int c = chains[i];
      Chain& chain = chains_[c];
      if (!side_by_side(c, first)) break;
      chain.pack = packs();
      chain.lane = lane;
      std::vector<LaneRun>& runs = lanes_of_plant_[chain.plant];
      if (runs.empty() || runs.back().pack != packs() || runs.back().end != lane)
        runs.push_back({packs(), lane, lane});
      ++runs.back().end;
      int row = begin;
      for (const int e : chain.elements) {
        slots_[chain.plant][e] = {++row, lane};
        elements_[row][lane] = e;
      }
    }
    keeps_blocks_.push_back(kept(first));
    loops_.push_back(chains_[first].loops);
    first_row_.push_back(begin);
    end_row_.push_back(rows());
  }
  last_row_task_.assign(packs(), -1);
  for (const Chain& chain : chains_) {
    if (!chain.from_clamp || from_clamp(chain.pack)) continue;
    last_row_task_[chain.pack] = tasks();
    packs_from_clamp_.push_back(chain.pack);
  }
}

}  // namespace pedicel::cosserat
