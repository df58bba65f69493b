#include "cosserat/lane_kernels.h"

// Compiled once for each of these instruction sets; a processor without AVX2 takes the portable
// one.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cosserat/lane_kernels.cpp"
// clang-format off: foreach_target.h includes this file again and must come first.
#include "hwy/foreach_target.h"
#include "hwy/highway.h"
// clang-format on

#include "cosserat/lane_extensions-inl.h"
#include "cosserat/lane_math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pedicel::cosserat {
namespace HWY_NAMESPACE {

constexpr int width = static_cast<int>(hn::MaxLanes(D()));

struct Pose {
  V3 position;
  Q orientation;
};

HWY_INLINE Pose load_pose(const PoseRow& row, int lane) {
  return {load3(row.position, lane), load4(row.orientation, lane)};
}
HWY_INLINE void store_pose(const Pose& pose, PoseRow& row, int lane) {
  store3(pose.position, row.position, lane);
  store4(pose.orientation, row.orientation, lane);
}

HWY_INLINE V3 centre_of_mass(const Pose& pose, V com_back) {
  return add_scaled(pose.position, hn::Neg(com_back), axis3(pose.orientation));
}

HWY_INLINE V3 middle_of(const Pose& pose, V length) {
  return add_scaled(pose.position, set(-0.5) * length, axis3(pose.orientation));
}

// Position of the child node from the parent's, per length; in W.
HWY_INLINE V3 along_of(const Pose& parent, const Pose& own, V length) {
  return (set(1.0) / length) * (own.position - parent.position);
}

HWY_INLINE V3 stretch_of(const ElementRow& element, int lane, const M3& r, const V3& along) {
  const V3 in_frame = into(r, along);
  return V3{in_frame.x, in_frame.y, in_frame.z - set(1.0)} - load3(element.rest_strain, lane);
}

HWY_INLINE Log bend_of(const ElementRow& element, int lane, const Pose& parent, const Pose& own) {
  return log_map(conjugate(load4(element.rest_rotation, lane)) *
                 (conjugate(parent.orientation) * own.orientation));
}

// ---- Terms of a step ----------------------------------------------------------------------------

HWY_INLINE void prepare_viscous(const RowArrays& rows, const Pack& pack, int row, int lane,
                                const Pose& parent, const Pose& own, V h) {
  const ElementRow& element = rows.element[row];
  TermRow& term = rows.term[row];
  const V a = load(pack.past_now + lane), b = load(pack.past_before + lane);
  const V viscous = load(element.damping_time + lane) / h;
  store(set(1.0) + viscous, term.stiffening + lane);
  const V share = viscous / (set(1.0) + viscous);
  const V3 stretch = stretch_of(element, lane, matrix(own.orientation),
                                along_of(parent, own, load(element.length + lane)));
  const V3 bend = bend_of(element, lane, parent, own).phi;
  store3(stretch, rows.rate[row].stretch, lane);
  store3(bend, rows.rate[row].bend, lane);
  const RateRow& before = rows.previous_rate[row];
  store3(share * (a * stretch - b * load3(before.stretch, lane)), term.stretch_target, lane);
  store3(share * (a * bend - b * load3(before.bend, lane)), term.bend_target, lane);
}

HWY_INLINE void prepare_air(const RowArrays& rows, const Pack& pack, int row, int lane,
                            const Pose& now, const Pose& before) {
  const ExtensionRow& extension = rows.extension[row];
  ExtensionTermRow& term = rows.extension_term[row];
  const V a = load(pack.past_now + lane), b = load(pack.past_before + lane);
  const V length = load(rows.element[row].length + lane);
  store3(a * middle_of(now, length) - b * middle_of(before, length), term.middle_past, lane);
  store3(add_scaled(load3(extension.velocity, lane), load(pack.gust_now + lane),
                    load3(extension.gust, lane)),
         term.air, lane);
  set_axis(rows, row, lane, 1.0);
}

// Returns sin^2 of half the angle by which the guess turns the element.
template <bool extended>
HWY_INLINE V prepare_row(const RowArrays& rows, const Pack& pack, int row, int lane) {
  const ElementRow& element = rows.element[row];
  const RateRow &rate = rows.rate[row], &before_rate = rows.previous_rate[row];
  TermRow& term = rows.term[row];
  const V a = load(pack.past_now + lane), b = load(pack.past_before + lane);
  const V h = load(pack.effective_step + lane);
  const V again = set(3.0) * b;  // 1, or 0 where the step is first order
  const Pose now = load_pose(rows.start[row], lane), before = load_pose(rows.previous[row], lane);
  const V com_back = load(element.com_back + lane);
  const V3 com = centre_of_mass(now, com_back), com_before = centre_of_mass(before, com_back);
  const Q turn = conjugate(before.orientation) * now.orientation;
  const V3 velocity = a * load3(rate.velocity, lane) - b * load3(before_rate.velocity, lane);
  const V3 omega = load3(rate.angular_velocity, lane);
  const V3 omega_before = load3(before_rate.angular_velocity, lane);
  const V3 spin = a * omega - b * omega_before;
  // Euler's equations in E: the gyroscopic torque enters explicitly, extrapolated.
  const V3 extrapolated = add_scaled(omega, again, omega - omega_before);
  const V3 inertia = load3(element.inertia, lane);
  const V3 torque = cross(extrapolated, times(inertia, extrapolated));
  const V3 gyroscopic{torque.x / inertia.x, torque.y / inertia.y, torque.z / inertia.z};

  const V drag = hn::MulAdd(load(element.mass_damping + lane), h, set(1.0));
  const V advance = h / drag;
  const V3 com_past = a * com - b * com_before;
  const Q rotation_past = now.orientation * exp_map(b * log_map(turn).phi);
  store3(com_past, term.com_past, lane);
  store4(rotation_past, term.rotation_past, lane);
  store3(add_scaled(com_past, advance, velocity), term.com_target, lane);
  store4(rotation_past * exp_map(advance * add_scaled(spin, hn::Neg(h), gyroscopic)),
         term.rotation_target, lane);
  store(drag / (h * h), term.inertia_scale + lane);
  if (extended || pack.damped) {
    prepare_viscous(rows, pack, row, lane, load_pose(rows.start[row - 1], lane), now, h);
    if constexpr (extended) prepare_joint(rows, pack, row, lane, load3(rows.rate[row].bend, lane));
  } else {
    const V zero = set(0.0);
    store(set(1.0), term.stiffening + lane);
    store3({zero, zero, zero}, term.stretch_target, lane);
    store3({zero, zero, zero}, term.bend_target, lane);
  }
  // Motion continued, with its acceleration where the plant has a smooth past.
  const V later = load(pack.accelerate + lane) * again;
  const V3 gained = load3(rate.velocity, lane) - load3(before_rate.velocity, lane);
  const V3 com_guess = add_scaled(add_scaled(com, again, com - com_before), later, gained);
  const Q turned = normalized(now.orientation * turn * exp_map(later * (omega - omega_before)));
  Pose guess;
  guess.orientation = select(again > set(0.0), turned, now.orientation);
  guess.position = add_scaled(com_guess, com_back, matrix(guess.orientation).c);
  store_pose(guess, rows.iterate[row], lane);
  if constexpr (extended)
    if (pack.windy) prepare_air(rows, pack, row, lane, now, before);
  const V3 vec{turn.x, turn.y, turn.z};
  return again * dot(vec, vec);
}

template <bool extended>
void prepare_pack(const RowArrays& rows, Pack& pack) {
  for (int lane = 0; lane < lane_count; lane += width) {
    V largest = set(0.0);
    for (int row = pack.begin + 1; row < pack.end; ++row)
      largest = hn::Max(largest, prepare_row<extended>(rows, pack, row, lane));
    store(set(2.0) * hn::Sqrt(largest), pack.turn + lane);
  }
}

void Prepare(const RowArrays& rows, Pack& pack) {
  pack.extended ? prepare_pack<true>(rows, pack) : prepare_pack<false>(rows, pack);
}

// ---- Potential ----------------------------------------------------------------------------------

// What gradient, Hessian and energy share.
struct Strained {
  Pose own;
  M3 r;
  V3 along;
  V length;
  V3 force_E;       // N, with damping
  V3 stretch_rate;  // N, with damping
  Log bend;         // from rest
  V3 bend_moment;   // N m, conjugate to bend.phi, with damping
  V3 bend_rate;     // N m/rad, with damping
  V bend_mixed;     // N m/rad, between the bending axes (extended)
  V3 off;           // m, W: centre of mass from its target
  Q turn;           // from the target's rotation, w >= 0
  V3 turn_rate;     // N m/rad, E
  V inertia;        // N/m
  V energy;         // J
};

template <bool extended>
HWY_INLINE Strained strain(const RowArrays& rows, const Pack& pack, int row, int lane,
                           const Pose& parent, const Pose& own) {
  const ElementRow& element = rows.element[row];
  const TermRow& term = rows.term[row];
  Strained s;
  s.own = own;
  s.r = matrix(own.orientation);
  s.length = load(element.length + lane);
  s.along = along_of(parent, own, s.length);
  const V stiffening = load(term.stiffening + lane);
  const V3 stretch = stretch_of(element, lane, s.r, s.along) - load3(term.stretch_target, lane);
  s.stretch_rate = stiffening * load3(element.stretch_stiffness, lane);
  if constexpr (extended) s.stretch_rate = load(pack.modulus + lane) * s.stretch_rate;
  s.force_E = times(s.stretch_rate, stretch);
  s.bend = bend_of(element, lane, parent, own);

  const V scale = load(term.inertia_scale + lane), mass = load(element.mass + lane);
  const V3 com = add_scaled(own.position, hn::Neg(load(element.com_back + lane)), s.r.c);
  s.inertia = mass * scale;
  s.off = com - load3(term.com_target, lane);
  const Q turn = conjugate(load4(term.rotation_target, lane)) * own.orientation;
  const V sign = hn::CopySign(set(1.0), turn.w);
  s.turn = {sign * turn.x, sign * turn.y, sign * turn.z, sign * turn.w};
  s.turn_rate = scale * load3(element.inertia, lane);
  const V3 vec{s.turn.x, s.turn.y, s.turn.z};
  const V3 g{set(rows.gravity[0]), set(rows.gravity[1]), set(rows.gravity[2])};
  const V half = set(0.5);
  // 1/2 l strain.K strain + 1/2 phi.K phi + 1/2 m/h~^2 |off|^2 + 1/2 (2 vec).I/h~^2 (2 vec) - m g.c
  V energy = half * s.length * dot(stretch, s.force_E);
  if constexpr (extended) {
    const Bending bending = bend_joint(rows, pack, row, lane, s.bend.phi);
    s.bend_moment = bending.moment;
    s.bend_rate = bending.hessian;
    s.bend_mixed = bending.mixed;
    energy = hn::MulAdd(half, bending.linear, energy) + bending.energy;
    if (pack.windy)
      energy = energy + drag_of(rows, pack, row, lane, middle_of(own, s.length)).energy;
  } else {
    const V3 off = s.bend.phi - load3(term.bend_target, lane);
    s.bend_rate = stiffening * load3(element.bend_stiffness, lane);
    s.bend_moment = times(s.bend_rate, off);
    energy = hn::MulAdd(half, dot(off, s.bend_moment), energy);
  }
  energy = hn::MulAdd(half * s.inertia, dot(s.off, s.off), energy);
  energy = hn::MulAdd(set(2.0), dot(vec, times(s.turn_rate, vec)), energy);
  energy = hn::NegMulAdd(mass, dot(g, com - load3(term.com_past, lane)), energy);
  s.energy = load(element.alive + lane) * energy;
  return s;
}

// The blocks of one element. Lower triangles by rows; the coupling's rows are the element's, its
// columns the parent's, and its upper right quarter is zero.
struct Blocks {
  V diagonal[triangle6];
  V right[6];
  S3 coupling_stretch;   // upper left
  V3 coupling_lever[3];  // lower left, by rows
  S3 coupling_bend;      // lower right
  V3 parent_force, parent_moment;
};

template <bool extended>
HWY_INLINE Blocks blocks_of(const RowArrays& rows, const Pack& pack, int row, int lane,
                            const Strained& s) {
  const ElementRow& element = rows.element[row];
  Blocks out;
  const V3 &a = s.along, &axis = s.r.c;
  const V zero = set(0.0);
  const V3 force = s.r * s.force_E;
  const S3 k = sandwich(s.r, s.stretch_rate);
  // Columns of k [a]x, the change of force with rotation.
  const V3 k0{k.xx, k.yx, k.zx}, k1{k.yx, k.yy, k.zy}, k2{k.zx, k.zy, k.zz};
  const V3 lever0 = a.z * k1 - a.y * k2, lever1 = a.x * k2 - a.z * k0, lever2 = a.y * k0 - a.x * k1;

  const M3 jacobian = inverse_jacobian_transposed(s.bend);
  const M3 bending{s.r * jacobian.a, s.r * jacobian.b, s.r * jacobian.c};
  S3 bend = sandwich(bending, s.bend_rate);
  if constexpr (extended) add_mixed(bending, s.bend_mixed, bend);
  const V3 bend_moment = negative(bending * s.bend_moment);
  const V tension = hn::Max(s.force_E.z, zero) * s.length;

  const V3 arm = hn::Neg(load(element.com_back + lane)) * axis;
  const V w = s.inertia;
  const V arm2 = w * dot(arm, arm);
  const V3 warm = w * arm;
  const S3 rotary = sandwich(s.r, s.turn_rate);

  const V inverse_length = set(1.0) / s.length;
  out.coupling_stretch = {hn::Neg(inverse_length * k.xx), hn::Neg(inverse_length * k.yx),
                          hn::Neg(inverse_length * k.yy), hn::Neg(inverse_length * k.zx),
                          hn::Neg(inverse_length * k.zy), hn::Neg(inverse_length * k.zz)};
  out.coupling_lever[0] = negative(lever0);
  out.coupling_lever[1] = negative(lever1);
  out.coupling_lever[2] = negative(lever2);
  out.coupling_bend = {hn::Neg(bend.xx), hn::Neg(bend.yx), hn::Neg(bend.yy),
                       hn::Neg(bend.zx), hn::Neg(bend.zy), hn::Neg(bend.zz)};

  V* d = out.diagonal;
  d[0] = w - out.coupling_stretch.xx;
  d[1] = hn::Neg(out.coupling_stretch.yx);
  d[2] = w - out.coupling_stretch.yy;
  d[3] = hn::Neg(out.coupling_stretch.zx);
  d[4] = hn::Neg(out.coupling_stretch.zy);
  d[5] = w - out.coupling_stretch.zz;
  // Lower left: (k [a]x)^T + w [arm]x.
  d[6] = lever0.x;
  d[7] = lever0.y - warm.z;
  d[8] = lever0.z + warm.y;
  d[10] = lever1.x + warm.z;
  d[11] = lever1.y;
  d[12] = lever1.z - warm.x;
  d[15] = lever2.x - warm.y;
  d[16] = lever2.y + warm.x;
  d[17] = lever2.z;
  // Lower right: l [a]x^T k [a]x + bending + tension (1 - axis axis^T) + w (arm^2 - arm arm^T)
  // + rotary inertia.
  const V l = s.length;
  const V round = tension + arm2;
  const V3 taxis = tension * axis;
  const V xx = a.z * lever0.y - a.y * lever0.z, yx = a.x * lever0.z - a.z * lever0.x;
  const V yy = a.x * lever1.z - a.z * lever1.x, zx = a.y * lever0.x - a.x * lever0.y;
  const V zy = a.y * lever1.x - a.x * lever1.y, zz = a.y * lever2.x - a.x * lever2.y;
  d[9] =
      hn::MulAdd(l, xx, bend.xx + rotary.xx) + round - hn::MulAdd(taxis.x, axis.x, warm.x * arm.x);
  d[13] = hn::MulAdd(l, yx, bend.yx + rotary.yx) - hn::MulAdd(taxis.y, axis.x, warm.y * arm.x);
  d[14] =
      hn::MulAdd(l, yy, bend.yy + rotary.yy) + round - hn::MulAdd(taxis.y, axis.y, warm.y * arm.y);
  d[18] = hn::MulAdd(l, zx, bend.zx + rotary.zx) - hn::MulAdd(taxis.z, axis.x, warm.z * arm.x);
  d[19] = hn::MulAdd(l, zy, bend.zy + rotary.zy) - hn::MulAdd(taxis.z, axis.y, warm.z * arm.y);
  d[20] =
      hn::MulAdd(l, zz, bend.zz + rotary.zz) + round - hn::MulAdd(taxis.z, axis.z, warm.z * arm.z);

  const V mass = load(element.mass + lane);
  const V3 weight{mass * set(rows.gravity[0]), mass * set(rows.gravity[1]),
                  mass * set(rows.gravity[2])};
  const V3 pull = weight - w * s.off;
  // phi = 2 vec(q~^-1 q) changes by (w + [vec]x) R^T per unit of rotation.
  const V3 vec{s.turn.x, s.turn.y, s.turn.z};
  const V3 conjugate_turn = set(2.0) * times(s.turn_rate, vec);
  const V3 rotary_moment = s.r * (s.turn.w * conjugate_turn - cross(vec, conjugate_turn));
  const V3 head = pull - force;
  const V3 tail = l * cross(a, force) + bend_moment + cross(arm, pull) - rotary_moment;
  out.right[0] = head.x;
  out.right[1] = head.y;
  out.right[2] = head.z;
  out.right[3] = tail.x;
  out.right[4] = tail.y;
  out.right[5] = tail.z;
  out.parent_force = force;
  out.parent_moment = negative(bend_moment);
  if constexpr (extended)
    if (pack.windy)
      add_drag(rows, pack, row, lane, middle_of(s.own, l), set(-0.5) * l * axis, d, out.right);
  return out;
}

// ---- Elimination --------------------------------------------------------------------------------

// A block and its right side on its way to the root.
struct Carry {
  V diagonal[triangle6];
  V right[6];
};

HWY_INLINE void clear(Carry& carry) {
  for (V& x : carry.diagonal) x = set(0.0);
  for (V& x : carry.right) x = set(0.0);
}

// Branches that start here, springs and contacts.
HWY_NOINLINE void add_sources(const BlockSource* sources, int first, int lane, Carry& block) {
  alignas(64) double values[block_size][width];
  for (int i = 0; i < triangle6; ++i) store(block.diagonal[i], values[i]);
  for (int i = 0; i < 6; ++i) store(block.right[i], values[triangle6 + i]);
  for (int s = first; s >= 0; s = sources[s].next) {
    const BlockSource& source = sources[s];
    const int place = source.lane - lane;
    if (place < 0 || place >= width) continue;
    for (int i = 0; i < block_size; ++i) values[i][place] += source.values[i * source.stride];
  }
  for (int i = 0; i < triangle6; ++i) block.diagonal[i] = load(values[i]);
  for (int i = 0; i < 6; ++i) block.right[i] = load(values[triangle6 + i]);
}

constexpr int at(int i, int j) {  // in a lower triangle by rows
  return i * (i + 1) / 2 + j;
}

// In place; the inverses of the diagonal stand on it. Returns the smallest pivot.
HWY_INLINE V cholesky(V* a) {
  V smallest = set(1.0);
#pragma GCC unroll 6
  for (int j = 0; j < 6; ++j) {
    V pivot = a[at(j, j)];
#pragma GCC unroll 6
    for (int k = 0; k < j; ++k) pivot = hn::NegMulAdd(a[at(j, k)], a[at(j, k)], pivot);
    // Written so that a NaN counts as a bad pivot.
    smallest = hn::IfThenElse(pivot > set(0.0), smallest, set(0.0));
    const V inverse = set(1.0) / hn::Sqrt(pivot);
    a[at(j, j)] = inverse;
#pragma GCC unroll 6
    for (int i = j + 1; i < 6; ++i) {
      V x = a[at(i, j)];
#pragma GCC unroll 6
      for (int k = 0; k < j; ++k) x = hn::NegMulAdd(a[at(i, k)], a[at(j, k)], x);
      a[at(i, j)] = x * inverse;
    }
  }
  return smallest;
}

// x <- L^-1 x, where the first `skip` entries are zero.
template <int skip>
HWY_INLINE void forward(const V* l, V* x) {
#pragma GCC unroll 6
  for (int i = skip; i < 6; ++i) {
    V sum = x[i];
#pragma GCC unroll 6
    for (int k = skip; k < i; ++k) sum = hn::NegMulAdd(l[at(i, k)], x[k], sum);
    x[i] = sum * l[at(i, i)];
  }
}

// What the parent gets: its own share of the element's energies less W^T W, W^T y.
HWY_INLINE void carry_to_parent(const Blocks& b, const V (&w)[6][6], const V* y, Carry& carry) {
  const S3 &stretch = b.coupling_stretch, &bend = b.coupling_bend;
  V* d = carry.diagonal;
  d[0] = hn::Neg(stretch.xx);
  d[1] = hn::Neg(stretch.yx);
  d[2] = hn::Neg(stretch.yy);
  d[3] = hn::Neg(stretch.zx);
  d[4] = hn::Neg(stretch.zy);
  d[5] = hn::Neg(stretch.zz);
  for (const int i : {6, 7, 8, 10, 11, 12, 15, 16, 17}) d[i] = set(0.0);
  d[9] = hn::Neg(bend.xx);
  d[13] = hn::Neg(bend.yx);
  d[14] = hn::Neg(bend.yy);
  d[18] = hn::Neg(bend.zx);
  d[19] = hn::Neg(bend.zy);
  d[20] = hn::Neg(bend.zz);
  V* g = carry.right;
  g[0] = b.parent_force.x;
  g[1] = b.parent_force.y;
  g[2] = b.parent_force.z;
  g[3] = b.parent_moment.x;
  g[4] = b.parent_moment.y;
  g[5] = b.parent_moment.z;
#pragma GCC unroll 6
  for (int j = 0; j < 6; ++j) {  // w[j] is column j
    const int first = j < 3 ? 0 : 3;
#pragma GCC unroll 6
    for (int i = j; i < 6; ++i) {
      const int start = i < 3 ? first : 3;
#pragma GCC unroll 6
      for (int k = start; k < 6; ++k) d[at(i, j)] = hn::NegMulAdd(w[i][k], w[j][k], d[at(i, j)]);
    }
#pragma GCC unroll 6
    for (int k = first; k < 6; ++k) g[j] = hn::NegMulAdd(w[j][k], y[k], g[j]);
  }
}

HWY_INLINE V eliminate(const Blocks& b, FactorRow& out, int lane, Carry& carry) {
  V* l = carry.diagonal;  // so far: what the tips gave
  V* y = carry.right;
  const V smallest = cholesky(l);
  V w[6][6];
  const V3(&lever)[3] = b.coupling_lever;
  const S3 &s = b.coupling_stretch, &t = b.coupling_bend;
  const V zero = set(0.0);
  const V columns[6][6] = {{s.xx, s.yx, s.zx, lever[0].x, lever[1].x, lever[2].x},
                           {s.yx, s.yy, s.zy, lever[0].y, lever[1].y, lever[2].y},
                           {s.zx, s.zy, s.zz, lever[0].z, lever[1].z, lever[2].z},
                           {zero, zero, zero, t.xx, t.yx, t.zx},
                           {zero, zero, zero, t.yx, t.yy, t.zy},
                           {zero, zero, zero, t.zx, t.zy, t.zz}};
#pragma GCC unroll 6
  for (int j = 0; j < 6; ++j)
#pragma GCC unroll 6
    for (int i = 0; i < 6; ++i) w[j][i] = columns[j][i];
#pragma GCC unroll 3
  for (int j = 0; j < 3; ++j) forward<0>(l, w[j]);
#pragma GCC unroll 3
  for (int j = 3; j < 6; ++j) forward<3>(l, w[j]);
  forward<0>(l, y);
#pragma GCC unroll 21
  for (int i = 0; i < triangle6; ++i) store(l[i], out.diagonal[i] + lane);
  V kept[6];
#pragma GCC unroll 6
  for (int i = 0; i < 6; ++i) {
    kept[i] = y[i];
    store(y[i], out.right[i] + lane);
  }
  int place = 0;
#pragma GCC unroll 6
  for (int j = 0; j < 6; ++j)
#pragma GCC unroll 6
    for (int i = j < 3 ? 0 : 3; i < 6; ++i) store(w[j][i], out.coupling[place++] + lane);
  carry_to_parent(b, w, kept, carry);
  return smallest;
}

HWY_INLINE void add(const Blocks& blocks, Carry& carry) {
#pragma GCC unroll 21
  for (int i = 0; i < triangle6; ++i) carry.diagonal[i] = carry.diagonal[i] + blocks.diagonal[i];
#pragma GCC unroll 6
  for (int i = 0; i < 6; ++i) carry.right[i] = carry.right[i] + blocks.right[i];
}

template <bool extended>
void eliminate_pack(const RowArrays& rows, Pack& pack) {
  for (int lane = 0; lane < lane_count; lane += width) {
    Carry carry;
    clear(carry);
    V energy = set(0.0), healthy = set(1.0);
    for (int row = pack.end - 1; row > pack.begin; --row) {
      if constexpr (extended)
        if (pack.windy) set_axis(rows, row, lane, rows.axis_share);
      const Strained s =
          strain<extended>(rows, pack, row, lane, load_pose(rows.iterate[row - 1], lane),
                           load_pose(rows.iterate[row], lane));
      energy = energy + s.energy;
      const Blocks blocks = blocks_of<extended>(rows, pack, row, lane, s);
      add(blocks, carry);
      if (rows.first_branch[row] >= 0)
        add_sources(rows.branches, rows.first_branch[row], lane, carry);
      if (rows.first_extra[row] >= 0) add_sources(rows.extras, rows.first_extra[row], lane, carry);
      healthy = hn::Min(healthy, eliminate(blocks, rows.factor[row], lane, carry));
    }
    store(energy, pack.energy + lane);
    store(healthy, pack.healthy + lane);
    for (int i = 0; i < triangle6; ++i) store(carry.diagonal[i], pack.branch[i] + lane);
    for (int i = 0; i < 6; ++i) store(carry.right[i], pack.branch[triangle6 + i] + lane);
  }
}

template <bool extended>
void linearise_pack(const RowArrays& rows, Pack& pack) {
  for (int lane = 0; lane < lane_count; lane += width) {
    V energy = set(0.0);
    for (int row = pack.end - 1; row > pack.begin; --row) {
      if constexpr (extended)
        if (pack.windy) set_axis(rows, row, lane, rows.axis_share);
      const Strained s =
          strain<extended>(rows, pack, row, lane, load_pose(rows.iterate[row - 1], lane),
                           load_pose(rows.iterate[row], lane));
      energy = energy + s.energy;
      const Blocks b = blocks_of<extended>(rows, pack, row, lane, s);
      FactorRow& out = rows.factor[row];
      for (int i = 0; i < triangle6; ++i) store(b.diagonal[i], out.diagonal[i] + lane);
      // Lanes without an element must not seem to move.
      const V alive = load(rows.element[row].alive + lane);
      for (int i = 0; i < 6; ++i) store(alive * b.right[i], out.right[i] + lane);
      const S3 &s3 = b.coupling_stretch, &t3 = b.coupling_bend;
      const V values[27] = {s3.xx,
                            s3.yx,
                            s3.yy,
                            s3.zx,
                            s3.zy,
                            s3.zz,
                            b.coupling_lever[0].x,
                            b.coupling_lever[0].y,
                            b.coupling_lever[0].z,
                            b.coupling_lever[1].x,
                            b.coupling_lever[1].y,
                            b.coupling_lever[1].z,
                            b.coupling_lever[2].x,
                            b.coupling_lever[2].y,
                            b.coupling_lever[2].z,
                            t3.xx,
                            t3.yx,
                            t3.yy,
                            t3.zx,
                            t3.zy,
                            t3.zz,
                            b.parent_force.x,
                            b.parent_force.y,
                            b.parent_force.z,
                            b.parent_moment.x,
                            b.parent_moment.y,
                            b.parent_moment.z};
      for (int i = 0; i < 27; ++i) store(values[i], out.coupling[i] + lane);
    }
    store(energy, pack.energy + lane);
  }
}

void LineariseAndEliminate(const RowArrays& rows, Pack& pack) {
  pack.extended ? eliminate_pack<true>(rows, pack) : eliminate_pack<false>(rows, pack);
}

void Linearise(const RowArrays& rows, Pack& pack) {
  pack.extended ? linearise_pack<true>(rows, pack) : linearise_pack<false>(rows, pack);
}

// ---- Solution -----------------------------------------------------------------------------------

struct Largest {
  V turn2, shift2, change;
};

HWY_INLINE void measure(const V* d, V length, Largest& largest) {
  const V3 head{d[0], d[1], d[2]}, tail{d[3], d[4], d[5]};
  largest.turn2 = hn::Max(largest.turn2, dot(tail, tail));
  largest.shift2 = hn::Max(largest.shift2, dot(head, head) / (length * length));
#pragma GCC unroll 6
  for (int i = 0; i < 6; ++i) largest.change = hn::Max(largest.change, hn::Abs(d[i]));
}

HWY_INLINE void report(const Largest& largest, Pack& pack, int lane) {
  store(hn::Sqrt(largest.turn2), pack.turn + lane);
  store(hn::Sqrt(largest.shift2), pack.shift + lane);
  store(largest.change, pack.change + lane);
}

HWY_INLINE void load_change(const FactorRow& row, int lane, V* d) {
#pragma GCC unroll 6
  for (int i = 0; i < 6; ++i) d[i] = load(row.right[i] + lane);
}

void Substitute(const RowArrays& rows, Pack& pack) {
  for (int lane = 0; lane < lane_count; lane += width) {
    Largest largest{set(0.0), set(0.0), set(0.0)};
    V parent[6];
    load_change(rows.factor[pack.begin], lane, parent);
    for (int row = pack.begin + 1; row < pack.end; ++row) {
      FactorRow& factor = rows.factor[row];
      V x[6];
      load_change(factor, lane, x);
      int place = 0;
#pragma GCC unroll 6
      for (int j = 0; j < 6; ++j)
#pragma GCC unroll 6
        for (int i = j < 3 ? 0 : 3; i < 6; ++i)
          x[i] = hn::NegMulAdd(load(factor.coupling[place++] + lane), parent[j], x[i]);
#pragma GCC unroll 6
      for (int i = 5; i >= 0; --i) {
#pragma GCC unroll 6
        for (int k = i + 1; k < 6; ++k)
          x[i] = hn::NegMulAdd(load(factor.diagonal[at(k, i)] + lane), x[k], x[i]);
        x[i] = x[i] * load(factor.diagonal[at(i, i)] + lane);
      }
      const V alive = load(rows.element[row].alive + lane);
#pragma GCC unroll 6
      for (int i = 0; i < 6; ++i) {
        parent[i] = alive * x[i];
        store(parent[i], factor.right[i] + lane);
      }
      measure(parent, load(rows.element[row].length + lane), largest);
    }
    report(largest, pack, lane);
  }
}

void MeasureChange(const RowArrays& rows, Pack& pack) {
  for (int lane = 0; lane < lane_count; lane += width) {
    Largest largest{set(0.0), set(0.0), set(0.0)};
    for (int row = pack.begin + 1; row < pack.end; ++row) {
      V d[6];
      load_change(rows.factor[row], lane, d);
      measure(d, load(rows.element[row].length + lane), largest);
    }
    report(largest, pack, lane);
  }
}

template <bool extended>
void move_pack(const RowArrays& rows, Pack& pack, bool keep) {
  for (int lane = 0; lane < lane_count; lane += width) {
    const V share = load(pack.share + lane);
    const M moves = share > set(0.0);
    V energy = set(0.0);
    Pose parent = load_pose(rows.iterate[pack.begin], lane);
    for (int row = pack.begin + 1; row < pack.end; ++row) {
      FactorRow& factor = rows.factor[row];
      PoseRow& kept = factor.base;
      const Pose base = load_pose(keep ? rows.iterate[row] : kept, lane);
      if (keep) store_pose(base, kept, lane);
      V d[6];
      load_change(factor, lane, d);
      Pose moved;
      moved.position =
          select(moves, add_scaled(base.position, share, V3{d[0], d[1], d[2]}), base.position);
      const Q turned = normalized(exp_map(share * V3{d[3], d[4], d[5]}) * base.orientation);
      moved.orientation = select(moves, turned, base.orientation);
      store_pose(moved, rows.iterate[row], lane);
      energy = energy + strain<extended>(rows, pack, row, lane, parent, moved).energy;
      parent = moved;
    }
    store(energy, pack.energy + lane);
  }
}

void Move(const RowArrays& rows, Pack& pack, bool keep) {
  pack.extended ? move_pack<true>(rows, pack, keep) : move_pack<false>(rows, pack, keep);
}

void Finish(const RowArrays& rows, const Pack& pack, RateRow* end) {
  for (int lane = 0; lane < lane_count; lane += width) {
    const V inverse_step = set(1.0) / load(pack.effective_step + lane);
    for (int row = pack.begin + 1; row < pack.end; ++row) {
      const TermRow& term = rows.term[row];
      const Pose pose = load_pose(rows.iterate[row], lane);
      const V3 com = centre_of_mass(pose, load(rows.element[row].com_back + lane));
      store3(inverse_step * (com - load3(term.com_past, lane)), end[row].velocity, lane);
      const Q turn = conjugate(load4(term.rotation_past, lane)) * pose.orientation;
      store3(inverse_step * log_map(turn).phi, end[row].angular_velocity, lane);
      if (pack.branches > 0)
        finish_joint(
            rows, pack, row, lane,
            bend_of(rows.element[row], lane, load_pose(rows.iterate[row - 1], lane), pose).phi);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace pedicel::cosserat
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pedicel::cosserat {

HWY_EXPORT(Prepare);
HWY_EXPORT(LineariseAndEliminate);
HWY_EXPORT(Linearise);
HWY_EXPORT(Substitute);
HWY_EXPORT(MeasureChange);
HWY_EXPORT(Move);
HWY_EXPORT(Finish);

void prepare(const RowArrays& rows, Pack& pack) {
  HWY_DYNAMIC_DISPATCH(Prepare)(rows, pack);
}
void linearise_and_eliminate(const RowArrays& rows, Pack& pack) {
  HWY_DYNAMIC_DISPATCH(LineariseAndEliminate)(rows, pack);
}
void linearise(const RowArrays& rows, Pack& pack) {
  HWY_DYNAMIC_DISPATCH(Linearise)(rows, pack);
}
void substitute(const RowArrays& rows, Pack& pack) {
  HWY_DYNAMIC_DISPATCH(Substitute)(rows, pack);
}
void measure_change(const RowArrays& rows, Pack& pack) {
  HWY_DYNAMIC_DISPATCH(MeasureChange)(rows, pack);
}
void move(const RowArrays& rows, Pack& pack, bool keep) {
  HWY_DYNAMIC_DISPATCH(Move)(rows, pack, keep);
}
void finish(const RowArrays& rows, const Pack& pack, RateRow* end) {
  HWY_DYNAMIC_DISPATCH(Finish)(rows, pack, end);
}

std::vector<std::string> available_instruction_sets() {
  std::vector<std::string> names;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
    names.emplace_back(hwy::TargetName(target));
  return names;
}

void use_instruction_set(const std::string& name) {
  std::int64_t wanted = 0;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
    if (name == hwy::TargetName(target)) wanted = target;
  hwy::SetSupportedTargetsForTest(wanted);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace pedicel::cosserat
#endif
