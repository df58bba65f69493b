#include "plugins/cosserat/solver/contact_lanes.h"

// Compiled once for each instruction set, as lane_kernels.cpp is.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "plugins/cosserat/solver/contact_lanes.cpp"
// clang-format off: foreach_target.h includes this file again and must come first.
#include "hwy/foreach_target.h"
#include "hwy/highway.h"
// clang-format on

#include "plugins/cosserat/contact/capsule_lanes-inl.h"
#include "plugins/cosserat/contact/self_contact.h"
#include "plugins/cosserat/lanes/state_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pedicel::cosserat {
namespace HWY_NAMESPACE {

using Rows = std::span<ContactRow>;

HWY_INLINE GatheredPose pose_of(const RodState& state, const ContactRow& row, int lane) {
  return gather_pose(state, row.element + lane);
}

HWY_INLINE V3 surface_of(const RodState& state, const ContactRow& row, int lane) {
  const GatheredPose pose = pose_of(state, row, lane);
  return pose.position + pose.rotation * load3(row.arm, lane);
}

HWY_INLINE V3 tangential(const V3& v, const V3& normal) {
  return less_scaled(v, dot(v, normal), normal);
}

struct Push {
  V normal;     // N
  V3 friction;  // N, W
  V3 stretch;   // m, W, after sliding
  V across;     // N/m, secant stiffness of the friction spring
  M slips;
  V energy;  // J
};

// With the surface at `now`, of contacts found at `place`.
HWY_INLINE Push push(const ContactRow& row, int lane, const V3& now, const V3& place,
                     const V3& start) {
  const V zero = set(0.0), half = set(0.5);
  const V k = load(row.stiffness + lane), limit = load(row.limit + lane);
  const V3 normal = load3(row.normal, lane);
  const V reach = load(row.margin + lane) - load(row.gap + lane);
  const V overlap = hn::Max(zero, reach - dot(normal, now - place));
  Push push;
  push.normal = k * overlap;
  const V3 moved = load3(row.stretch, lane) + now - start - load3(row.surface_motion, lane);
  const M rubs = limit > zero;
  const V3 stretch = select(rubs, tangential(moved, normal), V3{zero, zero, zero});
  const V length = hn::Sqrt(dot(stretch, stretch));
  const V hold = k * length;
  const M slides = hold > limit;
  push.slips = hn::Or(slides, hn::Not(rubs));
  const V shorter = hn::IfThenElse(slides, limit / hold, set(1.0));
  push.stretch = shorter * stretch;
  push.across = hn::IfThenElseZero(rubs, shorter * k);
  push.friction = hn::Neg(push.across) * stretch;
  const V slid = limit * (length - half * limit / k), held = half * hold * length;
  push.energy = hn::MulAdd(half * push.normal, overlap, hn::IfThenElse(slides, slid, held));
  return push;
}

void Place(Rows rows, const RodState& start, const RodState& iterate) {
  for (ContactRow& row : rows)
    for (int lane = 0; lane < lane_count; lane += width) {
      const GatheredPose pose = pose_of(iterate, row, lane);
      const V3 normal = load3(row.normal, lane);
      const V3 arm = less_scaled(hn::Neg(load(row.back + lane)) * pose.rotation.c,
                                 load(row.radius + lane), normal);
      store3(into(pose.rotation, arm), row.arm, lane);
      store3(pose.position + arm, row.place, lane);
      store3(surface_of(start, row, lane), row.start, lane);
    }
}

// The spring's stiffness is one along the normal and another one across it. The sliding spring's is
// the secant stiffness: an upper bound of its Hessian, so Newton stays stable. So
//   hessian = across I + (along - across) n n^T
// and the block is that of a point at `arm` from the child node (add_point_spring()).
HWY_INLINE void block_of(const Push& push, V k, const V3& normal, const V3& arm, V* v) {
  const V zero = set(0.0), &across = push.across;
  const V along = hn::IfThenElseZero(push.normal > zero, k);
  const V3 turned = cross(arm, normal);
  // d (n . point) / d (position, rotation), and what across multiplies.
  const V one[6] = {normal.x, normal.y, normal.z, turned.x, turned.y, turned.z};
  const V3 a = across * arm;
  const V square = dot(a, arm);
  const V isotropic[triangle6] = {across,
                                  zero,
                                  across,
                                  zero,
                                  zero,
                                  across,
                                  zero,
                                  hn::Neg(a.z),
                                  a.y,
                                  hn::NegMulAdd(a.x, arm.x, square),
                                  a.z,
                                  zero,
                                  hn::Neg(a.x),
                                  hn::Neg(a.y * arm.x),
                                  hn::NegMulAdd(a.y, arm.y, square),
                                  hn::Neg(a.y),
                                  a.x,
                                  zero,
                                  hn::Neg(a.z * arm.x),
                                  hn::Neg(a.z * arm.y),
                                  hn::NegMulAdd(a.z, arm.z, square)};
  int place = 0;
#pragma GCC unroll 6
  for (int i = 0; i < 6; ++i) {
    const V scaled = (along - across) * one[i];
#pragma GCC unroll 6
    for (int j = 0; j <= i; ++j, ++place) v[place] = hn::MulAdd(scaled, one[j], isotropic[place]);
  }
  const V3 force = add_scaled(push.friction, push.normal, normal);
  const V3 moment = cross(arm, force);
  v[21] = force.x;
  v[22] = force.y;
  v[23] = force.z;
  v[24] = moment.x;
  v[25] = moment.y;
  v[26] = moment.z;
}

bool PushAll(Rows rows, const RodState& iterate, int* elements, ElementBlock* blocks) {
  bool stay = true;
  const auto set_element = [&](int lane, int element) {
    if (elements[lane] == element) return;
    elements[lane] = element;
    stay = false;
  };
  for (ContactRow& row : rows) {
    for (int lane = 0; lane < lane_count; lane += width) {
      const V3 place = load3(row.place, lane);
      const Push now = push(row, lane, place, place, load3(row.start, lane));
      store(now.energy, row.energy + lane);
      const M acts = hn::Or(now.normal > set(0.0), load(row.limit + lane) > set(0.0));
      if (hn::AllFalse(D(), acts)) {
        for (int k = lane; k < lane + width; ++k) set_element(k, -1);
        continue;
      }
      const V3 node = pose_of(iterate, row, lane).position;
      constexpr int room = (block_size + width - 1) / width * width;
      V values[room];
      for (V& value : values) value = set(0.0);
      block_of(now, load(row.stiffness + lane), load3(row.normal, lane), place - node, values);
      alignas(64) Lanes active;
      store(hn::IfThenElseZero(acts, set(1.0)), active);
      for (int first = 0; first < room; first += width) {
        transpose(values + first);
        const M inside = hn::FirstN(D(), static_cast<std::size_t>(block_size - first));
        for (int k = 0; k < width; ++k) {
          double* const to = blocks[lane + k].values.data() + first;
          if (first + width <= block_size)
            hn::StoreU(values[first + k], D(), to);
          else
            hn::BlendedStore(values[first + k], inside, D(), to);
        }
      }
      for (int k = 0; k < width; ++k)
        set_element(lane + k, active[k] != 0.0 ? static_cast<int>(row.element[lane + k]) : -1);
    }
    elements += lane_count;
    blocks += lane_count;
  }
  return stay;
}

// The other side's, where both sides of a self-contact stand beside each other.
HWY_INLINE V3 of_other_side(const V3& v) {
  return {hn::Reverse2(D(), v.x), hn::Reverse2(D(), v.y), hn::Reverse2(D(), v.z)};
}

void Follow(Rows rows, const RodState& iterate) {
  const V zero = set(0.0), half = set(0.5), one = set(1.0), two = set(2.0);
  for (ContactRow& row : rows)
    for (int lane = 0; lane < lane_count; lane += width) {
      const V3 now = surface_of(iterate, row, lane);
      const V3 move = now - load3(row.place, lane);
      const V3 plane = half * (move + of_other_side(move));
      const V gap = load(row.gap + lane) + dot(load3(row.normal, lane), move - plane);
      store3(now, row.place, lane);
      store(gap, row.gap + lane);
      store3(load3(row.surface_motion, lane) + plane, row.surface_motion, lane);
      // take_tangent()
      const V margin = load(row.spring_margin + lane), k = load(row.spring_stiffness + lane);
      const V overlap = hn::Max(zero, hn::NegMulAdd(two, gap, margin));
      const V stiffening = hn::Min(overlap / margin, set(most_stiffening));
      const V force = k * overlap * (one + stiffening);
      const V slope = hn::IfThenElse(stiffening < set(most_stiffening), two, one);
      const V stiffness = two * k * hn::MulAdd(slope, stiffening, one);
      store(stiffness, row.stiffness + lane);
      store(hn::IfThenElse(overlap > zero, gap + force / stiffness, half * margin),
            row.margin + lane);
    }
}

void Potential(std::span<const ContactRow> rows, const RodState& state, Lanes& energy) {
  for (int lane = 0; lane < lane_count; lane += width) {
    V sum = set(0.0);
    for (const ContactRow& row : rows)
      sum = sum + push(row, lane, surface_of(state, row, lane), load3(row.place, lane),
                       load3(row.start, lane))
                      .energy;
    store(sum, energy + lane);
  }
}

void End(Rows rows, int sides, const RodState& end, ContactEndRow* ends) {
  for (ContactRow& row : rows) {
    for (int lane = 0; lane < lane_count; lane += width) {
      const V3 now = surface_of(end, row, lane), place = load3(row.place, lane);
      const V3 move = now - place;
      const M paired = hn::FirstN(D(), static_cast<std::size_t>(std::max(0, sides - lane)));
      const V3 zero{set(0.0), set(0.0), set(0.0)};
      const V3 middle = select(paired, set(0.5) * (move + of_other_side(move)), zero);
      const Push last = push(row, lane, now, place + middle, load3(row.start, lane) + middle);
      store3(now, ends->place, lane);
      store(last.normal, ends->normal + lane);
      store3(last.friction, ends->friction, lane);
      store3(last.stretch, ends->stretch, lane);
      store(hn::IfThenElseZero(last.slips, set(1.0)), ends->slipping + lane);
    }
    sides -= lane_count;
    ++ends;
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace pedicel::cosserat
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pedicel::cosserat {

HWY_EXPORT(Place);
HWY_EXPORT(PushAll);
HWY_EXPORT(Follow);
HWY_EXPORT(Potential);
HWY_EXPORT(End);

// Nothing of it is ill-defined either.
ContactRow empty_contact_row() {
  ContactRow row{};
  for (int lane = 0; lane < lane_count; ++lane)
    row.gap[lane] = row.stiffness[lane] = row.spring_stiffness[lane] = row.spring_margin[lane] =
        1.0;
  return row;
}

void place_contacts(std::span<ContactRow> rows, const RodState& start, const RodState& iterate) {
  HWY_DYNAMIC_DISPATCH(Place)(rows, start, iterate);
}
bool push_contacts(std::span<ContactRow> rows, const RodState& iterate, int* elements,
                   ElementBlock* blocks) {
  return HWY_DYNAMIC_DISPATCH(PushAll)(rows, iterate, elements, blocks);
}
void follow_contacts(std::span<ContactRow> rows, const RodState& iterate) {
  HWY_DYNAMIC_DISPATCH(Follow)(rows, iterate);
}
double potential_of_contacts(std::span<const ContactRow> rows, const RodState& state) {
  alignas(64) Lanes energy;
  HWY_DYNAMIC_DISPATCH(Potential)(rows, state, energy);
  double sum = 0.0;
  for (const double lane : energy) sum += lane;
  return sum;
}
void end_contacts(std::span<ContactRow> rows, int sides, const RodState& end, ContactEndRow* ends) {
  HWY_DYNAMIC_DISPATCH(End)(rows, sides, end, ends);
}

}  // namespace pedicel::cosserat
#endif
