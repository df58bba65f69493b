// Strains, energy, gradient and Hessian of eight elements (the README's equations). Included once
// an instruction set by lane_kernels.cpp, which is why it has no ordinary guard.
#if defined(PEDICEL_COSSERAT_LANE_ELEMENT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEDICEL_COSSERAT_LANE_ELEMENT_INL_H
#undef PEDICEL_COSSERAT_LANE_ELEMENT_INL_H
#else
#define PEDICEL_COSSERAT_LANE_ELEMENT_INL_H
#endif

#include "plugins/cosserat/lanes/lane_extensions-inl.h"
#include "plugins/cosserat/lanes/lane_math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pedicel::cosserat {
namespace HWY_NAMESPACE {

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
  return less_scaled(pose.position, com_back, axis3(pose.orientation));
}

HWY_INLINE V3 middle_of(const Pose& pose, V length) {
  return add_scaled(pose.position, set(-0.5) * length, axis3(pose.orientation));
}

// Position of the child node from the parent's, per length; in W.
HWY_INLINE V3 span_of(const Pose& parent, const Pose& own, V length) {
  return (set(1.0) / length) * (own.position - parent.position);
}

HWY_INLINE V3 stretch_of(const ElementRow& element, int lane, const M3& r, const V3& span) {
  const V3 in_frame = into(r, span);
  return V3{in_frame.x, in_frame.y, in_frame.z - set(1.0)} - load3(element.rest_strain, lane);
}

HWY_INLINE Log bend_of(const ElementRow& element, int lane, const Pose& parent, const Pose& own) {
  return log_map(times_conjugate(load4(element.rest_rotation, lane),
                                 times_conjugate(parent.orientation, own.orientation)));
}

// What gradient, Hessian and energy share.
struct Strained {
  Pose own;
  M3 r;
  V3 span;  // 1, W: from the parent to the node, per length
  V length;
  V3 force_E;      // N, with damping
  V3 stretch_k;    // N, with damping
  Log bend;        // from rest
  V3 bend_moment;  // N m, conjugate to bend.phi, with damping
  V3 bend_k;       // N m/rad, with damping
  V bend_k_mixed;  // N m/rad, between the bending axes (extended)
  V3 off;          // m, W: centre of mass from its target
  Q turn;          // from the target's rotation, w >= 0
  V3 turn_k;       // N m/rad, E
  V inertia_k;     // N/m
  V energy;        // J
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
  s.span = span_of(parent, own, s.length);
  V3 stretch = stretch_of(element, lane, s.r, s.span);
  s.stretch_k = load3(element.stretch_stiffness, lane);
  if (extended || pack.viscous) {
    const ViscousRow& viscous = rows.viscous[row];
    stretch = stretch - load3(viscous.stretch_target, lane);
    s.stretch_k = load(viscous.stiffening + lane) * s.stretch_k;
  }
  if constexpr (extended) s.stretch_k = load(pack.modulus + lane) * s.stretch_k;
  s.force_E = times(s.stretch_k, stretch);
  s.bend = bend_of(element, lane, parent, own);

