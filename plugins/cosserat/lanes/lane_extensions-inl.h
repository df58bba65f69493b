// Joint laws and drag of lanes (joint_law.h, SegmentAir). Included once an instruction set by
// lane_kernels.cpp, which is why it has no ordinary guard.
#if defined(PEDICEL_COSSERAT_LANE_EXTENSIONS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEDICEL_COSSERAT_LANE_EXTENSIONS_INL_H
#undef PEDICEL_COSSERAT_LANE_EXTENSIONS_INL_H
#else
#define PEDICEL_COSSERAT_LANE_EXTENSIONS_INL_H
#endif

#include <limits>

#include "plugins/cosserat/lanes/lane_math-inl.h"
#include "plugins/cosserat/laws/hysteresis-inl.h"
#include "plugins/cosserat/laws/internal_friction-inl.h"
#include "plugins/cosserat/laws/joint_terms-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pedicel::cosserat {
namespace HWY_NAMESPACE {

namespace formula = laws::HWY_NAMESPACE;

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

/// Adds a slider that gives way little by little where a branch has one, on the way from the
/// joint's bend `now` at the step's start; returns by how much its spring is bent at the end.
HWY_INLINE formula::BentTwice<V> add_hysteresis(const BranchRow& branch,
                                                const formula::BentJoint<V>& joint, int lane,
                                                const V3& now, formula::BendTerms<V>& terms) {
  const V exponent = load(branch.exponent + lane), one = set(1.0);
  const M has = exponent > set(0.0);
  const V share = hn::IfThenElse(has, slider_share(branch, lane), set(0.0));
  const V reach = hn::IfThenElse(hn::And(has, share > set(0.0)),
                                 slider_reach(branch, share, joint.softer, lane), one);
  const V3 before = now - load3(branch.value, lane);
  return formula::add_hysteresis(joint, share, reach, hn::Max(exponent, one), {before.x, before.y},
                                 {now.x, now.y}, terms);
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
    V numbers[laws::joint_term_numbers];
    for (int i = 0; i < laws::joint_term_numbers; ++i)
      numbers[i] = load(rows.joint_term[row].number[i] + lane);
    formula::add_joint_terms(pack.terms, numbers, joint, terms);
  }
  for (int j = 0; j < pack.sliders; ++j) {
    const BranchRow& branch = rows.law_branch[row * rows.law_branches + j];
    const V3 y = phi - load3(branch.value, lane);
    V share = slider_share(branch, lane);
    const V reach = slider_reach(branch, share, stiffness.softer, lane);
    if (pack.hysteretic) {
      add_hysteresis(branch, joint, lane, load3(rows.strain[row].bend, lane), terms);
      share = hn::IfThenElse(load(branch.exponent + lane) > zero, zero, share);
    }
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
    V3 slid{hn::MulAdd(give, y.x, value.x), hn::MulAdd(give, y.y, value.y), value.z};
    if (pack.hysteretic) {
      formula::BendTerms<V> unused{};
      const auto bent = add_hysteresis(branch, joint, lane, now, unused);
      slid = select(load(branch.exponent + lane) > set(0.0),
                    V3{phi.x - bent.y1, phi.y - bent.y2, value.z}, slid);
    }
    store3(select(share > set(0.0), slid, relaxed), branch.value, lane);
  }
}

// ---- Drag ---------------------------------------------------------------------------------------

/// A direction at the iterate, or `share` of the way to it from what it was.
HWY_INLINE void follow(const V3& direction, Lanes* kept, int lane, double share) {
  V3 now = direction;
  if (share < 1.0) {
    const V3 before = load3(kept, lane);
    now = add_scaled(before, set(share), now - before);
    now = (set(1.0) / hn::Max(hn::Sqrt(dot(now, now)), set(1.0e-100))) * now;
  }
  store3(now, kept, lane);
}

/// Linearised, the drag turns with the segment: its axis goes to that of the iterate by `share`.
HWY_INLINE void set_axis(const RowArrays& rows, const Pack& pack, int row, int lane, double share) {
  const Q turn = load4(rows.iterate[row].orientation, lane);
  follow(axis3(turn), rows.extension_term[row].axis, lane, share);
  if (pack.plated)
    follow(matrix(turn) * load3(rows.extension[row].plate, lane), rows.extension_term[row].plate,
           lane, share);
}

/// The drag of eight segments as a dissipation potential h~ c/3 |u|^3 of the place m of their
/// middles: u = P (air - (m - m*)/h~), P taking out what is along the axis.
struct Drag {
  V3 u;      // m/s
  V speed;   // m/s
  V c;       // N/(m/s)2
  V energy;  // J
};

/// The air's velocity less that of the middle.
HWY_INLINE V3 wind_at(const RowArrays& rows, const Pack& pack, int row, int lane,
                      const V3& middle) {
  const ExtensionTermRow& term = rows.extension_term[row];
  const V h = load(pack.effective_step + lane);
  const V3 velocity = (set(1.0) / h) * (middle - load3(term.middle_past, lane));
  return load3(term.air, lane) - velocity;
}

