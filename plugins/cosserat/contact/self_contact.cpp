#include "plugins/cosserat/contact/self_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <ranges>
#include <span>
#include <string>
#include <tuple>
#include <utility>

#include "engine/core/check.h"
#include "plugins/cosserat/lanes/lane_access.h"

namespace pedicel::cosserat {

namespace {

double back_at(const CollisionShape& shape, double fraction) {
  return shape.back_near + fraction * (shape.back_far - shape.back_near);
}

void check(const SelfContactSettings& settings) {
  const auto above = [](const char* name, double value, bool good, const char* bound) {
    if (!good)
      throw UsageError("SelfContactSettings." + std::string(name) + " = " + std::to_string(value) +
                       ": must be " + bound);
  };
  above("stiffness", settings.stiffness, settings.stiffness > 0.0, "> 0");
  above("fruit_stiffness", settings.fruit_stiffness, settings.fruit_stiffness > 0.0, "> 0");
  above("friction", settings.friction, settings.friction >= 0.0, ">= 0");
  above("margin", settings.margin, settings.margin > 0.0, "> 0");
}

// A larger bound rebuilds the far list more rarely, but with more pairs.
ShapeMotion::Limits limits_of(const RodModel& model, const SelfContactSettings& settings) {
  double sum = 0.0;
  for (const CollisionShape& shape : model.shapes)
    sum += std::abs(shape.back_near - shape.back_far) + shape.radius_near + shape.radius_far;
  const double length = sum / static_cast<double>(std::max<std::size_t>(1, model.shapes.size()));
  ShapeMotion::Limits limits;
  limits.most = 2.0 * length;  // what moves farther in a step may pass through
  limits.margin = settings.margin;
  limits.skin = 0.3 * length;
  limits.near_share = 0.1;  // for what iterations change
  limits.far_share = 0.3;
  return limits;
}

constexpr std::pair beyond{std::numeric_limits<int>::max(), 0};  // all pairs
// Lists are sieved in bites: what a sieve leaves is measured before it leaves the cache.
constexpr std::size_t at_a_time = 512;  // pairs that stay in a core's cache
// Measuring a pair that a sieve has left takes as long as sifting so many.
constexpr double sifted = 10.0, measured = 30.0;  // from the far list, from the near list
// The far list is made for so many steps at most, in which the fastest goes so far (1, of what
// counts of a step's motion). Where it goes no farther than so many skins, nothing is
// predicted to move.
constexpr double most_steps = 16.0, farthest = 0.7, still = 2.0;
// Each deviating shape is compared with all boxes, so that they must be few.
constexpr std::size_t most_deviating = 32;
// So what is not listed is more than may be kept.
static_assert(std::tuple_size_v<decltype(ShapeMotion::Deviating::shapes)> > most_deviating);
// What deviated once will do so again: a larger bound lasts longer.
constexpr double deviating_bound = 2.0;  // 1, of others'

// Elements at most two joints apart from each other, by element, each with itself. `trees`: the
// first element of each, none where there is one.
std::vector<std::vector<int>> neighbours(const RodModel& model, std::span<const int> trees) {
  std::vector<std::vector<int>> children(model.elements.size()), near(model.elements.size());
  std::vector<std::vector<int>> clamped(trees.size() + 1);  // by tree: at its clamp
  const auto siblings = [&](int e) -> std::vector<int>& {
    const int parent = model.elements[e].parent;
    return parent >= 0 ? children[parent]
                       : clamped[std::ranges::upper_bound(trees, e) - trees.begin()];
  };
  for (int e = 0; e < model.size(); ++e) siblings(e).push_back(e);
  for (int e = 0; e < model.size(); ++e) {
    const int parent = model.elements[e].parent;
    near[e] = siblings(e);  // itself, too
    if (parent >= 0) near[e].push_back(parent);
    if (parent >= 0 && model.elements[parent].parent >= 0)
      near[e].push_back(model.elements[parent].parent);
    for (const int child : children[e]) {
      near[e].push_back(child);
      near[e].insert(near[e].end(), children[child].begin(), children[child].end());
    }
  }
  return near;
}

}  // namespace

void take_tangent(ContactPoint& point) {
  const auto& [stiffness, margin] = point.stiffening;
  const double overlap = std::max(0.0, margin - 2.0 * point.gap);
  const double stiffening = std::min(overlap / margin, most_stiffening);
  const double force = stiffness * overlap * (1.0 + stiffening);
  point.stiffness =
      2.0 * stiffness * (1.0 + (stiffening < most_stiffening ? 2.0 : 1.0) * stiffening);
  point.margin = overlap > 0.0 ? point.gap + force / point.stiffness : 0.5 * margin;
}

double pair_stiffness(const SelfContactSettings& settings, bool is_fruit, double lighter,
                      double dt) {
  return std::min(is_fruit ? settings.fruit_stiffness : settings.stiffness, lighter / (dt * dt));
}

void add_pair(ContactPoint point, const ContactSide& a, const ContactSide& b, const Vec3& normal_W,
              std::vector<ContactPoint>& found) {
  const auto add = [&](const ContactSide& own, const ContactSide& other, const Vec3& normal) {
    point.shape = own.shape;
    point.collider = self_contact_base + other.shape;
    point.back = own.back;
    point.radius = own.radius;
    point.normal_W = normal;
    found.push_back(point);
  };
  add(a, b, normal_W);
  add(b, a, -normal_W);
}

SelfContact::SelfContact(const RodModel& model, const SelfContactSettings& settings,
                         std::span<const int> trees)
    : settings_(settings), motion_(model, limits_of(model, settings)) {
  check(settings);
  collect_left_out(model, trees);
  collect_far();
  work_ = {};
}

void SelfContact::change_settings(const SelfContactSettings& settings) {
  check(settings);
  if (settings.margin != settings_.margin)
    throw UsageError("SelfContactSettings.margin: must stay");
  settings_ = settings;
}

void SelfContact::begin_step(const RodModel&, const RodState& start, double) {
  start_ = &start;
  step_begins_ = true;
}

void SelfContact::find(const RodModel& model, const RodState& state, double dt,
                       std::vector<ContactPoint>& found) {
  found_.clear();
  find_lists(model, state, dt, found_);
  for (std::size_t i = 0; i < found_.size(); ++i) found.push_back(found_[i]);
}

void SelfContact::find_lists(const RodModel& model, const RodState& state, double dt,
                             ContactLists& found) {
  // Without a step, as when contacts are only looked at, nothing has moved yet.
  if (!start_) begin_step(model, state, dt);
  const bool near_holds = update_lists(model, state);
  // One list of contacts a part: threads do not write beside each other, and the order of contacts
  // does not depend on them.
  const std::size_t first = found.add(far_parts_);
  loop_.each(far_parts_, [&](int part) {
    Scratch& scratch = scratch_[part];
    scratch.measured = 0;
    if (!near_holds) collect_near(part);
    touch_near(model, state, dt, scratch, found.list(first + part));
  });
  for (int part = 0; part < far_parts_; ++part) work_.pairs += scratch_[part].measured;
  if (!near_holds) share_out_far();
}

// Adds the contacts of a part of the near list.
void SelfContact::touch_near(const RodModel& model, const RodState& state, double dt,
                             Scratch& scratch, std::vector<ContactPoint>& found) const {
  const auto is_live = [&](const CollisionShape& shape) {
    return state.alive[shape.element] && (shape.fruit < 0 || !state.fruit_gone[shape.fruit]);
  };
  CapsulePairs& near = scratch.near;
  measure(motion_.now(), near);
  scratch.measured += static_cast<long>(near.size());
  // Pairs are touched eight at a time, in the order of the list.
  const std::size_t count = list_meeting(moved_capsules(), settings_.margin, near, scratch.meeting);
  TouchingRow row{};
  int lanes = 0;
  const auto touch_row = [&] {
    touch(motion_.start(), motion_.now(), *start_, state, row);
    for (int lane = 0; lane < lanes; ++lane) add_contact(model, dt, row, lane, found);
    lanes = 0;
  };
  for (std::size_t i = 0; i < count; ++i) {
    const int pair = scratch.meeting[i];
    const CollisionShape &a = model.shapes[near.a[pair]], &b = model.shapes[near.b[pair]];
    // What came off is no part of the plant any more.
    if (!is_live(a) || !is_live(b)) continue;
    row.a[lanes] = near.a[pair];
    row.b[lanes] = near.b[pair];
    row.element_a[lanes] = a.element;
    row.element_b[lanes] = b.element;
    row.at_a[lanes] = near.at_a[pair];
    row.at_b[lanes] = near.at_b[pair];
    row.back_a[lanes] = back_at(a, near.at_a[pair]);
    row.back_b[lanes] = back_at(b, near.at_b[pair]);
    if (++lanes == lane_count) touch_row();
  }
  if (lanes > 0) touch_row();
}

void SelfContact::add_contact(const RodModel& model, double dt, const TouchingRow& row, int lane,
                              std::vector<ContactPoint>& found) const {
  const double gap = row.gap[lane];
  // What is farther apart than it moved in this step is not met in the next iteration either.
  if (!(gap <= settings_.margin + row.apart[lane])) return;
  const int a = row.a[lane], b = row.b[lane];
  const CollisionShape &shape_a = model.shapes[a], &shape_b = model.shapes[b];
  const bool is_fruit = shape_a.fruit >= 0 || shape_b.fruit >= 0;
  const double lighter =
      std::min(model.elements[shape_a.element].mass, model.elements[shape_b.element].mass);
  ContactPoint point;
  point.gap = 0.5 * gap;
  point.stiffening = {pair_stiffness(settings_, is_fruit, lighter, dt), settings_.margin};
  take_tangent(point);
  point.friction = settings_.friction;
  point.surface_motion_W = vector_at(row.motion, lane);
  add_pair(point, {a, row.back_a[lane], row.radius_a[lane]},
           {b, row.back_b[lane], row.radius_b[lane]}, vector_at(row.normal, lane), found);
}

// task(part, first, end) for stretches of all shapes. Returns the number of parts.
template <class Task>
int SelfContact::for_all_shapes(const Task& task) {
  const std::size_t room = motion_.room();
  const int parts = loop_.parts(room, grain_size);
  loop_.run(room, parts, task);
  return parts;
}

// Whether the near list holds, which it never does where a step begins: what moved since the last
// step must be predicted anew.
bool SelfContact::update_lists(const RodModel& model, const RodState& state) {
  const auto of_parts = [&](int parts) { return std::span(scratch_).first(parts); };
  if (!step_begins_) {
    const int parts = for_all_shapes([&](int part, std::size_t first, std::size_t end) {
      scratch_[part].holds = motion_.validate_near(model, state, first, end);
    });
    if (std::ranges::all_of(of_parts(parts), [](const Scratch& s) { return s.holds; })) return true;
  }
  // The near list does not hold. Where a step begins, the far list is one step older.
  if (step_begins_) ++far_steps_;
  const RodState* const begins = std::exchange(step_begins_, false) ? start_ : nullptr;
  const int parts = for_all_shapes([&](int part, std::size_t first, std::size_t end) {
    scratch_[part].deviating.count = 0;
    motion_.update_near(model, begins, state, first, end, scratch_[part].deviating);
  });
  // A list without predicted motion does not grow old while all shapes keep within their bounds.
  const bool goes_on = far_steps_ <= far_steps_most_ || (far_stands_ && deviating_.empty());
  if (!goes_on || !find_deviating(of_parts(parts))) collect_far();
  for (const int shape : deviating_) motion_.forget_reach(shape);
  return false;
}

// A few shapes that deviate from their predicted motion need not rebuild all of the list: they get
// a new prediction, and all pairs of theirs. Returns whether they are few.
bool SelfContact::find_deviating(std::span<const Scratch> parts) {
  bool any = false;
  for (const Scratch& part : parts)
    for (const int i : part.deviating.listed()) {
      any = true;
      const auto place = std::lower_bound(deviating_.begin(), deviating_.end(), i);
      if (place == deviating_.end() || *place != i) {
        if (deviating_.size() == most_deviating) return false;
        deviating_.insert(place, i);
      }
      motion_.rebuild_far(i, !far_stands_, deviating_bound);
      make_box(i, far_steps_most_ - far_steps_);
      boxes_.close_groups(i / lane_count * lane_count, i + 1);
    }
  if (!any) return true;
  deviating_pairs_.clear();
  for (const int shape : deviating_) boxes_.find_with(shape, deviating_pairs_);
  return true;
}

CapsuleMotion SelfContact::moved_capsules() const {
  return {motion_.start(), motion_.now(), motion_.limits().most};
}

// One of the pairs of all parts of the far list, or one beyond them.
SelfContact::Pair SelfContact::far_pair(std::size_t i) const {
  for (int part = 0; part < far_parts_; i -= far_[part++].size())
    if (i < far_[part].size()) return {far_[part].a[i], far_[part].b[i]};
  return beyond;
}

// The part's share of the far list, and the pairs of deviating shapes in between.
void SelfContact::collect_near(int part) {
  Scratch& scratch = scratch_[part];
  scratch.near.clear();
  std::size_t all = 0, before = 0;
  for (int p = 0; p < far_parts_; ++p) all += far_[p].size();
  const auto begin_of = [&](int p) {
    return static_cast<std::size_t>(near_begins_[p] * static_cast<double>(all));
  };
  const std::size_t first = begin_of(part), end = begin_of(part + 1);
  for (int p = 0; p < far_parts_; ++p) {
    const std::size_t size = far_[p].size();
    const auto place = [&](std::size_t i) { return std::clamp(i, before, before + size) - before; };
    sift_far(far_[p], place(first), place(end), scratch);
    before += size;
  }
  add_deviating(part == 0 ? Pair{0, 0} : far_pair(first), far_pair(end), scratch);
  scratch.work = static_cast<double>(end - first) + sifted * static_cast<double>(scratch.measured) +
                 measured * static_cast<double>(scratch.near.size());
}

void SelfContact::sift_far(const CapsulePairs& far, std::size_t begin, std::size_t end,
                           Scratch& scratch) const {
  for (std::size_t first = begin; first < end; first += at_a_time) {
    CapsulePairs& pairs = scratch.pairs;
    pairs.clear();
    sift(far, first, std::min(end, first + at_a_time), settings_.margin, motions_until(far_steps_),
         motion_.reach(), pairs);
    keep_near(scratch);
    for (std::size_t i = 0; i < pairs.size(); ++i) scratch.near.add(pairs.a[i], pairs.b[i]);
  }
}

// A pair is needed in this step while its gap is not above margin + what the two move against each
// other. As the iterations move both by up to their displacement bound, the gap may shrink and that
// motion grow by as much.
void SelfContact::keep_near(Scratch& scratch) const {
  measure(motion_.now(), scratch.pairs);
  scratch.measured += static_cast<long>(scratch.pairs.size());
  keep_meeting(moved_capsules(), settings_.margin, 2.0, motion_.near_bound(), scratch.pairs);
}

// Those from `begin` on that are before `end`; pairs of two deviating shapes come twice.
void SelfContact::add_deviating(const Pair& begin, const Pair& end, Scratch& scratch) const {
  CapsulePairs& pairs = scratch.pairs;
  pairs.clear();
  for (std::size_t i = 0; i < deviating_pairs_.size(); ++i) {
    const Pair pair{deviating_pairs_.a[i], deviating_pairs_.b[i]};
    if (begin <= pair && pair < end) pairs.add(pair.first, pair.second);
  }
  if (pairs.size() == 0) return;
  keep_near(scratch);
  Pairs& added = scratch.deviating_pairs;
  added.clear();
  for (std::size_t i = 0; i < pairs.size(); ++i) added.emplace_back(pairs.a[i], pairs.b[i]);
  std::sort(added.begin(), added.end());
  added.erase(std::unique(added.begin(), added.end()), added.end());
  // From the last pair to the first, each to where it comes.
  CapsulePairs& near = scratch.near;
  std::size_t left = near.size(), to = left + added.size();
  near.make_room(added.size());
  near.resize(to);
  for (auto next = added.rbegin(); next != added.rend(); ++next) {
    for (; left > 0 && *next < Pair{near.a[left - 1], near.b[left - 1]}; --left) {
      --to;
      near.a[to] = near.a[left - 1];
      near.b[to] = near.b[left - 1];
    }
    --to;
    std::tie(near.a[to], near.b[to]) = *next;
  }
}

// So that each part would have had as much to do, were the work even within them.
void SelfContact::share_out_far() {
  const auto begins = near_begins_;
  double all = 0.0, before = 0.0;
  for (int part = 0; part < far_parts_; ++part) all += scratch_[part].work;
  int next = 1;
  for (int part = 0; part < far_parts_; ++part) {
    const double work = scratch_[part].work, length = begins[part + 1] - begins[part];
    for (; next < far_parts_ && all * next < far_parts_ * (before + work); ++next)
      near_begins_[next] = begins[part] + length * (all * next / far_parts_ - before) / work;
    before += work;
  }
}

void SelfContact::collect_far() {
  ++work_.collections;
  far_steps_ = 0;
  deviating_.clear();
  deviating_pairs_.clear();
  double fastest = 0.0;
  for (const float moved : motion_.displacement()) fastest = std::max<double>(fastest, moved);
  const double most = motion_.limits().most;
  // Where so little moves, larger boxes do without a prediction.
  far_stands_ = most_steps * fastest <= still * motion_.limits().skin;
  // A motion of which not all counts is not continued.
  far_steps_most_ =
      fastest < most ? static_cast<int>(std::min(most_steps, farthest * most / fastest)) : 0;
  loop_.run(motion_.room(), loop_.parts(motion_.room(), grain_size),
            [&](int, std::size_t first, std::size_t end) {
              motion_.rebuild_far(first, end, !far_stands_);
              for (std::size_t i = first; i < std::min(end, motion_.size()); ++i)
                make_box(i, far_steps_most_);
              boxes_.close_groups(first, std::min(end, motion_.size()));
            });
  for (CapsulePairs& part : far_) part.clear();
  const int parts = boxes_.find(loop_, [&](int part, CapsulePairs& pairs) {
    measure(motion_.now(), pairs);
    collect_coming(moved_capsules(), settings_.margin, motions_until(far_steps_most_),
                   motion_.far_bound(), pairs, far_[part]);
  });
  if (parts == far_parts_) return;
  far_parts_ = parts;
  for (int part = 0; part <= parts; ++part) near_begins_[part] = part / double(parts);
}

// Around all of a capsule, for so many steps of its predicted motion, as far as its bound reaches.
void SelfContact::make_box(std::size_t shape, int steps_left) {
  const int steps = far_stands_ ? 0 : steps_left;
  const Capsule &from = motion_.start()[shape], &now = motion_.now()[shape];
  const Vec3 near = now.near_at(), far = now.far_at();
  const Vec3 last_near = near + steps * (near - from.near_at());
  const Vec3 last_far = far + steps * (far - from.far_at());
  const double bound = motion_.displacement()[shape] + motion_.far_bound()[shape];
  const Vec3 wide =
      Vec3::Constant(std::max(now.radius_near, now.radius_far) + 0.5 * settings_.margin + bound);
  boxes_.set(shape, near.cwiseMin(far).cwiseMin(last_near).cwiseMin(last_far) - wide,
             near.cwiseMax(far).cwiseMax(last_near).cwiseMax(last_far) + wide);
}

// Shapes that are near in the tree, or across a weld, and those that nearly touch as drawn or, of
// two trees, overlap.
void SelfContact::collect_left_out(const RodModel& model, std::span<const int> trees) {
  std::vector<std::vector<int>> shapes(model.elements.size());  // of an element
  for (std::size_t i = 0; i < motion_.size(); ++i)
    shapes[model.shapes[i].element].push_back(static_cast<int>(i));
  const std::vector<std::vector<int>> near = neighbours(model, trees);
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
  // First what the tree says; then what that leaves is measured as drawn.
  boxes_.resize(motion_.size());
  leave_out();
  collect_far();
  const auto tree_of = [&](int shape) {
    return std::ranges::upper_bound(trees, model.shapes[shape].element) - trees.begin();
  };
  for (int part = 0; part < far_parts_; ++part)
    for (std::size_t i = 0; i < far_[part].size(); ++i) {
      const int a = far_[part].a[i], b = far_[part].b[i];
      // What is drawn to lie on another tree does so; what is drawn through it cannot.
      const double nearest = tree_of(a) == tree_of(b) ? settings_.margin : -settings_.margin;
      if (far_[part].gap[i] < nearest) pairs.emplace_back(a, b);
    }
  leave_out();
}

}  // namespace pedicel::cosserat
