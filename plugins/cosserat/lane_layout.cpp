#include "cosserat/lane_layout.h"

#include <algorithm>
#include <numeric>

namespace pedicel::cosserat {

namespace {

constexpr int smallest_share = 400;  // elements: less is not worth waking a thread for

// Chains that must stay with one thread, a chain after the one that it starts from.
struct Part {
  std::vector<int> chains;
  int elements = 0;
};

}  // namespace

LaneLayout::LaneLayout(std::span<const RodModel* const> plants, int threads, bool keep_blocks) {
  std::vector<bool> keeps;
  for (int p = 0; p < static_cast<int>(plants.size()); ++p) {
    add_chains(*plants[p], p);
    slots_.emplace_back(plants[p]->elements.size());
    keeps.push_back(keep_blocks || !plants[p]->welds.empty());
  }
  for (const std::vector<int>& group : share_out(threads)) {
    pack(group, keeps);
    group_begin_.push_back(packs());
  }
}

void LaneLayout::add_chains(const RodModel& model, int plant) {
  const int n = model.size();
  std::vector<int> height(n, 1);  // elements on the longest path
  std::vector<int> next(n, -1);   // the child that the chain goes on to
  const auto rank = [&](int parent, int child) {
    return std::pair(model.elements[child].organ == model.elements[parent].organ, height[child]);
  };
  for (int e = n - 1; e >= 0; --e) {
    const int p = model.elements[e].parent;
    if (p < 0) continue;
    height[p] = std::max(height[p], height[e] + 1);
    // Of equal ones the first child goes on: it is the last to come by here.
    if (next[p] < 0 || rank(p, e) >= rank(p, next[p])) next[p] = e;
  }
  std::vector<int> chain_of(n, -1);
  std::vector<int>& own = chains_of_plant_.emplace_back();
  for (int e = 0; e < n; ++e) {
    const int p = model.elements[e].parent;
    if (p >= 0 && next[p] == e) continue;
    Chain chain;
    chain.plant = plant;
    chain.parent = p < 0 ? -1 : chain_of[p];
    for (int i = e; i >= 0; i = next[i]) {
      chain_of[i] = static_cast<int>(chains_.size());
      chain.elements.push_back(i);
    }
    own.push_back(static_cast<int>(chains_.size()));
    chains_.push_back(std::move(chain));
  }
  for (auto it = own.rbegin(); it != own.rend(); ++it) {
    const Chain& chain = chains_[*it];
    if (chain.parent >= 0)
      chains_[chain.parent].level = std::max(chains_[chain.parent].level, chain.level + 1);
  }
}

std::vector<std::vector<int>> LaneLayout::share_out(int threads) const {
  const auto length = [&](int c) { return static_cast<int>(chains_[c].elements.size()); };
  std::vector<Part> parts;
  int total = 0;
  for (const std::vector<int>& chains : chains_of_plant_) {
    Part part{chains, 0};
    for (const int c : chains) part.elements += length(c);
    total += part.elements;
    parts.push_back(std::move(part));
  }
  const int wanted = std::clamp(total / smallest_share, 1, threads);

  // Largest first, each to the thread with the least so far.
  const auto shared = [&](std::vector<Part>& all) {
    std::stable_sort(all.begin(), all.end(),
                     [](const Part& a, const Part& b) { return a.elements > b.elements; });
    std::vector<Part> groups(wanted);
    for (const Part& part : all) {
      Part& least =
          *std::min_element(groups.begin(), groups.end(),
                            [](const auto& a, const auto& b) { return a.elements < b.elements; });
      least.chains.insert(least.chains.end(), part.chains.begin(), part.chains.end());
      least.elements += part.elements;
    }
    return groups;
  };
  const auto longest = [](const std::vector<Part>& groups) {
    int most = 0;
    for (const Part& group : groups) most = std::max(most, group.elements);
    return most;
  };

  // The largest part gives its stems to the top as long as that pays: the top runs alone, mostly
  // with one lane of eight in use.
  std::vector<int> top;
  int top_elements = 0;
  std::vector<Part> groups = shared(parts);
  while (wanted > 1) {
    const Part& largest = parts.front();
    std::vector<Part> split(parts.begin() + 1, parts.end());
    std::vector<int> stems, part_of(chains_.size(), -1);
    int stem_elements = 0;
    for (const int c : largest.chains) {  // a chain stands after the one that it starts from
      const int parent = chains_[c].parent;
      if (parent < 0 || std::find(top.begin(), top.end(), parent) != top.end()) {
        stems.push_back(c);
        stem_elements += length(c);
        continue;
      }
      if (part_of[parent] < 0) {
        part_of[c] = static_cast<int>(split.size());
        split.emplace_back();
      } else {
        part_of[c] = part_of[parent];
      }
      split[part_of[c]].chains.push_back(c);
      split[part_of[c]].elements += length(c);
    }
    const int before = longest(groups) + lane_count * top_elements;
    std::vector<Part> regrouped = shared(split);
    if (longest(regrouped) + lane_count * (top_elements + stem_elements) >= before) break;
    top.insert(top.end(), stems.begin(), stems.end());
    top_elements += stem_elements;
    parts = std::move(split);
    groups = std::move(regrouped);
  }

  std::vector<std::vector<int>> result;
  for (Part& group : groups) result.push_back(std::move(group.chains));
  result.push_back(std::move(top));
  return result;
}

void LaneLayout::pack(std::vector<int> chains, const std::vector<bool>& keeps) {
  const auto kept = [&](int c) { return static_cast<bool>(keeps[chains_[c].plant]); };
  const auto key = [&](int c) {
    const Chain& chain = chains_[c];
    return std::tuple(chain.level, kept(c), -static_cast<int>(chain.elements.size()), c);
  };
  std::sort(chains.begin(), chains.end(), [&](int a, int b) { return key(a) < key(b); });
  for (std::size_t i = 0; i < chains.size();) {
    const int first = chains[i], begin = rows();
    std::array<int, lane_count> nothing;
    nothing.fill(-1);
    elements_.resize(begin + 1 + chains_[first].elements.size(), nothing);
    for (int lane = 0; lane < lane_count && i < chains.size(); ++lane, ++i) {
      const int c = chains[i];
      Chain& chain = chains_[c];
      if (chain.level != chains_[first].level || kept(c) != kept(first)) break;
      chain.pack = packs();
      chain.lane = lane;
      int row = begin;
      for (const int e : chain.elements) {
        slots_[chain.plant][e] = {++row, lane};
        elements_[row][lane] = e;
      }
    }
    keeps_blocks_.push_back(kept(first));
    first_row_.push_back(rows());
  }
}

}  // namespace pedicel::cosserat