HWY_INLINE Drag drag_across(const V3& relative, const V3& axis, V c, V h) {
  const V3 u = less_scaled(relative, dot(relative, axis), axis);
  const V speed = hn::Sqrt(dot(u, u));
  return {u, speed, c, h * c * speed * speed * speed * set(1.0 / 3.0)};
}

/// The drag across the segment, and across the normal of its plate.
HWY_INLINE Drag drag_of(const RowArrays& rows, const Pack& pack, int row, int lane,
                        const V3& relative) {
  return drag_across(relative, load3(rows.extension_term[row].axis, lane),
                     load(rows.extension[row].drag + lane), load(pack.effective_step + lane));
}
HWY_INLINE Drag plate_drag_of(const RowArrays& rows, const Pack& pack, int row, int lane,
                              const V3& relative) {
  return drag_across(relative, load3(rows.extension_term[row].plate, lane),
                     load(rows.extension[row].plate_tangential + lane),
                     load(pack.effective_step + lane));
}

/// J, the potentials of all drag of eight segments.
HWY_INLINE V drag_energy(const RowArrays& rows, const Pack& pack, int row, int lane,
                         const V3& middle) {
  const V3 relative = wind_at(rows, pack, row, lane, middle);
  V energy = drag_of(rows, pack, row, lane, relative).energy;
  if (pack.plated) {
    const V along = hn::Abs(dot(relative, load3(rows.extension_term[row].plate, lane)));
    const V c = load(rows.extension[row].plate_normal + lane);
    energy = energy + plate_drag_of(rows, pack, row, lane, relative).energy +
             load(pack.effective_step + lane) * c * along * along * along * set(1.0 / 3.0);
  }
  return energy;
}

/// A force on the middle and the derivative of minus it, lower triangle.
struct MiddleForce {
  V xx, yy, zz, yx, zx, zy;  // N/m
  V3 force;                  // N
};

/// c |u| u and its derivative, (c/h~) (|u| P + u u^T/|u|).
HWY_INLINE MiddleForce middle_force(const Drag& drag, const V3& axis, V h) {
  const V w = drag.c / h, by_speed = w * drag.speed;
  const V per_speed = w / hn::Max(drag.speed, set(1.0e-100));
  const V3 &u = drag.u, &n = axis;
  const auto entry = [&](V a, V b, V na, V nb) { return per_speed * a * b - by_speed * na * nb; };
  return {by_speed + entry(u.x, u.x, n.x, n.x),
          by_speed + entry(u.y, u.y, n.y, n.y),
          by_speed + entry(u.z, u.z, n.z, n.z),
          entry(u.y, u.x, n.y, n.x),
          entry(u.z, u.x, n.z, n.x),
          entry(u.z, u.y, n.z, n.y),
          (drag.c * drag.speed) * u};
}

/// The same along the plate's normal n: c |u.n| (u.n) n, (2 c/h~) |u.n| n n^T.
HWY_INLINE MiddleForce normal_force(const V3& relative, const V3& n, V c, V h) {
  const V speed = dot(relative, n), size = c * hn::Abs(speed);
  const V rate = (size + size) / h;
  return {rate * n.x * n.x, rate * n.y * n.y, rate * n.z * n.z,  rate * n.y * n.x,
          rate * n.z * n.x, rate * n.z * n.y, (size * speed) * n};
}

/// As blocks of (position, rotation) with the middle at `arm` from the node.
HWY_INLINE void add_middle_force(const MiddleForce& at, const V3& arm, V* d, V* right) {
  d[0] = d[0] + at.xx;
  d[1] = d[1] + at.yx;
  d[2] = d[2] + at.yy;
  d[3] = d[3] + at.zx;
  d[4] = d[4] + at.zy;
  d[5] = d[5] + at.zz;
  // Lower left: [arm]x H, whose columns are arm x (columns of H).
  const V3 a = cross(arm, {at.xx, at.yx, at.zx}), b = cross(arm, {at.yx, at.yy, at.zy}),
           c = cross(arm, {at.zx, at.zy, at.zz});
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
  const V3 &force = at.force, moment = cross(arm, force);
  right[0] = right[0] + force.x;
  right[1] = right[1] + force.y;
  right[2] = right[2] + force.z;
  right[3] = right[3] + moment.x;
  right[4] = right[4] + moment.y;
  right[5] = right[5] + moment.z;
}

HWY_INLINE void add_drag(const RowArrays& rows, const Pack& pack, int row, int lane,
                         const V3& middle, const V3& arm, V* d, V* right) {
  const ExtensionTermRow& term = rows.extension_term[row];
  const V3 relative = wind_at(rows, pack, row, lane, middle);
  const V h = load(pack.effective_step + lane);
  const auto add = [&](const MiddleForce& force) { add_middle_force(force, arm, d, right); };
  add(middle_force(drag_of(rows, pack, row, lane, relative), load3(term.axis, lane), h));
  if (!pack.plated) return;
  const V3 normal = load3(term.plate, lane);
  add(middle_force(plate_drag_of(rows, pack, row, lane, relative), normal, h));
  add(normal_force(relative, normal, load(rows.extension[row].plate_normal + lane), h));
}

}  // namespace HWY_NAMESPACE
}  // namespace pedicel::cosserat
HWY_AFTER_NAMESPACE();

#endif
