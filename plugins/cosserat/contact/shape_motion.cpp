#include "plugins/cosserat/contact/shape_motion.h"

#include <algorithm>
#include <limits>

// Compiled once for each instruction set, as lane_kernels.cpp is.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "plugins/cosserat/contact/shape_motion.cpp"
// clang-format off: foreach_target.h includes this file again and must come first.
#include "hwy/foreach_target.h"
#include "hwy/highway.h"
// clang-format on

#include "plugins/cosserat/contact/capsule_lanes-inl.h"

#ifndef PEDICEL_COSSERAT_SHAPE_MOTION
#define PEDICEL_COSSERAT_SHAPE_MOTION
namespace pedicel::cosserat {
using EndsRow = ShapeMotion::EndsRow;
using Limits = ShapeMotion::Limits;
using Places = ShapeMotion::Places;
}  // namespace pedicel::cosserat
#endif

HWY_BEFORE_NAMESPACE();
namespace pedicel::cosserat {
namespace HWY_NAMESPACE {

HWY_INLINE V load_at(const std::vector<float>& values, std::size_t i) {
  return hn::PromoteTo(D(), hn::LoadU(hn::Rebind<float, D>(), &values[i]));
}
HWY_INLINE void store_at(V x, std::vector<float>& values, std::size_t i) {
  const hn::Rebind<float, D> d;
  hn::StoreU(hn::DemoteTo(d, x), d, &values[i]);
}

struct AxisEnds {
  V3 near, far;
};

HWY_INLINE AxisEnds operator+(const AxisEnds& a, const AxisEnds& b) {
  return {a.near + b.near, a.far + b.far};
}
HWY_INLINE AxisEnds operator-(const AxisEnds& a, const AxisEnds& b) {
  return {a.near - b.near, a.far - b.far};
}

// The farther end's.
HWY_INLINE V longest(const AxisEnds& moved) {
  return hn::Sqrt(hn::Max(dot(moved.near, moved.near), dot(moved.far, moved.far)));
}

HWY_INLINE V3 load3(const float (*p)[lane_count], int lane) {
  return {load(p[0] + lane), load(p[1] + lane), load(p[2] + lane)};
}
HWY_INLINE void store3(const V3& v, float (*p)[lane_count], int lane) {
  store(v.x, p[0] + lane);
  store(v.y, p[1] + lane);
  store(v.z, p[2] + lane);
}
HWY_INLINE AxisEnds load_ends(const std::vector<EndsRow>& rows, std::size_t i) {
  const EndsRow& row = rows[i / lane_count];
  const int lane = i % lane_count;
  return {load3(row.near, lane), load3(row.far, lane)};
}
HWY_INLINE void store_ends(const AxisEnds& ends, std::vector<EndsRow>& rows, std::size_t i) {
  EndsRow& row = rows[i / lane_count];
  const int lane = i % lane_count;
  store3(ends.near, row.near, lane);
  store3(ends.far, row.far, lane);
}

HWY_INLINE Ends load_all(const Capsules& capsules, std::size_t i) {
  return transposed([&](int k, int place) { return load_row(capsules[i + k], place); });
}

HWY_INLINE AxisEnds axis_of(const Ends& all) {
  return {all.near, all.far};
}

HWY_INLINE void store_capsules(const AxisEnds& ends, const Ends& radii, Capsules& capsules,
                               std::size_t i) {
  V all[fields] = {ends.near.x, ends.near.y, ends.near.z, radii.radius_near,
                   ends.far.x,  ends.far.y,  ends.far.z,  radii.radius_far};
  for (int place = 0; place < fields; place += width) {
    transpose(all + place);
    for (int k = 0; k < width; ++k) store(all[place + k], capsules[i + k].near + place);
  }
}

struct Poses {
  V3 position;
  Q orientation;
};

// Of the elements that carry the shapes from i on; beyond the last shape that one's again.
HWY_INLINE Poses poses_of(const RodModel& model, const RodState& state, std::size_t stems,
                          std::size_t i) {
  Poses out;
  const D d;
  if (i + width <= stems) {
    hn::LoadInterleaved3(d, state.position[i].data(), out.position.x, out.position.y,
                         out.position.z);
    hn::LoadInterleaved4(d, state.orientation[i].coeffs().data(), out.orientation.x,
                         out.orientation.y, out.orientation.z, out.orientation.w);
    return out;
  }
  alignas(64) double lanes[7][width];
  for (std::size_t k = 0; k < width; ++k) {
    const int e = model.shapes[std::min(i + k, model.shapes.size() - 1)].element;
    for (int j = 0; j < 3; ++j) lanes[j][k] = state.position[e][j];
    for (int j = 0; j < 4; ++j) lanes[3 + j][k] = state.orientation[e].coeffs()[j];
  }
  out.position = {load(lanes[0]), load(lanes[1]), load(lanes[2])};
  out.orientation = {load(lanes[3]), load(lanes[4]), load(lanes[5]), load(lanes[6])};
  return out;
}

// Shapes lie along their elements' axes.
HWY_INLINE AxisEnds place(const Places& places, const RodModel& model, const RodState& state,
                          std::size_t i) {
  const Poses poses = poses_of(model, state, places.stems, i);
  const V3 axis = axis3(poses.orientation);
  return {less_scaled(poses.position, load_at(places.back_near, i), axis),
          less_scaled(poses.position, load_at(places.back_far, i), axis)};
}

HWY_INLINE V minimum(V bound, V x) {
  return hn::IfThenElse(x < bound, x, bound);
}

// What an end did in the last step, less what was predicted, adds to its deviation.
HWY_INLINE void begin_step(const Places& places, const RodModel& model, const RodState& state,
                           std::size_t i, const ShapeMotion::Arrays& out) {
  const Ends before = load_all(out.start, i);
  const AxisEnds ends = place(places, model, state, i);
  const AxisEnds unexpected = ends - axis_of(before) - load_ends(out.predicted, i);
  store_ends(load_ends(out.deviation, i) + unexpected, out.deviation, i);
  store_capsules(ends, before, out.start, i);
}

// A shape's reach bounds by how much nearer than predicted it may come to contact in this step:
// its deviation where it is now, by how much this step's motion is another than predicted (what is
// nearer than it moved in the step is a contact), and what iterations may still change of both.
void UpdateNear(const Places& places, const Limits& limits, const RodModel& model,
                const RodState* begins, const RodState& state, std::size_t first, std::size_t end,
                const ShapeMotion::Arrays& out, ShapeMotion::Deviating& deviating) {
  for (std::size_t i = first; i < end; i += width) {
    if (begins) begin_step(places, model, *begins, i, out);
    const Ends start = load_all(out.start, i);
    const AxisEnds now = place(places, model, state, i);
    store_capsules(now, start, out.now, i);
    const AxisEnds moved = now - axis_of(start);
    store_ends(moved, out.reference, i);
    const V displacement = minimum(set(limits.most), longest(moved));
    const V bound = hn::MulAdd(set(limits.near_share), displacement, set(limits.margin));
    const AxisEnds unexpected = moved - load_ends(out.predicted, i);
    const V reach = longest(load_ends(out.deviation, i) + unexpected) +
                    minimum(set(limits.most), longest(unexpected)) + (bound + bound);
    store_at(displacement, out.displacement, i);
    store_at(bound, out.near_bound, i);
    store_at(reach, out.reach, i);
    const std::size_t shapes = model.shapes.size() - std::min(i, model.shapes.size());
    // Written so that a NaN counts as deviating.
    const M deviates =
        hn::And(hn::Not(reach <= load_at(out.far_bound, i)), hn::FirstN(D(), shapes));
    if (hn::AllFalse(D(), deviates)) continue;
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(D(), deviates, bits);
    for (unsigned left = bits[0]; left != 0; left &= left - 1)
      deviating.add(static_cast<int>(i) + __builtin_ctz(left));
  }
}

// Measures all shapes even where one has moved too far: contacts need the ends in any case.
bool ValidateNear(const Places& places, const RodModel& model, const RodState& state,
                  std::size_t first, std::size_t end, const ShapeMotion::Arrays& out) {
  M holds = hn::FirstN(D(), width);
  for (std::size_t i = first; i < end; i += width) {
    const Ends start = load_all(out.start, i);
    const AxisEnds now = place(places, model, state, i);
    store_capsules(now, start, out.now, i);
    // The near reference is kept relative to the step's start, which stays.
    const V moved = longest(now - axis_of(start) - load_ends(out.reference, i));
    holds = hn::And(holds, moved <= load_at(out.near_bound, i));
  }
  return hn::AllTrue(D(), holds);
}

// With a prediction the next steps are expected to be like this one, and there is no deviation.
// Else the reference is the iterate, which the step's start is behind by what has moved.
void RebuildFar(const Limits& limits, std::size_t first, std::size_t end, bool predicts,
                const ShapeMotion::Arrays& out) {
  const V least = set(limits.skin + 2.0 * limits.margin), zero = set(0.0);
  const AxisEnds nothing{{zero, zero, zero}, {zero, zero, zero}};
  for (std::size_t i = first; i < end; i += width) {
    const AxisEnds moved = load_ends(out.reference, i);
    store_ends(predicts ? moved : nothing, out.predicted, i);
    store_ends(predicts ? nothing : nothing - moved, out.deviation, i);
    const V bound = load_at(out.near_bound, i);
    store_at(bound + bound, out.reach, i);
    store_at(hn::MulAdd(set(limits.far_share), load_at(out.displacement, i), least), out.far_bound,
             i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace pedicel::cosserat
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pedicel::cosserat {

HWY_EXPORT(UpdateNear);
HWY_EXPORT(ValidateNear);
HWY_EXPORT(RebuildFar);

ShapeMotion::ShapeMotion(const RodModel& model, const Limits& limits)
    : count_(model.shapes.size()), limits_(limits) {
  const std::size_t room = (count_ + lane_count - 1) / lane_count * lane_count;
  start_.resize(room);
  now_.resize(room);
  predicted_.resize(room / lane_count);
  deviation_.resize(room / lane_count);
  reference_.resize(room / lane_count);
  for (std::vector<float>* values :
       {&places_.back_near, &places_.back_far, &displacement_, &reach_, &near_bound_, &far_bound_})
    values->assign(room, 0.0F);
  for (std::size_t i = 0; i < count_; ++i) {
    const CollisionShape& shape = model.shapes[i];
    start_[i].radius_near = shape.radius_near;
    start_[i].radius_far = shape.radius_far;
    places_.back_near[i] = static_cast<float>(shape.back_near);
    places_.back_far[i] = static_cast<float>(shape.back_far);
    if (places_.stems == i && shape.element == static_cast<int>(i)) ++places_.stems;
  }
  const RodState drawn = drawn_state(model);
  Deviating deviating;
  update_near(model, &drawn, drawn, 0, room, deviating);
  rebuild_far(0, room, false);
}

ShapeMotion::Arrays ShapeMotion::arrays() {
  return {start_,        now_,   predicted_,  deviation_, reference_,
          displacement_, reach_, near_bound_, far_bound_};
}

void ShapeMotion::update_near(const RodModel& model, const RodState* begins,
                              const RodState& iterate, std::size_t first, std::size_t end,
                              Deviating& deviating) {
  HWY_DYNAMIC_DISPATCH(UpdateNear)
  (places_, limits_, model, begins, iterate, first, end, arrays(), deviating);
}

bool ShapeMotion::validate_near(const RodModel& model, const RodState& iterate, std::size_t first,
                                std::size_t end) {
  return HWY_DYNAMIC_DISPATCH(ValidateNear)(places_, model, iterate, first, end, arrays());
}

void ShapeMotion::rebuild_far(std::size_t shape, bool predicts, double times) {
  const std::size_t row = shape / lane_count, lane = shape % lane_count;
  const auto restart = [&](const float(&reference)[3][lane_count], float(&predicted)[3][lane_count],
                           float(&deviation)[3][lane_count]) {
    for (int k = 0; k < 3; ++k) {
      predicted[k][lane] = predicts ? reference[k][lane] : 0.0F;
      deviation[k][lane] = predicts ? 0.0F : -reference[k][lane];
    }
  };
  restart(reference_[row].near, predicted_[row].near, deviation_[row].near);
  restart(reference_[row].far, predicted_[row].far, deviation_[row].far);
  far_bound_[shape] = static_cast<float>(
      times * (limits_.skin + 2.0 * limits_.margin + limits_.far_share * displacement_[shape]));
}

void ShapeMotion::rebuild_far(std::size_t first, std::size_t end, bool predicts) {
  HWY_DYNAMIC_DISPATCH(RebuildFar)(limits_, first, end, predicts, arrays());
}

}  // namespace pedicel::cosserat
#endif
