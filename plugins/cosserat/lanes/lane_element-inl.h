// Strains, energy, gradient and Hessian of eight elements (the README's equations). Included once
// an instruction set by lane_kernels.cpp, which is why it has no ordinary guard.
#if defined(PEDICEL_COSSERAT_LANE_ELEMENT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEDICEL_COSSERAT_LANE_ELEMENT_INL_H
#undef PEDICEL_COSSERAT_LANE_ELEMENT_INL_H
#else
#define PEDICEL_COSSERAT_LANE_ELEMENT_INL_H
#endif

#include "pedicel/cosserat/lanes/lane_extensions-inl.h"
#include "pedicel/cosserat/lanes/lane_math-inl.h"

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
HWY_INLINE V3 along_of(const Pose& parent, const Pose& own, V length) {
  return (set(1.0) / length) * (own.position - parent.position);
}

HWY_INLINE V3 stretch_of(const ElementRow& element, int lane, const M3& r, const V3& along) {
  const V3 in_frame = into(r, along);
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
  V3 stretch = stretch_of(element, lane, s.r, s.along);
  s.stretch_rate = load3(element.stretch_stiffness, lane);
  if (extended || pack.viscous) {
    const ViscousRow& viscous = rows.viscous[row];
    stretch = stretch - load3(viscous.stretch_target, lane);
    s.stretch_rate = load(viscous.stiffening + lane) * s.stretch_rate;
  }
  if constexpr (extended) s.stretch_rate = load(pack.modulus + lane) * s.stretch_rate;
  s.force_E = times(s.stretch_rate, stretch);
  s.bend = bend_of(element, lane, parent, own);

  const V scale = load(term.inertia_scale + lane), mass = load(element.mass + lane);
  const V3 com = less_scaled(own.position, load(element.com_back + lane), s.r.c);
  s.inertia = mass * scale;
  s.off = com - load3(term.com_target, lane);
  const Q turn = times_conjugate(load4(term.rotation_target, lane), own.orientation);
  const V sign = hn::CopySign(set(1.0), turn.w);
  s.turn = {sign * turn.x, sign * turn.y, sign * turn.z, sign * turn.w};
  s.turn_rate = scale * load3(element.inertia, lane);
  const V3 vec{s.turn.x, s.turn.y, s.turn.z};
  const V3 g{set(rows.gravity[0]), set(rows.gravity[1]), set(rows.gravity[2])};
  const V half = set(0.5);
  // 1/2 l strain.K strain + 1/2 phi.K phi + 1/2 m/h~^2 |off|^2 + 1/2 (2 vec).I/h~^2 (2 vec) - m
  // g.off
  V energy = half * s.length * dot(stretch, s.force_E);
  if constexpr (extended) {
    const Bending bending = bend_joint(rows, pack, row, lane, s.bend.phi);
    s.bend_moment = bending.moment;
    s.bend_rate = bending.hessian;
    s.bend_mixed = bending.mixed;
    energy = hn::MulAdd(half, bending.linear, energy) + bending.energy;
    if (pack.windy) energy = energy + drag_energy(rows, pack, row, lane, middle_of(own, s.length));
  } else {
    V3 off = s.bend.phi;
    s.bend_rate = load3(element.bend_stiffness, lane);
    if (pack.viscous) {
      const ViscousRow& viscous = rows.viscous[row];
      off = off - load3(viscous.bend_target, lane);
      s.bend_rate = load(viscous.stiffening + lane) * s.bend_rate;
    }
    s.bend_moment = times(s.bend_rate, off);
    energy = hn::MulAdd(half, dot(off, s.bend_moment), energy);
  }
  energy = hn::MulAdd(half * s.inertia, dot(s.off, s.off), energy);
  energy = hn::MulAdd(set(2.0), dot(vec, times(s.turn_rate, vec)), energy);
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
  const V3 &a = s.along, &axis = s.r.c;
  const V l = s.length, inverse_length = set(1.0) / l;
  // R diag(k) R^T = k1 1 + (k2 - k1) b b^T + (k3 - k1) c c^T with R's columns b, c.
  const S3 bb = square(s.r.b), cc = square(axis);
  const V3& rate = s.stretch_rate;
  const V across = rate.y - rate.x, along = rate.z - rate.x;
  const S3 k = {hn::MulAdd(along, cc.xx, hn::MulAdd(across, bb.xx, rate.x)),
                hn::MulAdd(along, cc.yx, across * bb.yx),
                hn::MulAdd(along, cc.yy, hn::MulAdd(across, bb.yy, rate.x)),
                hn::MulAdd(along, cc.zx, across * bb.zx),
                hn::MulAdd(along, cc.zy, across * bb.zy),
                hn::MulAdd(along, cc.zz, hn::MulAdd(across, bb.zz, rate.x))};
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
  out.bend = sandwich(bending, s.bend_rate);
  if constexpr (extended) add_mixed(bending, s.bend_mixed, out.bend);
  out.moment = bending * s.bend_moment;

  const V w = s.inertia;
  const V3 arm = load(element.com_back + lane) * axis;  // from the centre of mass to the node
  const V3 warm = w * arm;

  V* d = out.own.diagonal;
  d[0] = w + out.stretch.xx;
  d[1] = out.stretch.yx;
  d[2] = w + out.stretch.yy;
  d[3] = out.stretch.zx;
  d[4] = out.stretch.zy;
  d[5] = w + out.stretch.zz;
  // Lower left: (k [a]x)^T - w [arm]x.
  d[6] = lever[0].x;
  d[7] = lever[0].y + warm.z;
  d[8] = lever[0].z - warm.y;
  d[10] = lever[1].x - warm.z;
  d[11] = lever[1].y;
  d[12] = lever[1].z + warm.x;
  d[15] = lever[2].x + warm.y;
  d[16] = lever[2].y - warm.x;
  d[17] = lever[2].z;
  // Lower right: l [a]x^T k [a]x + bending + tension (1 - axis axis^T) + w (arm^2 - arm arm^T)
  // + rotary inertia R diag(i) R^T, written as above.
  const V xx = a.z * lever[0].y - a.y * lever[0].z, yx = a.x * lever[0].z - a.z * lever[0].x;
  const V yy = a.x * lever[1].z - a.z * lever[1].x, zx = a.y * lever[0].x - a.x * lever[0].y;
  const V zy = a.y * lever[1].x - a.x * lever[1].y, zz = a.y * lever[2].x - a.x * lever[2].y;
  const V3& i = s.turn_rate;
  const V tension = hn::Max(s.force_E.z, set(0.0)) * l;
  const V round = hn::MulAdd(w, dot(arm, arm), tension + i.x);
  const V less = round - i.z, more = i.y - i.x;
  const auto lower_right = [&](V lever_part, V bend, V b, V c) {
    return hn::MulAdd(l, lever_part, hn::MulAdd(more, b, hn::NegMulAdd(less, c, bend)));
  };
  d[9] = lower_right(xx, out.bend.xx + round, bb.xx, cc.xx);
  d[13] = lower_right(yx, out.bend.yx, bb.yx, cc.yx);
  d[14] = lower_right(yy, out.bend.yy + round, bb.yy, cc.yy);
  d[18] = lower_right(zx, out.bend.zx, bb.zx, cc.zx);
  d[19] = lower_right(zy, out.bend.zy, bb.zy, cc.zy);
  d[20] = lower_right(zz, out.bend.zz + round, bb.zz, cc.zz);

  const V mass = load(element.mass + lane);
  const V3 weight{mass * set(rows.gravity[0]), mass * set(rows.gravity[1]),
                  mass * set(rows.gravity[2])};
  const V3 pull = less_scaled(weight, w, s.off);
  // phi = 2 vec(q~^-1 q) changes by (w + [vec]x) R^T per unit of rotation.
  const V3 vec{s.turn.x, s.turn.y, s.turn.z};
  const V3 conjugate_turn = set(2.0) * times(s.turn_rate, vec);
  const V3 rotary_moment = s.r * (s.turn.w * conjugate_turn - cross(vec, conjugate_turn));
  const V3 head = pull - out.force;
  const V3 tail = l * cross(a, out.force) - out.moment - cross(arm, pull) - rotary_moment;
  V* g = out.own.right;
  g[0] = head.x;
  g[1] = head.y;
  g[2] = head.z;
  g[3] = tail.x;
  g[4] = tail.y;
  g[5] = tail.z;
  if constexpr (extended)
    if (pack.windy)
      add_drag(rows, pack, row, lane, middle_of(s.own, l), set(-0.5) * l * axis, d, g);
  return out;
}

}  // namespace HWY_NAMESPACE
}  // namespace pedicel::cosserat
HWY_AFTER_NAMESPACE();

#endif
