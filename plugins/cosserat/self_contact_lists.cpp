// The lists of pairs that SelfContact keeps.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "cosserat/self_contact.h"

namespace pedicel::cosserat {

namespace {

constexpr std::size_t at_a_time = 512;  // pairs that stay in a core's cache

using Pairs = std::vector<std::pair<int, int>>;

// Elements at most two joints apart from each other, by element, each with itself.
std::vector<std::vector<int>> neighbours(const RodModel& model) {
  std::vector<std::vector<int>> children(model.elements.size() + 1);  // the first: at the clamp
  std::vector<std::vector<int>> near(model.elements.size());
  for (int e = 0; e < model.size(); ++e) children[model.elements[e].parent + 1].push_back(e);
  for (int e = 0; e < model.size(); ++e) {
    const int parent = model.elements[e].parent;
    near[e] = children[parent + 1];  // itself and its siblings
    if (parent >= 0) near[e].push_back(parent);
    if (parent >= 0 && model.elements[parent].parent >= 0)
      near[e].push_back(model.elements[parent].parent);
    for (const int child : children[e + 1]) {
      near[e].push_back(child);
      near[e].insert(near[e].end(), children[child + 1].begin(), children[child + 1].end());
    }
  }
  return near;
}

}  // namespace

// Whether holds(first, end) for all stretches of shapes, each of which is looked at.
template <class Holds>
bool SelfContact::for_all_shapes(const Holds& holds) {
  const std::size_t room = motion_.room();
  const int parts = loop_.parts(room, worth_waking);
  loop_.run(room, parts, [&](int part, std::size_t first, std::size_t end) {
    scratch_[part].holds = holds(first, end);
  });
  return std::all_of(scratch_.begin(), scratch_.begin() + parts,
                     [](const Scratch& scratch) { return scratch.holds; });
}

// A step's first look collects the near list; later ones see whether it holds.
void SelfContact::look(const RodModel& model, const RodState& state) {
  const auto look_again = [&](std::size_t first, std::size_t end) {
    return motion_.look_again(model, state, first, end);
  };
  if (near_list_made_ && for_all_shapes(look_again)) return;
  collect_near(for_all_shapes(
      [&](std::size_t first, std::size_t end) { return motion_.look(model, state, first, end); }));
}

CapsuleMotion SelfContact::moved_capsules() const {
  return {motion_.start(), motion_.now(), motion_.limits().most};
}

// A pair is needed in this step while its gap is not above margin + what the two move against each
// other. As the iterations move both by up to their slack, the gap may shrink and that motion grow
// by as much.
void SelfContact::collect_near(bool far_list_holds) {
  if (!far_list_holds) collect_far();
  loop_.each(far_parts_, [&](int part) { sift_far(part); });
  near_.clear();
  for (int part = 0; part < far_parts_; ++part) {
    for (const auto& [a, b] : scratch_[part].candidates) near_.add(a, b);
    work_.pairs += scratch_[part].measured;
  }
  near_.make_places();
  near_list_made_ = true;
}

// Those of the far list's pairs that may touch in this step.
void SelfContact::sift_far(int part) {
  Scratch& scratch = scratch_[part];
  scratch.candidates.clear();
  scratch.measured = 0;
  const CapsulePairs& far = far_[part];
  for (std::size_t first = 0; first < far.size(); first += at_a_time) {
    const std::size_t end = std::min(far.size(), first + at_a_time);
    CapsulePairs& pairs = scratch.pairs;
    pairs.clear();
    sift(far, first, end, settings_.margin, motion_.reach(), pairs);
    measure(motion_.now(), pairs);
    scratch.measured += static_cast<long>(pairs.size());
    keep_meeting(moved_capsules(), settings_.margin, 2.0, motion_.near_budget(), pairs);
    for (std::size_t i = 0; i < pairs.size(); ++i)
      scratch.candidates.emplace_back(pairs.a[i], pairs.b[i]);
  }
}

void SelfContact::collect_far() {
  ++work_.collections;
  loop_.run(motion_.room(), loop_.parts(motion_.room(), worth_waking),
            [&](int, std::size_t first, std::size_t end) {
              motion_.restart_far(first, end);
              make_boxes(first, std::min(end, motion_.size()));
              boxes_.close_groups(first, std::min(end, motion_.size()));
            });
  for (CapsulePairs& part : far_) part.clear();
  far_parts_ = boxes_.find(loop_, [&](int part, CapsulePairs& pairs) {
    measure(motion_.now(), pairs);
    sift(pairs, 0, pairs.size(), settings_.margin, motion_.far_budget(), far_[part]);
  });
}

// Around all of a capsule, from where it is now, until it has used up its budget.
void SelfContact::make_boxes(std::size_t first, std::size_t end) {
  for (std::size_t i = first; i < end; ++i) {
    const Capsule& capsule = motion_.now()[i];
    const Vec3 near = capsule.near_at(), far = capsule.far_at();
    const Vec3 wide = Vec3::Constant(std::max(capsule.radius_near, capsule.radius_far) +
                                     0.5 * settings_.margin + motion_.far_budget()[i]);
    boxes_.set(i, near.cwiseMin(far) - wide, near.cwiseMax(far) + wide);
  }
}

// Shapes that are near in the tree, or across a weld, and those that nearly touch as drawn.
void SelfContact::collect_left_out(const RodModel& model) {
  std::vector<std::vector<int>> shapes(model.elements.size());  // of an element
  for (std::size_t i = 0; i < motion_.size(); ++i)
    shapes[model.shapes[i].element].push_back(static_cast<int>(i));
  const std::vector<std::vector<int>> near = neighbours(model);
  Pairs pairs;
  const auto add = [&](int element, int other) {
    for (const int a : shapes[element])
      for (const int b : shapes[other])
        if (a != b) pairs.emplace_back(std::min(a, b), std::max(a, b));
  };
  for (int e = 0; e < model.size(); ++e)
    for (const int other : near[e]) add(e, other);
  for (const Weld& weld : model.welds) {
    for (const int other : near[weld.b]) add(weld.a, other);
    for (const int other : near[weld.a]) add(weld.b, other);
  }
  const auto leave_out = [&] {
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    boxes_.leave_out(pairs);
  };
  boxes_.resize(motion_.size());
  leave_out();
  collect_far();
  for (int part = 0; part < far_parts_; ++part)
    for (std::size_t i = 0; i < far_[part].size(); ++i)
      if (far_[part].gap[i] < settings_.margin)
        pairs.emplace_back(far_[part].a[i], far_[part].b[i]);
  leave_out();
}

}  // namespace pedicel::cosserat
