#include "plugins/cosserat/lanes/lane_kernels.h"

#include <memory>

// Compiled once for each of these instruction sets; a processor without AVX2 takes the portable
// one.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "plugins/cosserat/lanes/lane_kernels.cpp"
// clang-format off: foreach_target.h includes this file again and must come first.
#include "hwy/foreach_target.h"
#include "hwy/highway.h"
// clang-format on

#include "plugins/cosserat/lanes/lane_element-inl.h"
#include "plugins/cosserat/lanes/lane_elimination-inl.h"
#include "plugins/cosserat/lanes/lane_loops-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pedicel::cosserat {
namespace HWY_NAMESPACE {

HWY_INLINE int parent_row(const Pack& pack, int row) {
  return pack.loops ? pack.begin + 1 + pack.loops->parents()[row - pack.begin - 1] : row - 1;
}

// ---- Terms of a step ----------------------------------------------------------------------------

HWY_INLINE void prepare_viscous(const RowArrays& rows, const Pack& pack, int row, int lane,
                                const Pose& parent, const Pose& own, V h) {
  const ElementRow& element = rows.element[row];
  ViscousRow& term = rows.viscous[row];
  const V a = load(pack.past_now + lane), b = load(pack.past_before + lane);
  const V viscous = load(element.damping_time + lane) / h;
  store(set(1.0) + viscous, term.stiffening + lane);
  const V share = viscous / (set(1.0) + viscous);
  const V3 stretch = stretch_of(element, lane, matrix(own.orientation),
                                span_of(parent, own, load(element.length + lane)));
  const V3 bend = bend_of(element, lane, parent, own).phi;
  store3(stretch, rows.strain[row].stretch, lane);
  store3(bend, rows.strain[row].bend, lane);
  const StrainRow& before = rows.previous_strain[row];
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
  set_axis(rows, pack, row, lane, 1.0);
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
  const Q turn = times_conjugate(before.orientation, now.orientation);
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
  store_pose({com_past, rotation_past}, rows.previous[row], lane);
  store3(add_scaled(com_past, advance, velocity), term.com_target, lane);
  store4(rotation_past * exp_map(advance * less_scaled(spin, h, gyroscopic)), term.rotation_target,
         lane);
  store(drag / (h * h), term.inertia_scale + lane);
  if (extended || pack.viscous) {
    prepare_viscous(rows, pack, row, lane, load_pose(rows.start[parent_row(pack, row)], lane), now,
                    h);
    if constexpr (extended)
      prepare_joint(rows, pack, row, lane, load3(rows.strain[row].bend, lane));
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

// ---- Elimination --------------------------------------------------------------------------------

// What another thread has just written comes from its core's cache: asked for so many rows early,
// nothing waits for it.
constexpr int sources_ahead = 3;
HWY_INLINE void fetch_sources(const RowArrays& rows, const Pack& pack, int row) {
  if (row <= pack.begin || row >= pack.end) return;  // a pack may have fewer rows than that
  for (int s = rows.first_extra[row]; s >= 0; s = rows.extras[s].next)
    for (int line = 0; line < block_size; line += lane_count)
      __builtin_prefetch(rows.extras[s].values + line);
}

// Once a row, however many vectors it takes.
HWY_INLINE void fetch_ahead(const RowArrays& rows, int lane) {
  if (rows.ahead && lane == 0) rows.ahead->some();
}

HWY_INLINE void add_sources_of(const RowArrays& rows, int row, int lane, Block& block) {
  if (rows.first_branch[row] >= 0) add_sources(rows.branches, rows.first_branch[row], lane, block);
  if (rows.first_extra[row] >= 0) add_sources(rows.extras, rows.first_extra[row], lane, block);
}

HWY_INLINE void store(const Block& block, Lanes* to, int lane) {
  for (int i = 0; i < triangle6; ++i) store(block.diagonal[i], to[i] + lane);
  for (int i = 0; i < 6; ++i) store(block.right[i], to[triangle6 + i] + lane);
}

// A row's blocks at the iterate; its energy is added.
template <bool extended>
HWY_INLINE Blocks linearised(const RowArrays& rows, const Pack& pack, int row, int lane,
                             V& energy) {
  if constexpr (extended)
    if (pack.windy) set_axis(rows, pack, row, lane, rows.axis_share);
  const Strained s =
      strain<extended>(rows, pack, row, lane, load_pose(rows.iterate[parent_row(pack, row)], lane),
                       load_pose(rows.iterate[row], lane));
  energy = energy + s.energy;
  return blocks_of<extended>(rows, pack, row, lane, s);
}

template <bool extended>
void eliminate_pack(const RowArrays& rows, Pack& pack) {
  for (int lane = 0; lane < lane_count; lane += width) {
    Block carry;
    clear(carry);
    V energy = set(0.0), healthy = set(1.0);
    for (int k = 1; k <= sources_ahead; ++k) fetch_sources(rows, pack, pack.end - k);
    for (int row = pack.end - 1; row > pack.begin; --row) {
      const Blocks blocks = linearised<extended>(rows, pack, row, lane, energy);
      add(blocks.own, carry);
      fetch_sources(rows, pack, row - sources_ahead);
      fetch_ahead(rows, lane);
      add_sources_of(rows, row, lane, carry);
      healthy = hn::Min(healthy, eliminate<Into::parent>(blocks, rows.factor[row], lane, carry));
    }
    store(energy, pack.energy_before + lane);
    store(healthy, pack.healthy + lane);
    store(carry, pack.branch, lane);
  }
}

// What an element couples to its child is known when the child is linearised; `carry` has the order
// (q, x), which turned() explains.
template <bool extended>
void eliminate_from_clamp_pack(const RowArrays& rows, Pack& pack) {
  for (int lane = 0; lane < lane_count; lane += width) {
    V energy = set(0.0), healthy = set(1.0);
    for (int k = 1; k <= sources_ahead; ++k) fetch_sources(rows, pack, pack.begin + k);
    Block carry = turned(linearised<extended>(rows, pack, pack.begin + 1, lane, energy).own);
    for (int row = pack.begin + 1; row < pack.end - 1; ++row) {
      const Blocks child = linearised<extended>(rows, pack, row + 1, lane, energy);
      Block block;
      share_of_parent(child, block);
      fetch_sources(rows, pack, row + sources_ahead);
      fetch_ahead(rows, lane);
      add_sources_of(rows, row, lane, block);
      add(turned(block), carry);
      healthy =
          hn::Min(healthy, eliminate<Into::child>(turned(child), rows.factor[row], lane, carry));
      add(turned(child.own), carry);
    }
    store(energy, pack.energy_before + lane);
    store(healthy, pack.healthy + lane);
    store(turned(carry), pack.branch, lane);
  }
}

template <bool extended>
void linearise_pack(const RowArrays& rows, Pack& pack) {
  for (int lane = 0; lane < lane_count; lane += width) {
    V energy = set(0.0);
    for (int row = pack.end - 1; row > pack.begin; --row) {
      const Blocks b = linearised<extended>(rows, pack, row, lane, energy);
      BlocksRow& out = rows.blocks[row];
      for (int i = 0; i < triangle6; ++i) store(b.own.diagonal[i], out.diagonal[i] + lane);
      // Lanes without an element must not seem to move.
      const V alive = load(rows.element[row].alive + lane);
      for (int i = 0; i < 6; ++i) store(alive * b.own.right[i], out.right[i] + lane);
      const S3 &s3 = b.stretch, &t3 = b.bend;
      const V3(&lever)[3] = b.lever;
      const V coupling[21] = {
          s3.xx,      s3.yx,      s3.yy,      s3.zx,      s3.zy,      s3.zz,      lever[0].x,
          lever[0].y, lever[0].z, lever[1].x, lever[1].y, lever[1].z, lever[2].x, lever[2].y,
          lever[2].z, t3.xx,      t3.yx,      t3.yy,      t3.zx,      t3.zy,      t3.zz};
      for (int i = 0; i < 21; ++i) store(coupling[i], out.coupling[i] + lane);
      const V on_parent[6] = {b.force.x, b.force.y, b.force.z, b.moment.x, b.moment.y, b.moment.z};
      for (int i = 0; i < 6; ++i) store(on_parent[i], out.on_parent[i] + lane);
    }
    store(energy, pack.energy_before + lane);
  }
}

// All blocks first, because elements are not eliminated in the order of their rows.
template <bool extended>
HWY_INLINE V linearise_loops(const RowArrays& rows, const Pack& pack, int lane, LoopWork& work) {
  const LoopShape& shape = *pack.loops;
  const int carrier = shape.size();
  for (int e = 0; e <= carrier; ++e)
    for (Lanes& x : work.diagonal[e]) store(set(0.0), x + lane);
  V energy = set(0.0);
  for (int e = 0; e < carrier; ++e) {
    const int row = pack.begin + 1 + e, parent = shape.parents()[e];
    const Blocks blocks = linearised<extended>(rows, pack, row, lane, energy);
    Block block = blocks.own;
    fetch_sources(rows, pack, row + sources_ahead);
    fetch_ahead(rows, lane);
    add_sources_of(rows, row, lane, block);
    add_block(block, work.diagonal[e], lane);
    share_of_parent(blocks, block);
    add_block(block, work.diagonal[parent < 0 ? carrier : parent], lane);
    const LoopShape::Place place = shape.couplings()[e];
    put_coupling(blocks, place, work.entry[place.entry], lane);
  }
  for (std::size_t w = 0; w < shape.welds().size(); ++w) {
    const auto [a, b] = shape.welds()[w];
    const Welded weld = welded(rows, pack, static_cast<int>(w), lane);
    energy = energy + weld.energy;
    add_weld(weld, -1.0, work.diagonal[a < 0 ? carrier : a], lane);
    add_weld(weld, 1.0, work.diagonal[b < 0 ? carrier : b], lane);
    const LoopShape::Place place = shape.weld_couplings()[w];
    put_coupling(weld, place, work.entry[place.entry], lane);
  }
  return energy;
}

template <bool extended>
void eliminate_loops_pack(const RowArrays& rows, Pack& pack) {
  LoopWork& work = loop_work();
  const LoopShape& shape = *pack.loops;
  LoopFactorRow* factors = rows.loop_factor + pack.first_loop_factor;
  for (int lane = 0; lane < lane_count; lane += width) {
    store(linearise_loops<extended>(rows, pack, lane, work), pack.energy_before + lane);
    V healthy = set(1.0);
    const LoopShape::Target* target = shape.targets().data();
    for (const LoopShape::Column& column : shape.columns())
      healthy =
          hn::Min(healthy, eliminate_column(shape, column, target, work, factors,
                                            rows.factor[pack.begin + 1 + column.element], lane));
    store(healthy, pack.healthy + lane);
    for (int i = 0; i < block_size; ++i)
      store(load(work.diagonal[shape.size()][i] + lane), pack.branch[i] + lane);
  }
}

void EliminateLoops(const RowArrays& rows, Pack& pack) {
  pack.extended ? eliminate_loops_pack<true>(rows, pack) : eliminate_loops_pack<false>(rows, pack);
}

void LineariseAndEliminate(const RowArrays& rows, Pack& pack) {
  pack.extended ? eliminate_pack<true>(rows, pack) : eliminate_pack<false>(rows, pack);
}

void EliminateFromClamp(const RowArrays& rows, Pack& pack) {
  pack.extended ? eliminate_from_clamp_pack<true>(rows, pack)
                : eliminate_from_clamp_pack<false>(rows, pack);
}

void Linearise(const RowArrays& rows, Pack& pack) {
  pack.extended ? linearise_pack<true>(rows, pack) : linearise_pack<false>(rows, pack);
}

// ---- Solution -----------------------------------------------------------------------------------

struct Largest {
  V turn2, shift2, change;
};

HWY_INLINE void measure(const V* d, V length, Largest& largest) {
  const V3 x{d[0], d[1], d[2]}, r{d[3], d[4], d[5]};
  largest.turn2 = hn::Max(largest.turn2, dot(r, r));
  largest.shift2 = hn::Max(largest.shift2, dot(x, x) / (length * length));
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
      fetch_ahead(rows, lane);
      V x[6];
      load_change(factor, lane, x);
      back_substitute(factor, lane, parent, x);
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

void SubstituteLoops(const RowArrays& rows, Pack& pack) {
  const auto& columns = pack.loops->columns();
  for (int lane = 0; lane < lane_count; lane += width) {
    Largest largest{set(0.0), set(0.0), set(0.0)};
    for (auto column = columns.rbegin(); column != columns.rend(); ++column) {
      const int row = pack.begin + 1 + column->element;
      fetch_ahead(rows, lane);
      V x[6];
      substitute_column(rows, pack, *column, lane, x);
      const V alive = load(rows.element[row].alive + lane);
#pragma GCC unroll 6
      for (int i = 0; i < 6; ++i) {
        x[i] = alive * x[i];
        store(x[i], rows.factor[row].right[i] + lane);
      }
      measure(x, load(rows.element[row].length + lane), largest);
    }
    report(largest, pack, lane);
  }
}

void SolveLast(const RowArrays& rows, Pack& pack) {
  const int row = pack.end - 1;
  for (int lane = 0; lane < lane_count; lane += width) {
    Block block;
    for (int i = 0; i < triangle6; ++i) block.diagonal[i] = load(pack.branch[i] + lane);
    for (int i = 0; i < 6; ++i) block.right[i] = load(pack.branch[triangle6 + i] + lane);
    fetch_ahead(rows, lane);
    add_sources_of(rows, row, lane, block);
    V *l = block.diagonal, *x = block.right;
    store(hn::Min(load(pack.healthy + lane), factorise(l)), pack.healthy + lane);
    forward<0>(l, x);
#pragma GCC unroll 6
    for (int i = 0; i < 6; ++i) x[i] = l[at(i, i)] * x[i];
#pragma GCC unroll 6
    for (int k = 5; k > 0; --k)
#pragma GCC unroll 6
      for (int i = 0; i < k; ++i) x[i] = hn::NegMulAdd(l[at(k, i)], x[k], x[i]);
    const V alive = load(rows.element[row].alive + lane);
    for (int i = 0; i < 6; ++i) store(alive * x[i], rows.factor[row].right[i] + lane);
  }
}

void SubstituteToClamp(const RowArrays& rows, Pack& pack) {
  for (int lane = 0; lane < lane_count; lane += width) {
    Largest largest{set(0.0), set(0.0), set(0.0)};
    V change[6], child[6];
    for (int row = pack.end - 1; row > pack.begin; --row) {
      FactorRow& factor = rows.factor[row];
      fetch_ahead(rows, lane);
      load_change(factor, lane, change);
      if (row < pack.end - 1) {
        back_substitute(factor, lane, child, change);  // both in turned() order
        const V alive = load(rows.element[row].alive + lane);
#pragma GCC unroll 3
        for (int i = 0; i < 3; ++i) {
          const V turn = alive * change[i];
          change[i] = alive * change[3 + i];
          change[3 + i] = turn;
        }
        for (int i = 0; i < 6; ++i) store(change[i], factor.right[i] + lane);
      }
      measure(change, load(rows.element[row].length + lane), largest);
#pragma GCC unroll 6
      for (int i = 0; i < 6; ++i) child[i] = change[(i + 3) % 6];
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

template <bool extended, bool measured>
void move_rows(const RowArrays& rows, Pack& pack, int first, int end, bool keep) {
  for (int lane = 0; lane < lane_count; lane += width) {
    const V share = load(pack.share + lane);
    const M moves = share > set(0.0);
    V energy = set(0.0);
    Pose parent = load_pose(rows.iterate[first - 1], lane);
    for (int row = first; row < end; ++row) {
      FactorRow& factor = rows.factor[row];
      PoseRow& kept = factor.base;
      fetch_ahead(rows, lane);
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
      if constexpr (measured) {
        if (pack.loops) parent = load_pose(rows.iterate[parent_row(pack, row)], lane);
        energy = energy + strain<extended>(rows, pack, row, lane, parent, moved).energy;
        parent = moved;
      }
    }
    if constexpr (measured)
      if (pack.loops) energy = energy + energy_of_welds(rows, pack, lane);
    if constexpr (measured) store(energy, pack.energy + lane);
  }
}

void Move(const RowArrays& rows, Pack& pack, int first, int end, bool keep, bool measured) {
  if (!measured)
    move_rows<false, false>(rows, pack, first, end, keep);
  else if (pack.extended)
    move_rows<true, true>(rows, pack, first, end, keep);
  else
    move_rows<false, true>(rows, pack, first, end, keep);
}

template <bool extended>
void evaluate_pack(const RowArrays& rows, const Pack& pack, double* sums) {
  for (int lane = 0; lane < lane_count; lane += width) {
    V energy = set(0.0);
    Pose parent = load_pose(rows.iterate[pack.begin], lane);
    for (int row = pack.begin + 1; row < pack.end; ++row) {
      const Pose own = load_pose(rows.iterate[row], lane);
      if (pack.loops) parent = load_pose(rows.iterate[parent_row(pack, row)], lane);
      energy = energy + strain<extended>(rows, pack, row, lane, parent, own).energy;
      parent = own;
    }
    if (pack.loops) energy = energy + energy_of_welds(rows, pack, lane);
    store(energy, sums + lane);
  }
}

void Evaluate(const RowArrays& rows, const Pack& pack, double* sums) {
  pack.extended ? evaluate_pack<true>(rows, pack, sums) : evaluate_pack<false>(rows, pack, sums);
}

void Finish(const RowArrays& rows, const Pack& pack, RateRow* end) {
  for (int lane = 0; lane < lane_count; lane += width) {
    const V inverse_step = set(1.0) / load(pack.effective_step + lane);
    for (int row = pack.begin + 1; row < pack.end; ++row) {
      const Pose pose = load_pose(rows.iterate[row], lane),
                 past = load_pose(rows.previous[row], lane);
      const V3 com = centre_of_mass(pose, load(rows.element[row].com_back + lane));
      store3(inverse_step * (com - past.position), end[row].velocity, lane);
      const Q turn = times_conjugate(past.orientation, pose.orientation);
      store3(inverse_step * log_map(turn).phi, end[row].angular_velocity, lane);
      if (pack.branches > 0)
        finish_joint(rows, pack, row, lane,
                     bend_of(rows.element[row], lane,
                             load_pose(rows.iterate[parent_row(pack, row)], lane), pose)
                         .phi);
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
HWY_EXPORT(EliminateFromClamp);
HWY_EXPORT(EliminateLoops);
HWY_EXPORT(SubstituteLoops);
HWY_EXPORT(SolveLast);
HWY_EXPORT(SubstituteToClamp);
HWY_EXPORT(Linearise);
HWY_EXPORT(Substitute);
HWY_EXPORT(MeasureChange);
HWY_EXPORT(Move);
HWY_EXPORT(Evaluate);
HWY_EXPORT(Finish);

void prepare(const RowArrays& rows, Pack& pack) {
  HWY_DYNAMIC_DISPATCH(Prepare)(rows, pack);
}
void linearise_and_eliminate(const RowArrays& rows, Pack& pack) {
  HWY_DYNAMIC_DISPATCH(LineariseAndEliminate)(rows, pack);
}
void eliminate_from_clamp(const RowArrays& rows, Pack& pack) {
  HWY_DYNAMIC_DISPATCH(EliminateFromClamp)(rows, pack);
}
void eliminate_loops(const RowArrays& rows, Pack& pack) {
  HWY_DYNAMIC_DISPATCH(EliminateLoops)(rows, pack);
}
void substitute_loops(const RowArrays& rows, Pack& pack) {
  HWY_DYNAMIC_DISPATCH(SubstituteLoops)(rows, pack);
}
void solve_last(const RowArrays& rows, Pack& pack) {
  HWY_DYNAMIC_DISPATCH(SolveLast)(rows, pack);
}
void substitute_to_clamp(const RowArrays& rows, Pack& pack) {
  HWY_DYNAMIC_DISPATCH(SubstituteToClamp)(rows, pack);
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
void move(const RowArrays& rows, Pack& pack, int first, int end, bool keep, bool measured) {
  HWY_DYNAMIC_DISPATCH(Move)(rows, pack, first, end, keep, measured);
}
void evaluate(const RowArrays& rows, const Pack& pack, Lanes& energy) {
  HWY_DYNAMIC_DISPATCH(Evaluate)(rows, pack, energy);
}
void finish(const RowArrays& rows, const Pack& pack, RateRow* end) {
  HWY_DYNAMIC_DISPATCH(Finish)(rows, pack, end);
}

LoopWork& loop_work() {
  static thread_local const auto work = std::make_unique<LoopWork>();
  return *work;
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
