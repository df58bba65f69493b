#include <algorithm>
#include <cmath>

#include "tests/discrepancy/hidden_case.h"

namespace pedicel::hidden {

namespace {

using Kind = CaseOrder::Kind;

constexpr PlantKind plants[] = {PlantKind::stem, PlantKind::two_branches, PlantKind::side_branch,
                                PlantKind::stiff_stem};
constexpr double sizes[] = {2, 4, 8, 3, 2, 6, 4, 16};

PlantKind plant_for(const EffectUse& use, int k) {
  if (use.needs_branch) return plants[1 + k % 2];
  if (use.needs_slender) return k % 2 ? PlantKind::stiff_stem : PlantKind::stem;
  return plants[k % 4];
}

CaseOrder order_of(Kind kind, int k, PlantKind plant, PackKind pack) {
  CaseOrder order;
  order.kind = kind;
  order.plant = plant;
  order.pack = pack;
  order.coloured = (k / 2 + k) % 2;
  order.off = k % 3 != 0;
  order.hidden_start = k % 4 == 1;
  return order;
}

std::vector<CaseOrder> nulls() {
  std::vector<CaseOrder> list;
  for (int k = 0; k < 120; ++k) {
    list.push_back(order_of(Kind::null, k, plants[k % 4], static_cast<PackKind>(k / 4 % 5)));
    list.back().coloured = k % 8 >= 4 || k % 16 == 1;
    list.back().off = false;
  }
  return list;
}

std::vector<CaseOrder> effects(const std::vector<EffectUse>& uses) {
  std::vector<CaseOrder> list;
  for (int v = 0; v < 8; ++v)
    for (std::size_t e = 0; e < uses.size(); ++e) {
      const EffectUse& use = uses[e];
      const int k = v + static_cast<int>(e);
      CaseOrder order =
          order_of(Kind::effect, k, plant_for(use, k), use.packs[v % use.packs.size()]);
      // Over the effects every size meets every plant and both colours of noise.
      order.hidden = {use.name};
      order.size = sizes[(v + e + e / 4) % 8];
      order.told_apart = true;
      order.coloured = (v / 4 + e) % 2;
      order.hidden_start = (v + e / 4) % 4 == 1;
      if (use.name == "youngs_modulus" || use.name == "density" || use.name == "damping_time")
        order.off = false;
      list.push_back(order);
    }
  return list;
}

std::vector<CaseOrder> pairs() {
  static const std::vector<std::vector<std::string>> both = {
      {"base_compliance", "leaf_drag"},     {"extra_mass", "latency"},
      {"relaxation", "base_compliance"},    {"anisotropy", "latency"},
      {"weak_segment", "leaf_drag"},        {"stiffness_drift", "marker_scale"},
      {"attachment_compliance", "latency"}, {"extra_mass", "frame_rotation"}};
  std::vector<CaseOrder> list;
  for (int k = 0; k < 32; ++k) {
    const auto& names = both[k % both.size()];
    const bool branched = names.front() == "attachment_compliance";
    CaseOrder order = order_of(Kind::pair, k, branched ? plants[1 + k / 8 % 2] : plants[k / 8 % 4],
                               PackKind::mix);
    order.hidden = names;
    order.size = (k + k / 8) % 2 ? 8 : 4;
    order.coloured = k / 16 % 2;
    list.push_back(order);
  }
  return list;
}

std::vector<CaseOrder> look_alikes() {
  static const std::vector<std::vector<std::string>> alike = {
      {"base_compliance", "weak_segment"},
      {"attachment_compliance", "weak_segment"},
      {"youngs_modulus", "density"},
      {"mass_damping", "damping_time", "structural_damping"}};
  static constexpr PlantKind plant[] = {PlantKind::stem, PlantKind::two_branches, PlantKind::stem,
                                        PlantKind::stiff_stem};
  static constexpr PackKind pack[] = {PackKind::weights, PackKind::mix, PackKind::sweep,
                                      PackKind::sweep};
  std::vector<CaseOrder> list;
  for (int k = 0; k < 32; ++k) {
    const int which = k % 4;
    CaseOrder order = order_of(Kind::look_alike, k, plant[which], pack[which]);
    order.hidden = alike[which];
    std::rotate(order.hidden.begin(), order.hidden.begin() + k / 4 % order.hidden.size(),
                order.hidden.end());
    order.size = k / 4 % 2 ? 8 : 4;
    order.coloured = k / 8 % 2;
    order.off = false;
    list.push_back(order);
  }
  return list;
}

std::vector<CaseOrder> outsiders() {
  std::vector<CaseOrder> list;
  for (int k = 0; k < 32; ++k) {
    const EffectUse& use = outside_uses()[k % outside_uses().size()];
    const int v = k / 4;
    CaseOrder order =
        order_of(Kind::outside, v + k, plants[(v + k) % 4], use.packs[v % use.packs.size()]);
    order.hidden = {use.name};
    order.size = v % 2 ? 8 : 4;
    order.told_apart = true;
    order.coloured = v / 2 % 2;
    list.push_back(order);
  }
  return list;
}

// White and coloured noise by turns; rows at rest have no time in which it could have a colour, and
// show no damping.
std::vector<CaseOrder> records(const std::vector<RecordUse>& uses) {
  std::vector<CaseOrder> list;
  for (std::size_t i = 0; i < uses.size(); ++i) {
    const RecordUse& use = uses[i];
    const int row = static_cast<int>(i / 5), k = static_cast<int>(i) + 2 * row;
    const bool null = use.name.empty(), still = use.pack == PackKind::rest;
    CaseOrder order = order_of(null ? Kind::null : Kind::effect, k,
                               use.needs_branch ? plants[1 + row % 2] : plants[k % 4], use.pack);
    order.coloured = !still && row % 2;
    order.off =
        order.off && !null && !still && use.name != "youngs_modulus" && use.name != "damping_time";
    if (!null) {
      order.hidden = {use.name};
      order.size = sizes[k % 8];
      order.told_apart = true;
    }
    list.push_back(order);
  }
  return list;
}

// Lists of different lengths side by side, each evenly over the whole.
std::vector<CaseOrder> spread(const std::vector<std::vector<CaseOrder>>& lists) {
  std::vector<std::pair<double, CaseOrder>> all;
  for (std::size_t l = 0; l < lists.size(); ++l)
    for (std::size_t i = 0; i < lists[l].size(); ++i)
      all.push_back({(i + 0.1 + 0.2 * l) / lists[l].size(), lists[l][i]});
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<CaseOrder> list;
  for (auto& [where, order] : all) {
    order.number = static_cast<int>(list.size());
    list.push_back(order);
  }
  return list;
}

}  // namespace

const std::vector<CaseOrder>& case_orders() {
  static const std::vector<CaseOrder> orders = [] {
    std::vector<CaseOrder> list =
        spread({nulls(), effects(effect_uses()), pairs(), look_alikes(), outsiders()});
    for (const auto& later : {effects(later_uses()), records(record_uses())})
      for (CaseOrder order : later) {
        order.number = static_cast<int>(list.size());
        list.push_back(std::move(order));
      }
    return list;
  }();
  return orders;
}

const char* name_of(CaseOrder::Kind kind) {
  constexpr const char* names[] = {"null", "effect", "pair", "look_alike", "outside"};
  return names[static_cast<int>(kind)];
}

const char* name_of(Expected expected) {
  constexpr const char* names[] = {"adequate", "named", "ambiguous", "unknown"};
  return names[static_cast<int>(expected)];
}

}  // namespace pedicel::hidden
