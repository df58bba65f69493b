#include "plugins/cosserat/contact/touching_pairs.h"

// Compiled once for each instruction set, as lane_kernels.cpp is.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "plugins/cosserat/contact/touching_pairs.cpp"
// clang-format off: foreach_target.h includes this file again and must come first.
#include "hwy/foreach_target.h"
#include "hwy/highway.h"
// clang-format on

#include "plugins/cosserat/contact/capsule_lanes-inl.h"
#include "plugins/cosserat/lanes/state_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pedicel::cosserat {
namespace HWY_NAMESPACE {

HWY_INLINE Ends gather(const Capsules& capsules, const int* of) {
  return transposed([&](int k, int place) { return load_row(capsules[of[k]], place); });
}

HWY_INLINE V3 place_on(const Ends& capsule, V at) {
  return add_scaled(capsule.near, at, capsule.far - capsule.near);
}

HWY_INLINE V radius_at(const Ends& capsule, V at) {
  return hn::MulAdd(at, capsule.radius_far - capsule.radius_near, capsule.radius_near);
}

// How far the material points moved that lie `outward` (W) from the axes now.
HWY_INLINE V3 moved(const RodState& start, const RodState& state, const std::int64_t* elements,
                    V back, const V3& outward) {
  const GatheredPose now = gather_pose(state, elements), from = gather_pose(start, elements);
  const V3 arm = less_scaled(outward, back, now.rotation.c);
  return now.position + arm - from.position - from.rotation * into(now.rotation, arm);
}

void Touch(const Capsules& were, const Capsules& are, const RodState& start, const RodState& state,
           TouchingRow& row) {
  const V zero = set(0.0);
  for (int lane = 0; lane < lane_count; lane += width) {
    const V at_a = load(row.at_a + lane), at_b = load(row.at_b + lane);
    const Ends a = gather(are, row.a + lane), b = gather(are, row.b + lane);
    const V3 between = place_on(a, at_a) - place_on(b, at_b);
    const V3 before =
        place_on(gather(were, row.a + lane), at_a) - place_on(gather(were, row.b + lane), at_b);
    const V length = hn::Sqrt(dot(between, between));
    const V3 up{zero, zero, set(1.0)};
    const V3 direction = select(length > zero, (set(1.0) / length) * between, up);
    const V side = hn::IfThenElse(dot(before, direction) < zero, set(-1.0), set(1.0));
    const V3 normal = side * direction;
    const V radius_a = radius_at(a, at_a), radius_b = radius_at(b, at_b);
    const V3 motion_a = moved(start, state, row.element_a + lane, load(row.back_a + lane),
                              hn::Neg(radius_a) * normal);
    const V3 motion_b =
        moved(start, state, row.element_b + lane, load(row.back_b + lane), radius_b * normal);
    const V3 apart = motion_a - motion_b;
    store(radius_a, row.radius_a + lane);
    store(radius_b, row.radius_b + lane);
    store3(normal, row.normal, lane);
    store(side * length - radius_a - radius_b, row.gap + lane);
    store3(set(0.5) * (motion_a + motion_b), row.motion, lane);
    store(hn::Sqrt(dot(apart, apart)), row.apart + lane);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace pedicel::cosserat
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pedicel::cosserat {

HWY_EXPORT(Touch);

void touch(const Capsules& were, const Capsules& are, const RodState& start, const RodState& state,
           TouchingRow& row) {
  HWY_DYNAMIC_DISPATCH(Touch)(were, are, start, state, row);
}

}  // namespace pedicel::cosserat
#endif
