#include "plugins/simulation/plants/start_overlaps.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "engine/io/csv.h"
#include "plugins/cosserat/solver/equilibrium.h"
#include "plugins/simulation/plants/plant_step.h"

namespace pedicel::simulation {

namespace {

// Less is rounding in a file.
constexpr double worth_saying = 1.0e-5;  // m

using Pairs = std::set<std::pair<int, int>>;  // (element, collider)

// Whether all elements from the clamp to this one overlap the collider.
bool grows_out_of(const cosserat::RodModel& model, const Pairs& overlapping, int element,
                  int collider) {
  for (; element >= 0; element = model.elements[element].parent)
    if (!overlapping.contains({element, collider})) return false;
  return true;
}

std::string organ_of(const cosserat::RodModel& model, const cosserat::CollisionShape& shape) {
  if (shape.fruit >= 0) return fruit_name(model, shape.fruit);
  return model.organs[model.elements[shape.element].organ];
}

}  // namespace

std::vector<bool> leaning_stems(const cosserat::RodModel& model,
                                const std::vector<coupling::Overlap>& overlaps,
                                const std::function<bool(int)>& is_of_body,
                                const std::function<bool(int)>& is_finger) {
  const auto organ = [&](int shape) {
    return model
        .elements[static_cast<std::size_t>(model.shapes[static_cast<std::size_t>(shape)].element)]
        .organ;
  };
  const auto is_fruit = [&](int shape) {
    return model.shapes[static_cast<std::size_t>(shape)].fruit >= 0;
  };
  std::set<int> gripped, stems;  // organs
  for (const coupling::Overlap& one : overlaps)
    if (is_of_body(one.collider))
      (is_fruit(one.shape) || is_finger(one.collider) ? gripped : stems).insert(organ(one.shape));
  const bool any = std::ranges::any_of(stems, [&](int one) { return !gripped.contains(one); });
  if (!any) return {};
  std::vector<bool> may(model.shapes.size());
  for (int shape = 0; shape < static_cast<int>(may.size()); ++shape)
    may[static_cast<std::size_t>(shape)] = !is_fruit(shape) && !gripped.contains(organ(shape));
  return may;
}

bool lean(const cosserat::RodModel& model, cosserat::RodState& state, const Vec3& gravity,
          cosserat::ContactSource& contacts) {
  const cosserat::RodState standing = state;
  cosserat::ContactSource* const source = &contacts;
  if (cosserat::find_equilibrium(model, state, gravity, {}, {&source, 1})) return true;
  state = standing;
  return false;
}

std::vector<StartOverlap> start_overlaps(const cosserat::RodModel& model,
                                         const coupling::ColliderSet& colliders,
                                         const std::vector<coupling::Overlap>& overlaps) {
  Pairs overlapping;
  for (const coupling::Overlap& one : overlaps)
    overlapping.insert({model.shapes[one.shape].element, one.collider});
  std::map<std::pair<std::string, std::string>, coupling::Overlap> deepest;
  for (const coupling::Overlap& one : overlaps) {
    const cosserat::CollisionShape& shape = model.shapes[one.shape];
    if (one.depth < worth_saying) continue;
    // A stem in the ground or in a pot is meant to be there.
    if (grows_out_of(model, overlapping, shape.element, one.collider)) continue;
    const std::string& name = colliders.collider(one.collider).name;
    coupling::Overlap& worst =
        deepest.try_emplace({name, organ_of(model, shape)}, one).first->second;
    // A pair counts as ignored as soon as one of its shapes is.
    const bool is_ignored = worst.is_ignored || one.is_ignored;
    if (one.depth > worst.depth) worst = one;
    worst.is_ignored = is_ignored;
  }
  std::vector<std::pair<double, StartOverlap>> found;
  for (const auto& [names, one] : deepest)
    found.emplace_back(
        one.depth, StartOverlap{one.collider,
                                names.first + " overlaps " + names.second + " by " +
                                    io::format_number(1.0e3 * one.depth, 2) + " mm at the start" +
                                    (one.is_ignored ? ", and does not touch it there" : "")});
  // The deepest first: that is the one to mend.
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<StartOverlap> all;
  for (auto& [depth, one] : found) all.push_back(std::move(one));
  return all;
}

}  // namespace pedicel::simulation