  const V scale = load(term.inertia_scale + lane), mass = load(element.mass + lane);
  const V3 com = less_scaled(own.position, load(element.com_back + lane), s.r.c);
  s.inertia_k = mass * scale;
  s.off = com - load3(term.com_target, lane);
  const Q turn = times_conjugate(load4(term.rotation_target, lane), own.orientation);
  const V sign = hn::CopySign(set(1.0), turn.w);
  s.turn = {sign * turn.x, sign * turn.y, sign * turn.z, sign * turn.w};
  s.turn_k = scale * load3(element.inertia, lane);
  const V3 vec{s.turn.x, s.turn.y, s.turn.z};
  const V3 g{set(rows.gravity[0]), set(rows.gravity[1]), set(rows.gravity[2])};
  const V half = set(0.5);
  // 1/2 l strain.K strain + 1/2 phi.K phi + 1/2 m/h~^2 |off|^2 + 1/2 (2 vec).I/h~^2 (2 vec) - m
  // g.off
  V energy = half * s.length * dot(stretch, s.force_E);
  if constexpr (extended) {
    const Bending bending = bend_joint(rows, pack, row, lane, s.bend.phi);
    s.bend_moment = bending.moment;
    s.bend_k = bending.hessian;
    s.bend_k_mixed = bending.mixed;
    energy = hn::MulAdd(half, bending.linear, energy) + bending.energy;
    if (pack.windy) energy = energy + drag_energy(rows, pack, row, lane, middle_of(own, s.length));
  } else {
    V3 off = s.bend.phi;
    s.bend_k = load3(element.bend_stiffness, lane);
    if (pack.viscous) {
      const ViscousRow& viscous = rows.viscous[row];
      off = off - load3(viscous.bend_target, lane);
      s.bend_k = load(viscous.stiffening + lane) * s.bend_k;
    }
    s.bend_moment = times(s.bend_k, off);
    energy = hn::MulAdd(half, dot(off, s.bend_moment), energy);
  }
  energy = hn::MulAdd(half * s.inertia_k, dot(s.off, s.off), energy);
  energy = hn::MulAdd(set(2.0), dot(vec, times(s.turn_k, vec)), energy);
  energy = hn::NegMulAdd(mass, dot(g, s.off), energy);
  s.energy = load(element.alive + lane) * energy;
  return s;
}

// A block on the diagonal, its lower triangle by rows, and its right side.
struct Block {
  V diagonal[triangle6];
  V right[6];
};

// The blocks of one element. The coupling's rows are the element's, its columns the parent's; it is
// minus what stands here, and its upper right quarter is zero.
struct Blocks {
  Block own;
  S3 stretch;        // upper left
  V3 lever[3];       // lower left, by rows
  S3 bend;           // lower right
  V3 force, moment;  // on the parent
};

