// The lists of pairs that SelfContact keeps.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "cosserat/self_contact.h"

namespace pedicel::cosserat {

namespace {

// A larger budget collects the far list more rarely, but with more pairs.
constexpr double skin = 0.35;        // mean lengths of a shape
constexpr double steps_ahead = 4.0;  // of the present motion
constexpr double slack = 0.25;       // of the present motion, for what iterations change
constexpr double most_motion = 2.0;  // mean lengths: what moves farther in a step may pass through

// Largest squared distance of an end from where it was.
double squared_way(const Capsules& now, const Capsules& before, std::size_t i) {
  double near = 0.0, far = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double dn = now.near[k][i] - before.near[k][i], df = now.far[k][i] - before.far[k][i];
    near += dn * dn;
    far += df * df;
  }
  return std::max(near, far);
}

}  // namespace

SelfContact::Lineage SelfContact::lineage(const RodModel& model, int element) {
  const auto parent = [&](int e) { return e < 0 ? -1 : model.elements[e].parent; };
  return {element, parent(element), parent(parent(element))};
}

// At most two joints apart: parent, grandparent, or sibling.
bool SelfContact::Lineage::is_near(const Lineage& other) const {
  return element == other.element || parent == other.parent || parent == other.element ||
         other.parent == element || grandparent == other.element || other.grandparent == element;
}

void SelfContact::place(const RodModel& model, const RodState& state, Capsules& capsules) const {
  const std::size_t count = model.shapes.size();
  const auto place_some = [&](int, std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
      const CollisionShape& shape = model.shapes[i];
      const Vec3 axis = state.orientation[shape.element] * Vec3::UnitZ();
      const Vec3& position = state.position[shape.element];
      for (int k = 0; k < 3; ++k) {
        capsules.near[k][i] = position[k] - shape.back_near * axis[k];
        capsules.far[k][i] = position[k] - shape.back_far * axis[k];
      }
    }
  };
  loop_.run(count, loop_.parts(count, worth_waking), place_some);
}

bool SelfContact::near_list_holds() const {
  bool holds = near_list_made_;
  for (std::size_t i = 0; holds && i < now_.size(); ++i)
    holds = squared_way(now_, near_.reference, i) <= near_.budget[i] * near_.budget[i];
  return holds;
}

void SelfContact::measure_ways() {
  const double most = most_motion * extent_;
  for (std::size_t i = 0; i < now_.size(); ++i)
    way_[i] = std::min(std::sqrt(squared_way(now_, start_, i)), most);
}

// A pair is needed in this step while its gap is not above margin + what the two move against each
// other. As the iterations move both by up to their slack, the gap may shrink and that motion grow
// by as much.
void SelfContact::collect_near(const RodModel& model) {
  measure_ways();
  for (std::size_t i = 0; i < way_.size(); ++i)
    near_.budget[i] = settings_.margin + slack * way_[i];
  if (!far_list_holds()) {
    collect_far(model);
    far_list_holds();
  }
  sift(far_.pairs, settings_.margin, reach_, measured_);
  measure(now_, measured_, loop_);
  work_.pairs += static_cast<long>(measured_.size());
  candidates_.clear();
  for (std::size_t i = 0; i < measured_.size(); ++i) {
    const int a = measured_.a[i], b = measured_.b[i];
    const double open = settings_.margin + 2.0 * (near_.budget[a] + near_.budget[b]);
    if (measured_.gap[i] <= open + way_[a] + way_[b] &&
        measured_.gap[i] <= open + moved_apart(a, b))
      candidates_.emplace_back(a, b);
  }
  sort_(candidates_, static_cast<int>(now_.size()));
  near_.pairs.clear();
  for (const auto& [a, b] : candidates_) near_.pairs.add(a, b);
  near_.reference = now_;
  near_list_made_ = true;
}

