// Joint laws and drag of lanes (joint_law.h, SegmentAir). Included once an instruction set by
// lane_kernels.cpp, which is why it has no ordinary guard.
#if defined(PEDICEL_COSSERAT_LANE_EXTENSIONS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEDICEL_COSSERAT_LANE_EXTENSIONS_INL_H
#undef PEDICEL_COSSERAT_LANE_EXTENSIONS_INL_H
#else
#define PEDICEL_COSSERAT_LANE_EXTENSIONS_INL_H
#endif

#include <limits>

#include "pedicel/cosserat/lanes/lane_math-inl.h"
#include "pedicel/effects/internal_friction-inl.h"
#include "pedicel/effects_list/joint_terms-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pedicel::cosserat {
namespace HWY_NAMESPACE {

namespace formula = effects::HWY_NAMESPACE;

/// What bends a joint: conjugate moment, energy, and the Hessian's bending part, positive definite.
struct Bending {
  V3 moment;   // N m
  V linear;    // J, twice the energy of what is linear in phi
  V energy;    // J, of the rest
  V3 hessian;  // N m/rad, diagonal
  V mixed;     // N m/rad, between the two bending axes
};

/// The stiffness of eight joints now.
struct JointStiffness {
  V3 k;      // N m/rad
  V softer;  // N m/rad, of the two bending ones
};

HWY_INLINE JointStiffness joint_stiffness(const ElementRow& element, const Pack& pack, int lane) {
  const V3 k = load(pack.modulus + lane) * load3(element.bend_stiffness, lane);
  return {k, hn::Max(hn::Min(k.x, k.y), set(1.0e-300))};
}

/// The slider share of a branch, zero where it has none, and the sqrt(u) at which it slips.
HWY_INLINE V slider_share(const BranchRow& branch, int lane) {
  const M has = load(branch.limit + lane) < set(std::numeric_limits<double>::infinity());
  return hn::IfThenElse(has, load(branch.share + lane), set(0.0));
}
HWY_INLINE V slider_reach(const BranchRow& branch, V share, V softer, int lane) {
  return load(branch.limit + lane) / (share * softer + set(1.0e-300));
}

/// Everything about a joint bent by phi: what is linear, which ViscousRow and ExtensionTermRow hold
/// as stiffness and target, then terms and sliders. The tangent is taken where it is positive
/// definite, else the secant stiffness, a majoriser of what softens or slips.
HWY_INLINE Bending bend_joint(const RowArrays& rows, const Pack& pack, int row, int lane,
                              const V3& phi) {
  const ExtensionRow& extension = rows.extension[row];
  const V3 linear = load3(rows.extension_term[row].bend_stiffness, lane);
  const V3 off = phi - load3(rows.viscous[row].bend_target, lane);
  const V zero = set(0.0);
  Bending out{times(linear, off), zero, zero, {zero, zero, linear.z}, zero};
  out.linear = dot(off, out.moment);
  const JointStiffness stiffness = joint_stiffness(rows.element[row], pack, lane);
  const formula::BentJoint<V> joint{
      stiffness.k.x, stiffness.k.y, stiffness.softer, load(extension.elastic + lane), phi.x, phi.y};
  formula::BendTerms<V> terms{out.moment.x, out.moment.y, zero, linear.x,
                              linear.y,     zero,         zero, zero};
  if (pack.terms) {
    V numbers[effects::joint_term_numbers];
    for (int i = 0; i < effects::joint_term_numbers; ++i)
      numbers[i] = load(rows.joint_term[row].number[i] + lane);
    formula::add_joint_terms(pack.terms, numbers, joint, terms);
  }
  for (int j = 0; j < pack.sliders; ++j) {
    const BranchRow& branch = rows.law_branch[row * rows.law_branches + j];
    const V3 y = phi - load3(branch.value, lane);
    const V share = slider_share(branch, lane);
    const V reach = slider_reach(branch, share, stiffness.softer, lane);
    add_radial(joint, share, y.x, y.y, formula::slip(reach, bend_measure(joint, y.x, y.y)), terms);
  }
  out.moment.x = terms.moment1;
  out.moment.y = terms.moment2;
  out.energy = terms.energy;
  const V least = set(1.0e-4);
  const V secant_x = hn::Max(terms.secant1, least * stiffness.k.x);
  const V secant_y = hn::Max(terms.secant2, least * stiffness.k.y);
  const V xx = secant_x + terms.tangent11, yy = secant_y + terms.tangent22;
  const V determinant = xx * yy - terms.tangent12 * terms.tangent12;
  const M tangent = hn::And(xx > zero, determinant > least * secant_x * secant_y);
  out.hessian.x = hn::IfThenElse(tangent, xx, secant_x);
  out.hessian.y = hn::IfThenElse(tangent, yy, secant_y);
  out.mixed = hn::IfThenElse(tangent, terms.tangent12, zero);
  return out;
}

/// The step's linear terms of a joint whose bend at the start is `now`: elastic spring,
/// Kelvin-Voigt and branches with a dashpot fold into one stiffness and one target.
HWY_INLINE void prepare_joint(const RowArrays& rows, const Pack& pack, int row, int lane,
                              const V3& now) {
  const ExtensionRow& extension = rows.extension[row];
  ViscousRow& viscous = rows.viscous[row];
  ExtensionTermRow& out = rows.extension_term[row];
  const V stiffening = load(viscous.stiffening + lane), zero = set(0.0);
  const V3 target = load3(viscous.bend_target, lane);
  V3 offset = stiffening * target - load3(out.bias, lane);
  V weights = zero;
  for (int j = 0; j < pack.branches; ++j) {
    const BranchRow& branch = rows.law_branch[row * rows.law_branches + j];
    const V share = load(branch.share + lane) - slider_share(branch, lane);
    const V decay = load(branch.decay + lane), factor = load(branch.factor + lane);
    weights = hn::MulAdd(share, factor, weights);
    const V3 past = add_scaled(decay * load3(branch.value, lane), factor - decay, now);
    offset = add_scaled(offset, share, past);
  }
  const V bend = stiffening + (load(extension.bend_excess + lane) + weights);
  const V twist = stiffening + (load(extension.twist_excess + lane) + weights);
  const V3 k = load3(rows.element[row].bend_stiffness, lane);
  const V modulus = load(pack.modulus + lane);
  store3(modulus * V3{bend * k.x, bend * k.y, twist * k.z}, out.bend_stiffness, lane);
  const M lawful = load(extension.lawful + lane) > zero;
  const V tiny = set(1.0e-12);
  const V by_bend = hn::IfThenElse(bend > tiny, set(1.0) / hn::Max(bend, tiny), zero);
  const V by_twist = hn::IfThenElse(twist > tiny, set(1.0) / hn::Max(twist, tiny), zero);
  const V3 mean{by_bend * offset.x, by_bend * offset.y, by_twist * offset.z};
  store3(select(lawful, mean, target), viscous.bend_target, lane);
}

/// What dashpots and sliders have given way by at the end of the step.
HWY_INLINE void finish_joint(const RowArrays& rows, const Pack& pack, int row, int lane,
                             const V3& phi) {
  const JointStiffness stiffness = joint_stiffness(rows.element[row], pack, lane);
  const formula::BentJoint<V> joint{stiffness.k.x, stiffness.k.y, stiffness.softer,
                                    set(1.0),      phi.x,         phi.y};
  const V3 now = load3(rows.strain[row].bend, lane);
  for (int j = 0; j < pack.branches; ++j) {
    BranchRow& branch = rows.law_branch[row * rows.law_branches + j];
    const V3 value = load3(branch.value, lane);
    const V decay = load(branch.decay + lane), factor = load(branch.factor + lane);
    const V3 past = add_scaled(decay * value, factor - decay, now);
    const V3 relaxed = add_scaled(past, set(1.0) - factor, phi);
    const V share = slider_share(branch, lane);
    const V3 y = phi - value;
    const V reach = slider_reach(branch, share, stiffness.softer, lane);
    const V give = set(1.0) - formula::slip(reach, bend_measure(joint, y.x, y.y)).g;
    const V3 slid{hn::MulAdd(give, y.x, value.x), hn::MulAdd(give, y.y, value.y), value.z};
    store3(select(share > set(0.0), slid, relaxed), branch.value, lane);
  }
}

// ---- Drag ---------------------------------------------------------------------------------------

/// Linearised, the drag turns with the segment: its axis goes to that of the iterate by `share`.
HWY_INLINE void set_axis(const RowArrays& rows, int row, int lane, double share) {
  Lanes* const axis = rows.extension_term[row].axis;
  V3 now = axis3(load4(rows.iterate[row].orientation, lane));
  if (share < 1.0) {
    const V3 before = load3(axis, lane);
    now = add_scaled(before, set(share), now - before);
    now = (set(1.0) / hn::Sqrt(dot(now, now))) * now;
  }
  store3(now, axis, lane);
}

/// The drag of eight segments as a dissipation potential h~ c/3 |u|^3 of the place m of their
/// middles: u = P (air - (m - m*)/h~), P taking out what is along the axis.
struct Drag {
  V3 u;      // m/s
  V speed;   // m/s
  V c;       // N/(m/s)2
  V energy;  // J
};

HWY_INLINE Drag drag_of(const RowArrays& rows, const Pack& pack, int row, int lane,
                        const V3& middle) {
  const ExtensionTermRow& term = rows.extension_term[row];
  const V h = load(pack.effective_step + lane);
  const V3 velocity = (set(1.0) / h) * (middle - load3(term.middle_past, lane));
  const V3 relative = load3(term.air, lane) - velocity, axis = load3(term.axis, lane);
  const V3 u = less_scaled(relative, dot(relative, axis), axis);
  const V speed = hn::Sqrt(dot(u, u));
  const V c = load(rows.extension[row].drag + lane);
  return {u, speed, c, h * c * speed * speed * speed * set(1.0 / 3.0)};
}

/// c |u| u and its derivative, (c/h~) (|u| P + u u^T/|u|), as blocks of (position, rotation) with
/// the middle at `arm` from the node.
HWY_INLINE void add_drag(const RowArrays& rows, const Pack& pack, int row, int lane,
                         const V3& middle, const V3& arm, V* d, V* right) {
  const Drag drag = drag_of(rows, pack, row, lane, middle);
  const V3 axis = load3(rows.extension_term[row].axis, lane);
  const V h = load(pack.effective_step + lane);
  const V w = drag.c / h, by_speed = w * drag.speed;
  const V per_speed = w / hn::Max(drag.speed, set(1.0e-100));
  const V3 &u = drag.u, &n = axis;
  const auto entry = [&](V a, V b, V na, V nb) { return per_speed * a * b - by_speed * na * nb; };
  const V xx = by_speed + entry(u.x, u.x, n.x, n.x), yy = by_speed + entry(u.y, u.y, n.y, n.y);
  const V zz = by_speed + entry(u.z, u.z, n.z, n.z), yx = entry(u.y, u.x, n.y, n.x);
  const V zx = entry(u.z, u.x, n.z, n.x), zy = entry(u.z, u.y, n.z, n.y);
  d[0] = d[0] + xx;
  d[1] = d[1] + yx;
  d[2] = d[2] + yy;
  d[3] = d[3] + zx;
  d[4] = d[4] + zy;
  d[5] = d[5] + zz;
  // Lower left: [arm]x H, whose columns are arm x (columns of H).
  const V3 a = cross(arm, {xx, yx, zx}), b = cross(arm, {yx, yy, zy}), c = cross(arm, {zx, zy, zz});
  d[6] = d[6] + a.x;
  d[7] = d[7] + b.x;
  d[8] = d[8] + c.x;
  d[10] = d[10] + a.y;
  d[11] = d[11] + b.y;
  d[12] = d[12] + c.y;
  d[15] = d[15] + a.z;
  d[16] = d[16] + b.z;
  d[17] = d[17] + c.z;
  // Lower right: [arm]x H [arm]x^T, whose rows are arm x (rows of the lower left).
  const V3 x = cross(arm, {a.x, b.x, c.x}), y = cross(arm, {a.y, b.y, c.y}),
           z = cross(arm, {a.z, b.z, c.z});
  d[9] = d[9] + x.x;
  d[13] = d[13] + y.x;
  d[14] = d[14] + y.y;
  d[18] = d[18] + z.x;
  d[19] = d[19] + z.y;
  d[20] = d[20] + z.z;
  const V3 force = (drag.c * drag.speed) * u, moment = cross(arm, force);
  right[0] = right[0] + force.x;
  right[1] = right[1] + force.y;
  right[2] = right[2] + force.z;
  right[3] = right[3] + moment.x;
  right[4] = right[4] + moment.y;
  right[5] = right[5] + moment.z;
}

}  // namespace HWY_NAMESPACE
}  // namespace pedicel::cosserat
HWY_AFTER_NAMESPACE();

#endif
