// Joint laws and drag of lanes (joint_law.h, SegmentAir). Included once an instruction set by
// lane_kernels.cpp, which is why it has no ordinary guard.
#if defined(PEDICEL_COSSERAT_LANE_EXTENSIONS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEDICEL_COSSERAT_LANE_EXTENSIONS_INL_H
#undef PEDICEL_COSSERAT_LANE_EXTENSIONS_INL_H
#else
#define PEDICEL_COSSERAT_LANE_EXTENSIONS_INL_H
#endif

#include <limits>

#include "cosserat/lane_math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pedicel::cosserat {
namespace HWY_NAMESPACE {

/// What bends a joint: conjugate moment, energy, and the Hessian's bending part, positive definite.
struct Bending {
  V3 moment;   // N m
  V linear;    // J, twice the energy of what is linear in phi
  V energy;    // J, of the rest
  V3 hessian;  // N m/rad, diagonal
  V mixed;     // N m/rad, between the two bending axes
};

/// The stiffness of eight joints now, and its bending part's measure u = y.K y / softer.
struct JointStiffness {
  V3 k;      // N m/rad
  V softer;  // N m/rad, of the two bending ones
};

HWY_INLINE JointStiffness joint_stiffness(const ElementRow& element, const Pack& pack, int lane) {
  const V3 k = load(pack.modulus + lane) * load3(element.bend_stiffness, lane);
  return {k, hn::Max(hn::Min(k.x, k.y), set(1.0e-300))};
}

/// A bending spring whose moment is share g(u) K y: `slope` is 2 g', and 2 energy' = g.
struct Radial {
  V g, slope, energy;
};

/// g = 1 + hardening u; below zero it peaks, and the moment stays there.
HWY_INLINE Radial harden(V hardening, V u) {
  const V half = set(0.5), one = set(1.0);
  const M softens = hardening < set(0.0);
  const V peak = hn::IfThenElse(softens, one / (set(-3.0) * hn::Min(hardening, set(-1.0e-300))),
                                set(std::numeric_limits<double>::infinity()));
  const M beyond = u > peak;
  const V safe_peak = hn::IfThenElse(beyond, peak, one), safe_u = hn::IfThenElse(beyond, u, one);
  const V root = hn::Sqrt(safe_peak), flat = set(2.0 / 3.0) * root / hn::Sqrt(safe_u);
  const V flat_energy =
      set(5.0 / 12.0) * safe_peak + set(2.0 / 3.0) * root * (hn::Sqrt(safe_u) - root);
  return {hn::IfThenElse(beyond, flat, hn::MulAdd(hardening, u, one)),
          hn::IfThenElse(beyond, hn::Neg(flat) / safe_u, hardening + hardening),
          hn::IfThenElse(beyond, flat_energy, half * u + set(0.25) * hardening * u * u)};
}

/// A slider that slips where sqrt(u) passes `reach`.
HWY_INLINE Radial slip(V reach, V u) {
  const V root = hn::Sqrt(u);
  const M slips = root > reach;
  const V safe_u = hn::IfThenElse(slips, u, set(1.0));
  const V safe_reach = hn::IfThenElse(slips, reach, set(1.0));
  const V g = hn::IfThenElse(slips, safe_reach / hn::Sqrt(safe_u), set(1.0));
  return {g, hn::IfThenElse(slips, hn::Neg(g) / safe_u, set(0.0)),
          hn::IfThenElse(slips, hn::MulAdd(safe_reach, root, set(-0.5) * safe_reach * safe_reach),
                         set(0.5) * u)};
}

HWY_INLINE V3 bending_moment(const JointStiffness& stiffness, const V3& y) {
  return {stiffness.k.x * y.x, stiffness.k.y * y.y, set(0.0)};
}
HWY_INLINE V bending_measure(const JointStiffness& stiffness, const V3& y, const V3& moment) {
  return hn::MulAdd(moment.x, y.x, moment.y * y.y) / stiffness.softer;
}

/// Adds share (energy, moment, tangent) of a radial spring; `secant` gets its secant stiffness.
HWY_INLINE void add_radial(const JointStiffness& stiffness, V share, const V3& elastic,
                           const Radial& radial, Bending& out, V& secant_x, V& secant_y) {
  const V scale = share * radial.g;
  out.moment = add_scaled(out.moment, scale, elastic);
  out.energy = hn::MulAdd(share * stiffness.softer, radial.energy, out.energy);
  const V curve = share * radial.slope / stiffness.softer;
  secant_x = hn::MulAdd(scale, stiffness.k.x, secant_x);
  secant_y = hn::MulAdd(scale, stiffness.k.y, secant_y);
  out.hessian.x = out.hessian.x + curve * elastic.x * elastic.x;
  out.hessian.y = out.hessian.y + curve * elastic.y * elastic.y;
  out.mixed = out.mixed + curve * elastic.x * elastic.y;
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
/// as stiffness and target, then hardening and sliders. The tangent is taken where it is positive
/// definite, else the secant stiffness, a majoriser of what softens or slips.
HWY_INLINE Bending bend_joint(const RowArrays& rows, const Pack& pack, int row, int lane,
                              const V3& phi) {
  const ExtensionRow& extension = rows.extension[row];
  const V3 linear = load3(rows.extension_term[row].bend_stiffness, lane);
  const V3 off = phi - load3(rows.viscous[row].bend_target, lane);
  const V zero = set(0.0), half = set(0.5);
  Bending out{times(linear, off), zero, zero, {zero, zero, linear.z}, zero};
  out.linear = dot(off, out.moment);
  const JointStiffness stiffness = joint_stiffness(rows.element[row], pack, lane);
  V secant_x = linear.x, secant_y = linear.y;
  {
    const V3 elastic = bending_moment(stiffness, phi);
    const V u = bending_measure(stiffness, phi, elastic);
    Radial main = harden(load(extension.hardening + lane), u);
    main.g = main.g - set(1.0);
    main.energy = main.energy - half * u;
    add_radial(stiffness, load(extension.elastic + lane), elastic, main, out, secant_x, secant_y);
  }
  for (int j = 0; j < pack.sliders; ++j) {
    const BranchRow& branch = rows.law_branch[row * rows.law_branches + j];
    const V3 y = phi - load3(branch.value, lane);
    const V share = slider_share(branch, lane);
    const V3 elastic = bending_moment(stiffness, y);
    const V u = bending_measure(stiffness, y, elastic);
    const Radial slid = slip(slider_reach(branch, share, stiffness.softer, lane), u);
    add_radial(stiffness, share, elastic, slid, out, secant_x, secant_y);
  }
  const V least = set(1.0e-4);
  secant_x = hn::Max(secant_x, least * stiffness.k.x);
  secant_y = hn::Max(secant_y, least * stiffness.k.y);
  const V xx = secant_x + out.hessian.x, yy = secant_y + out.hessian.y;
  const V determinant = xx * yy - out.mixed * out.mixed;
  const M tangent = hn::And(xx > zero, determinant > least * secant_x * secant_y);
  out.hessian.x = hn::IfThenElse(tangent, xx, secant_x);
  out.hessian.y = hn::IfThenElse(tangent, yy, secant_y);
  out.mixed = hn::IfThenElse(tangent, out.mixed, zero);
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
  const V3 now = load3(rows.strain[row].bend, lane);
  for (int j = 0; j < pack.branches; ++j) {
    BranchRow& branch = rows.law_branch[row * rows.law_branches + j];
    const V3 value = load3(branch.value, lane);
    const V decay = load(branch.decay + lane), factor = load(branch.factor + lane);
    const V3 past = add_scaled(decay * value, factor - decay, now);
    const V3 relaxed = add_scaled(past, set(1.0) - factor, phi);
    const V share = slider_share(branch, lane);
    const V3 y = phi - value;
    const V u = bending_measure(stiffness, y, bending_moment(stiffness, y));
    const V give = set(1.0) - slip(slider_reach(branch, share, stiffness.softer, lane), u).g;
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
  const V w = drag.c / h, one = w * drag.speed;
  const V along = w / hn::Max(drag.speed, set(1.0e-100));
  const V3 &u = drag.u, &n = axis;
  const auto entry = [&](V a, V b, V na, V nb) { return along * a * b - one * na * nb; };
  const V xx = one + entry(u.x, u.x, n.x, n.x), yy = one + entry(u.y, u.y, n.y, n.y);
  const V zz = one + entry(u.z, u.z, n.z, n.z), yx = entry(u.y, u.x, n.y, n.x);
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