// Sets `reach_`: how much nearer than at the far list's reference a pair may come, one's share.
bool SelfContact::far_list_holds() {
  bool holds = true;
  for (std::size_t i = 0; i < now_.size(); ++i) {
    reach_[i] = std::sqrt(squared_way(now_, far_.reference, i)) + way_[i] + 2.0 * near_.budget[i];
    holds = holds && reach_[i] <= far_.budget[i];
  }
  return holds;
}

void SelfContact::collect_far(const RodModel& model) {
  ++work_.collections;
  far_.reference = now_;
  for (std::size_t i = 0; i < now_.size(); ++i) {
    far_.budget[i] = skin * extent_ + 2.0 * settings_.margin + steps_ahead * way_[i];
    const Vec3 near = now_.near_at(i), far = now_.far_at(i);
    boxes_[i].setEmpty();
    if (!std::isfinite((near + far).sum())) continue;
    const double wide =
        std::max(now_.radius_near[i], now_.radius_far[i]) + 0.5 * settings_.margin + far_.budget[i];
    boxes_[i].extend(near).extend(far);
    boxes_[i].min().array() -= wide;
    boxes_[i].max().array() += wide;
  }
  overlapping_.find(boxes_, candidates_, loop_);
  const int parts = loop_.parts(candidates_.size(), worth_waking);
  loop_.run(candidates_.size(), parts, [&](int part, std::size_t first, std::size_t end) {
    CapsulePairs& pairs = sieved_[part];
    pairs.clear();
    for (std::size_t i = first; i < end; ++i) {
      const auto [a, b] = candidates_[i];
      if (!is_left_out(model, a, b)) pairs.add(a, b);
    }
    measure(now_, pairs);
    sift(pairs, settings_.margin, far_.budget, kept_[part]);
  });
  far_.pairs.clear();
  for (int part = 0; part < parts; ++part) far_.pairs.append(kept_[part]);
}

// What nearly touches as drawn, by the far list there.
void SelfContact::exclude_touching() {
  for (std::size_t i = 0; i < far_.pairs.size(); ++i)
    if (far_.pairs.gap[i] < settings_.margin)
      excluded_.emplace_back(far_.pairs.a[i], far_.pairs.b[i]);
  std::sort(excluded_.begin(), excluded_.end());
  for (const auto& [a, b] : excluded_) ++first_excluded_[a + 1];
  std::partial_sum(first_excluded_.begin(), first_excluded_.end(), first_excluded_.begin());
}

// Shapes that are near in the tree, or across a weld, and those that nearly touch as drawn.
bool SelfContact::is_left_out(const RodModel& model, int a, int b) const {
  if (lineage_[a].is_near(lineage_[b])) return true;
  for (int i = first_excluded_[a]; i < first_excluded_[a + 1]; ++i)
    if (excluded_[i].second == b) return true;
  const auto joined = [&](const Lineage& x, const Lineage& y, const Weld& weld) {
    return (x.element == weld.a && lineage(model, weld.b).is_near(y)) ||
           (x.element == weld.b && lineage(model, weld.a).is_near(y));
  };
  return std::any_of(model.welds.begin(), model.welds.end(), [&](const Weld& weld) {
    return joined(lineage_[a], lineage_[b], weld) || joined(lineage_[b], lineage_[a], weld);
  });
}

// How far two capsules have moved against each other in this step, at most, wherever on them.
double SelfContact::moved_apart(int a, int b) const {
  const double most = most_motion * extent_;
  const auto way = [&](int i) {
    return std::pair(Vec3(now_.near_at(i) - start_.near_at(i)),
                     Vec3(now_.far_at(i) - start_.far_at(i)));
  };
  const auto [near_a, far_a] = way(a);
  const auto [near_b, far_b] = way(b);
  // Half of each capsule's turn in addition to what the middles do.
  const double turned = 0.5 * ((near_a - far_a).norm() + (near_b - far_b).norm());
  return std::min(0.5 * (near_a + far_a - near_b - far_b).norm() + turned, 2.0 * most);
}

}  // namespace pedicel::cosserat