template <bool extended>
HWY_INLINE Blocks blocks_of(const RowArrays& rows, const Pack& pack, int row, int lane,
                            const Strained& s) {
  const ElementRow& element = rows.element[row];
  Blocks out;
  const V3 &a = s.span, &axis = s.r.c;
  const V l = s.length, inverse_length = set(1.0) / l;
  // R diag(k) R^T = k1 1 + (k2 - k1) b b^T + (k3 - k1) c c^T with R's columns b, c.
  const S3 bb = square(s.r.b), cc = square(axis);
  const V3& k123 = s.stretch_k;
  const V k21 = k123.y - k123.x, k31 = k123.z - k123.x;
  const S3 k = {hn::MulAdd(k31, cc.xx, hn::MulAdd(k21, bb.xx, k123.x)),
                hn::MulAdd(k31, cc.yx, k21 * bb.yx),
                hn::MulAdd(k31, cc.yy, hn::MulAdd(k21, bb.yy, k123.x)),
                hn::MulAdd(k31, cc.zx, k21 * bb.zx),
                hn::MulAdd(k31, cc.zy, k21 * bb.zy),
                hn::MulAdd(k31, cc.zz, hn::MulAdd(k21, bb.zz, k123.x))};
  out.force = s.r * s.force_E;
  out.stretch = {inverse_length * k.xx, inverse_length * k.yx, inverse_length * k.yy,
                 inverse_length * k.zx, inverse_length * k.zy, inverse_length * k.zz};
  // Columns of k [a]x, the change of force with rotation.
  const V3 k0{k.xx, k.yx, k.zx}, k1{k.yx, k.yy, k.zy}, k2{k.zx, k.zy, k.zz};
  out.lever[0] = a.z * k1 - a.y * k2;
  out.lever[1] = a.x * k2 - a.z * k0;
  out.lever[2] = a.y * k0 - a.x * k1;
  const V3(&lever)[3] = out.lever;

  const M3 jacobian = inverse_jacobian_transposed(s.bend);
  const M3 bending{s.r * jacobian.a, s.r * jacobian.b, s.r * jacobian.c};
  out.bend = sandwich(bending, s.bend_k);
  if constexpr (extended) add_mixed(bending, s.bend_k_mixed, out.bend);
  out.moment = bending * s.bend_moment;

  const V w = s.inertia_k;
  const V3 arm = load(element.com_back + lane) * axis;  // from the centre of mass to the node
  const V3 w_arm = w * arm;

  V* d = out.own.diagonal;
  d[0] = w + out.stretch.xx;
  d[1] = out.stretch.yx;
  d[2] = w + out.stretch.yy;
  d[3] = out.stretch.zx;
  d[4] = out.stretch.zy;
  d[5] = w + out.stretch.zz;
  // Lower left: (k [a]x)^T - w [arm]x.
  d[6] = lever[0].x;
  d[7] = lever[0].y + w_arm.z;
  d[8] = lever[0].z - w_arm.y;
  d[10] = lever[1].x - w_arm.z;
  d[11] = lever[1].y;
  d[12] = lever[1].z + w_arm.x;
  d[15] = lever[2].x + w_arm.y;
  d[16] = lever[2].y - w_arm.x;
  d[17] = lever[2].z;
  // Lower right: l [a]x^T k [a]x + bending + tension (1 - axis axis^T) + w (arm^2 - arm arm^T)
  // + rotary inertia R diag(i) R^T, written as above.
  const V xx = a.z * lever[0].y - a.y * lever[0].z, yx = a.x * lever[0].z - a.z * lever[0].x;
  const V yy = a.x * lever[1].z - a.z * lever[1].x, zx = a.y * lever[0].x - a.x * lever[0].y;
  const V zy = a.y * lever[1].x - a.x * lever[1].y, zz = a.y * lever[2].x - a.x * lever[2].y;
  // The last three together are s 1 - (s - i3) c c^T + (i2 - i1) b b^T, because arm lies along c:
  // s = tension + w arm^2 + i1 is the stiffness against swinging the axis, i3 against spinning
  // about it.
  const V3& i = s.turn_k;
  const V tension = hn::Max(s.force_E.z, set(0.0)) * l;
  const V swing = hn::MulAdd(w, dot(arm, arm), tension + i.x);
  const V swing_minus_spin = swing - i.z, i21 = i.y - i.x;
  const auto lower_right = [&](V lever_part, V bend, V b, V c) {
    return hn::MulAdd(l, lever_part, hn::MulAdd(i21, b, hn::NegMulAdd(swing_minus_spin, c, bend)));
  };
  d[9] = lower_right(xx, out.bend.xx + swing, bb.xx, cc.xx);
  d[13] = lower_right(yx, out.bend.yx, bb.yx, cc.yx);
  d[14] = lower_right(yy, out.bend.yy + swing, bb.yy, cc.yy);
  d[18] = lower_right(zx, out.bend.zx, bb.zx, cc.zx);
  d[19] = lower_right(zy, out.bend.zy, bb.zy, cc.zy);
  d[20] = lower_right(zz, out.bend.zz + swing, bb.zz, cc.zz);

  const V mass = load(element.mass + lane);
  const V3 weight{mass * set(rows.gravity[0]), mass * set(rows.gravity[1]),
                  mass * set(rows.gravity[2])};
  const V3 pull = less_scaled(weight, w, s.off);
  // phi = 2 vec(q~^-1 q) changes by (w + [vec]x) R^T per unit of rotation.
  const V3 vec{s.turn.x, s.turn.y, s.turn.z};
  const V3 conjugate_turn = set(2.0) * times(s.turn_k, vec);
  const V3 rotary_moment = s.r * (s.turn.w * conjugate_turn - cross(vec, conjugate_turn));
  const V3 on_x = pull - out.force;
  const V3 on_r = l * cross(a, out.force) - out.moment - cross(arm, pull) - rotary_moment;
  V* g = out.own.right;
  g[0] = on_x.x;
  g[1] = on_x.y;
  g[2] = on_x.z;
  g[3] = on_r.x;
  g[4] = on_r.y;
  g[5] = on_r.z;
  if constexpr (extended)
    if (pack.windy)
      add_drag(rows, pack, row, lane, middle_of(s.own, l), set(-0.5) * l * axis, d, g);
  return out;
}

}  // namespace HWY_NAMESPACE
}  // namespace pedicel::cosserat
HWY_AFTER_NAMESPACE();

#endif
