// The lists of pairs that SelfContact keeps.
#include <algorithm>
#include <cmath>
#include <utility>

#include "cosserat/self_contact.h"

namespace pedicel::cosserat {

namespace {

constexpr std::size_t at_a_time = 512;  // pairs that stay in a core's cache
// The far list is made for so many steps at most, in which the fastest goes so far (1, of what
// counts of a step's motion). Where it goes no farther than so many skins, nothing has a course.
constexpr double most_steps = 16.0, farthest = 0.7, still = 2.0;
constexpr std::size_t most_strays = 32;
constexpr double strays_budget = 2.0;  // 1, of others'

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
  if (!step_begins_ && for_all_shapes(look_again)) return;
  if (step_begins_) ++far_steps_;
  const RodState* const begins = std::exchange(step_begins_, false) ? start_ : nullptr;
  const bool holds = for_all_shapes([&](std::size_t first, std::size_t end) {
    return motion_.look(model, begins, state, first, end);
  });
  const bool goes_on = far_steps_ <= far_steps_most_ || (far_stands_ && strays_.empty());
  if (!goes_on || (!holds && !find_strays())) collect_far();
  for (const int stray : strays_) motion_.forget_reach(stray);
  collect_near();
}

// A few shapes that go another way than expected need not make all of the list anew: they get a new
// course, and all pairs of theirs. Returns whether they are few.
bool SelfContact::find_strays() {
  for (std::size_t i = 0; i < motion_.size(); ++i) {
    if (!motion_.is_astray(i)) continue;
    const auto place = std::lower_bound(strays_.begin(), strays_.end(), static_cast<int>(i));
    if (place == strays_.end() || *place != static_cast<int>(i)) {
      if (strays_.size() == most_strays) return false;
      strays_.insert(place, static_cast<int>(i));
    }
    motion_.restart_far(i, !far_stands_, strays_budget);
    make_box(i, far_steps_most_ - far_steps_);
    boxes_.close_groups(i / lane_count * lane_count, i + 1);
  }
  stray_pairs_.clear();
  for (const int stray : strays_) boxes_.find_with(stray, stray_pairs_);
  // They are measured whenever the near list is made.
  std::fill_n(stray_pairs_.gap.begin(), stray_pairs_.size(), -1.0e300);
  std::fill_n(stray_pairs_.closing.begin(), stray_pairs_.size(), 0.0F);
  return true;
}

CapsuleMotion SelfContact::moved_capsules() const {
  return {motion_.start(), motion_.now(), motion_.limits().most};
}

// A pair is needed in this step while its gap is not above margin + what the two move against each
// other. As the iterations move both by up to their slack, the gap may shrink and that motion grow
// by as much.
void SelfContact::collect_near() {
  loop_.each(far_parts_, [&](int part) {
    Scratch& scratch = scratch_[part];
    scratch.measured = 0;
    scratch.candidates.clear();
    scratch.astray.clear();
    sift_far(far_[part], 0, far_[part].size(), scratch, scratch.candidates);
    const std::size_t count = stray_pairs_.size();  // each part sifts its share
    sift_far(stray_pairs_, count * part / far_parts_, count * (part + 1) / far_parts_, scratch,
             scratch.astray);
  });
  astray_.clear();
  for (int part = 0; part < far_parts_; ++part)
    astray_.insert(astray_.end(), scratch_[part].astray.begin(), scratch_[part].astray.end());
  std::sort(astray_.begin(), astray_.end());  // those of two strays come twice
  astray_.erase(std::unique(astray_.begin(), astray_.end()), astray_.end());
  near_.clear();
  auto next = astray_.begin();
  const auto add_strays = [&](const auto& is_next) {
    for (; next != astray_.end() && is_next(*next); ++next) near_.add(next->first, next->second);
  };
  for (int part = 0; part < far_parts_; ++part)
    for (const auto& pair : scratch_[part].candidates) {
      add_strays([&](const auto& stray) { return stray < pair; });
      near_.add(pair.first, pair.second);
    }
  add_strays([](const auto&) { return true; });
  for (int part = 0; part < far_parts_; ++part) work_.pairs += scratch_[part].measured;
  near_.make_places();
}

// Adds those of the pairs `begin` to `end` that may touch in this step.
void SelfContact::sift_far(const CapsulePairs& far, std::size_t begin, std::size_t end,
                           Scratch& scratch, Pairs& kept) const {
  for (std::size_t first = begin; first < end; first += at_a_time) {
    CapsulePairs& pairs = scratch.pairs;
    pairs.clear();
    sift(far, first, std::min(end, first + at_a_time), settings_.margin, motions_until(far_steps_),
         motion_.reach(), pairs);
    measure(motion_.now(), pairs);
    scratch.measured += static_cast<long>(pairs.size());
    keep_meeting(moved_capsules(), settings_.margin, 2.0, motion_.near_budget(), pairs);
    for (std::size_t i = 0; i < pairs.size(); ++i) kept.emplace_back(pairs.a[i], pairs.b[i]);
  }
}

void SelfContact::collect_far() {
  ++work_.collections;
  far_steps_ = 0;
  strays_.clear();
  stray_pairs_.clear();
  double fastest = 0.0;
  for (const float way : motion_.way()) fastest = std::max<double>(fastest, way);
  const double most = motion_.limits().most;
  far_stands_ = most_steps * fastest <= still * motion_.limits().skin;
  // A motion of which not all counts is not continued.
  far_steps_most_ =
      fastest < most ? static_cast<int>(std::min(most_steps, farthest * most / fastest)) : 0;
  loop_.run(motion_.room(), loop_.parts(motion_.room(), worth_waking),
            [&](int, std::size_t first, std::size_t end) {
              motion_.restart_far(first, end, !far_stands_);
              for (std::size_t i = first; i < std::min(end, motion_.size()); ++i)
                make_box(i, far_steps_most_);
              boxes_.close_groups(first, std::min(end, motion_.size()));
            });
  for (CapsulePairs& part : far_) part.clear();
  far_parts_ = boxes_.find(loop_, [&](int part, CapsulePairs& pairs) {
    measure(motion_.now(), pairs);
    collect_coming(moved_capsules(), settings_.margin, motions_until(far_steps_most_),
                   motion_.far_budget(), pairs, far_[part]);
  });
}

// Around all of a capsule, for so many steps on its course, as far as its budget reaches.
void SelfContact::make_box(std::size_t shape, int steps_left) {
  const int steps = far_stands_ ? 0 : steps_left;
  const Capsule &from = motion_.start()[shape], &now = motion_.now()[shape];
  const Vec3 near = now.near_at(), far = now.far_at();
  const Vec3 last_near = near + steps * (near - from.near_at());
  const Vec3 last_far = far + steps * (far - from.far_at());
  const double budget = motion_.way()[shape] + motion_.far_budget()[shape];
  const Vec3 wide =
      Vec3::Constant(std::max(now.radius_near, now.radius_far) + 0.5 * settings_.margin + budget);
  boxes_.set(shape, near.cwiseMin(far).cwiseMin(last_near).cwiseMin(last_far) - wide,
             near.cwiseMax(far).cwiseMax(last_near).cwiseMax(last_far) + wide);
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
