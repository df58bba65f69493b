// Parts of plants with loops, one a lane: welds, and the block elimination of a part into the
// element that carries it (LoopShape). Included once an instruction set by lane_kernels.cpp, which
// is why it has no ordinary guard.
//
// An element's rows of Newton's system, with n the changes of its neighbours that are left, are
//   A x + sum C n = g,   A = L D L^T.
// With y = D^-1 L^-1 g, V = L^-1 C and W = D^-1 V the neighbours i and j are left with
//   A_i - V_i^T W_i,   C_ij - V_i^T W_j   and   g_i - V_i^T y,
// and once they are known x = L^-T (y - sum W n). Blocks stand by columns here: 6 j + i is row i.
#if defined(PEDICEL_COSSERAT_LANE_LOOPS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEDICEL_COSSERAT_LANE_LOOPS_INL_H
#undef PEDICEL_COSSERAT_LANE_LOOPS_INL_H
#else
#define PEDICEL_COSSERAT_LANE_LOOPS_INL_H
#endif

#include "plugins/cosserat/lanes/lane_elimination-inl.h"
#include "plugins/cosserat/lanes/loop_work.h"

HWY_BEFORE_NAMESPACE();
namespace pedicel::cosserat {
namespace HWY_NAMESPACE {

// ---- Welds --------------------------------------------------------------------------------------

struct Welded {
  V stiffness;  // N/m
  V3 force;     // N, W: on b
  S3 hessian;   // N m/rad, W
  V3 moment;    // N m, W: on b
  V energy;     // J
};

// 1 where neither has come off. What carries the part is there as long as the part is.
HWY_INLINE V both_alive(const RowArrays& rows, const Pack& pack, LoopShape::Joint weld, int lane) {
  const auto alive = [&](int e) {
    return e < 0 ? set(1.0) : load(rows.element[pack.begin + 1 + e].alive + lane);
  };
  return alive(weld.a) * alive(weld.b);
}

HWY_INLINE Welded welded(const RowArrays& rows, const Pack& pack, int index, int lane) {
  const LoopShape::Joint weld = pack.loops->welds()[index];
  const WeldRow& row = rows.weld[pack.first_weld + index];
  const Pose a = load_pose(rows.iterate[pack.begin + 1 + weld.a], lane);
  const Pose b = load_pose(rows.iterate[pack.begin + 1 + weld.b], lane);
  const V there = both_alive(rows, pack, weld, lane);
  Welded out;
  out.stiffness = there * load(row.position_stiffness + lane);
  const V3 gap = b.position - a.position;
  out.force = negative(out.stiffness * gap);
  const Log bend = log_map(times_conjugate(load4(row.rest_rotation, lane),
                                           times_conjugate(a.orientation, b.orientation)));
  const V3 k = there * load3(row.bend_stiffness, lane), conjugate = times(k, bend.phi);
  const M3 r = matrix(b.orientation), jacobian = inverse_jacobian_transposed(bend);
  const M3 bending{r * jacobian.a, r * jacobian.b, r * jacobian.c};
  out.hessian = sandwich(bending, k);
  out.moment = negative(bending * conjugate);
  out.energy = set(0.5) * (dot(bend.phi, conjugate) - dot(gap, out.force));
  return out;
}

HWY_INLINE V energy_of_welds(const RowArrays& rows, const Pack& pack, int lane) {
  V energy = set(0.0);
  for (std::size_t w = 0; w < pack.loops->welds().size(); ++w)
    energy = energy + welded(rows, pack, static_cast<int>(w), lane).energy;
  return energy;
}

// ---- The system ---------------------------------------------------------------------------------

HWY_INLINE void add_to(V x, double* sum) {
  store(load(sum) + x, sum);
}

HWY_INLINE void add_block(const Block& block, Lanes* sum, int lane) {
  for (int i = 0; i < triangle6; ++i) add_to(block.diagonal[i], sum[i] + lane);
  for (int i = 0; i < 6; ++i) add_to(block.right[i], sum[triangle6 + i] + lane);
}

// Columns of a coupling whose upper right quarter is zero, to where it belongs.
HWY_INLINE void put_coupling(const V (&columns)[6][6], LoopShape::Place place, Lanes* entry,
                             int lane) {
  for (int j = 0; j < 6; ++j)
    for (int i = 0; i < 6; ++i) {
      double* to = entry[place.turned ? 6 * i + j : 6 * j + i] + lane;
      store(place.first ? columns[j][i] : load(to) + columns[j][i], to);
    }
}

HWY_INLINE void put_coupling(const Blocks& b, LoopShape::Place place, Lanes* entry, int lane) {
  const S3 &s = b.stretch, &t = b.bend;
  const V3(&lever)[3] = b.lever;
  const V zero = set(0.0);
  const V columns[6][6] = {{hn::Neg(s.xx), hn::Neg(s.yx), hn::Neg(s.zx), hn::Neg(lever[0].x),
                            hn::Neg(lever[1].x), hn::Neg(lever[2].x)},
                           {hn::Neg(s.yx), hn::Neg(s.yy), hn::Neg(s.zy), hn::Neg(lever[0].y),
                            hn::Neg(lever[1].y), hn::Neg(lever[2].y)},
                           {hn::Neg(s.zx), hn::Neg(s.zy), hn::Neg(s.zz), hn::Neg(lever[0].z),
                            hn::Neg(lever[1].z), hn::Neg(lever[2].z)},
                           {zero, zero, zero, hn::Neg(t.xx), hn::Neg(t.yx), hn::Neg(t.zx)},
                           {zero, zero, zero, hn::Neg(t.yx), hn::Neg(t.yy), hn::Neg(t.zy)},
                           {zero, zero, zero, hn::Neg(t.zx), hn::Neg(t.zy), hn::Neg(t.zz)}};
  put_coupling(columns, place, entry, lane);
}

HWY_INLINE void put_coupling(const Welded& weld, LoopShape::Place place, Lanes* entry, int lane) {
  const S3& h = weld.hessian;
  const V zero = set(0.0), k = hn::Neg(weld.stiffness);
  const V columns[6][6] = {{k, zero, zero, zero, zero, zero},
                           {zero, k, zero, zero, zero, zero},
                           {zero, zero, k, zero, zero, zero},
                           {zero, zero, zero, hn::Neg(h.xx), hn::Neg(h.yx), hn::Neg(h.zx)},
                           {zero, zero, zero, hn::Neg(h.yx), hn::Neg(h.yy), hn::Neg(h.zy)},
                           {zero, zero, zero, hn::Neg(h.zx), hn::Neg(h.zy), hn::Neg(h.zz)}};
  put_coupling(columns, place, entry, lane);
}

// `sign`: 1 for b, -1 for a.
HWY_INLINE void add_weld(const Welded& weld, double sign, Lanes* sum, int lane) {
  const S3& h = weld.hessian;
  for (const int i : {0, 2, 5}) add_to(weld.stiffness, sum[i] + lane);
  add_to(h.xx, sum[9] + lane);
  add_to(h.yx, sum[13] + lane);
  add_to(h.yy, sum[14] + lane);
  add_to(h.zx, sum[18] + lane);
  add_to(h.zy, sum[19] + lane);
  add_to(h.zz, sum[20] + lane);
  const V right[6] = {weld.force.x,  weld.force.y,  weld.force.z,
                      weld.moment.x, weld.moment.y, weld.moment.z};
  for (int i = 0; i < 6; ++i) add_to(set(sign) * right[i], sum[triangle6 + i] + lane);
}

// ---- Elimination --------------------------------------------------------------------------------

// V in place of an entry's columns from `begin` to before `end`, and W; of both the first rows are
// zero.
template <int first>
HWY_INLINE void reduce_columns(int begin, int end, const V* l, Lanes* entry, Lanes* weighted,
                               LoopFactorRow& out, int lane) {
  for (int j = begin; j < end; ++j) {
    V v[6];
#pragma GCC unroll 6
    for (int i = 0; i < 6; ++i) v[i] = load(entry[6 * j + i] + lane);
    forward<first>(l, v);
#pragma GCC unroll 6
    for (int i = 0; i < 6; ++i) {
      const V w = l[at(i, i)] * v[i];
      store(v[i], entry[6 * j + i] + lane);
      store(w, weighted[6 * j + i] + lane);
      store(w, out.values[6 * j + i] + lane);
    }
  }
}

// `half` as in LoopShape::Entry.
template <bool half>
HWY_INLINE void reduce_entry(const V* l, Lanes* entry, Lanes* weighted, LoopFactorRow& out,
                             int lane) {
  reduce_columns<0>(0, 3, l, entry, weighted, out, lane);
  reduce_columns<half ? 3 : 0>(3, 6, l, entry, weighted, out, lane);
}

// A_i - V_i^T W_i and g_i - V_i^T y
template <bool half>
HWY_INLINE void subtract_own(const Lanes* v, const Lanes* w, const V* y, Lanes* sum, int lane) {
#pragma GCC unroll 6
  for (int j = 0; j < 6; ++j) {
    V own[6];
#pragma GCC unroll 6
    for (int k = 0; k < 6; ++k) own[k] = load(w[6 * j + k] + lane);
    V right = load(sum[triangle6 + j] + lane);
#pragma GCC unroll 6
    for (int k = half && j >= 3 ? 3 : 0; k < 6; ++k)
      right = hn::NegMulAdd(load(v[6 * j + k] + lane), y[k], right);
    store(right, sum[triangle6 + j] + lane);
#pragma GCC unroll 6
    for (int i = j; i < 6; ++i) {
      V x = load(sum[at(i, j)] + lane);
#pragma GCC unroll 6
      for (int k = half && i >= 3 ? 3 : 0; k < 6; ++k)
        x = hn::NegMulAdd(load(v[6 * i + k] + lane), own[k], x);
      store(x, sum[at(i, j)] + lane);
    }
  }
}

// C_ij - V_i^T W_j, its columns from `begin` to before `end`, where W_j begins with row `below`.
template <bool half_i, int below>
HWY_INLINE void subtract_columns(int begin, int end, const Lanes* v, const Lanes* w, bool first,
                                 Lanes* target, int lane) {
  for (int j = begin; j < end; ++j) {
    V own[6];
#pragma GCC unroll 6
    for (int k = below; k < 6; ++k) own[k] = load(w[6 * j + k] + lane);
#pragma GCC unroll 6
    for (int i = 0; i < 6; ++i) {
      double* to = target[6 * j + i] + lane;
      V x = first ? set(0.0) : load(to);
#pragma GCC unroll 6
      for (int k = half_i && i >= 3 ? 3 : below; k < 6; ++k)
        x = hn::NegMulAdd(load(v[6 * i + k] + lane), own[k], x);
      store(x, to);
    }
  }
}

template <bool half_i, bool half_j>
HWY_INLINE void subtract_product(const Lanes* v, const Lanes* w, bool first, Lanes* target,
                                 int lane) {
  subtract_columns<half_i, 0>(0, 3, v, w, first, target, lane);
  subtract_columns<half_i, half_j ? 3 : 0>(3, 6, v, w, first, target, lane);
}

HWY_INLINE void subtract_product(const Lanes* v, const Lanes* w, bool half_i, bool half_j,
                                 bool first, Lanes* target, int lane) {
  if (half_i && half_j)
    subtract_product<true, true>(v, w, first, target, lane);
  else if (half_i)
    subtract_product<true, false>(v, w, first, target, lane);
  else if (half_j)
    subtract_product<false, true>(v, w, first, target, lane);
  else
    subtract_product<false, false>(v, w, first, target, lane);
}

// One element of the part, with the targets of its products; returns the smallest pivot.
HWY_INLINE V eliminate_column(const LoopShape& shape, const LoopShape::Column& column,
                              const LoopShape::Target*& target, LoopWork& work,
                              LoopFactorRow* factors, FactorRow& out, int lane) {
  V l[triangle6], y[6];
  const Lanes* own = work.diagonal[column.element];
  for (int i = 0; i < triangle6; ++i) l[i] = load(own[i] + lane);
  for (int i = 0; i < 6; ++i) y[i] = load(own[triangle6 + i] + lane);
  const V smallest = factorise(l);
  forward<0>(l, y);
  int place = FactorRow::coupling_size;
#pragma GCC unroll 6
  for (int i = 0; i < 6; ++i) {
    y[i] = l[at(i, i)] * y[i];
    store(y[i], out.right[i] + lane);
#pragma GCC unroll 6
    for (int j = 0; j < i; ++j) store(l[at(i, j)], out.factors[place++] + lane);
  }
  const auto& entries = shape.entries();
  for (int i = column.begin; i < column.end; ++i) {
    Lanes* weighted = work.weighted[i - column.begin];
    if (entries[i].half)
      reduce_entry<true>(l, work.entry[i], weighted, factors[i], lane);
    else
      reduce_entry<false>(l, work.entry[i], weighted, factors[i], lane);
  }
  for (int i = column.begin; i < column.end; ++i) {
    const int neighbour = entries[i].column < 0 ? shape.size() : entries[i].column;
    const Lanes *v = work.entry[i], *w = work.weighted[i - column.begin];
    if (entries[i].half)
      subtract_own<true>(v, w, y, work.diagonal[neighbour], lane);
    else
      subtract_own<false>(v, w, y, work.diagonal[neighbour], lane);
    for (int j = i + 1; j < column.end; ++j, ++target)
      subtract_product(v, work.weighted[j - column.begin], entries[i].half, entries[j].half,
                       target->first, work.entry[target->entry], lane);
  }
  return smallest;
}

// From y to the solution of one element, given those that were eliminated after it.
HWY_INLINE void substitute_column(const RowArrays& rows, const Pack& pack,
                                  const LoopShape::Column& column, int lane, V* x) {
  const LoopShape& shape = *pack.loops;
  const FactorRow& own = rows.factor[pack.begin + 1 + column.element];
#pragma GCC unroll 6
  for (int i = 0; i < 6; ++i) x[i] = load(own.right[i] + lane);
  for (int k = column.begin; k < column.end; ++k) {
    const LoopShape::Entry entry = shape.entries()[k];
    const FactorRow& other = rows.factor[pack.begin + 1 + entry.column];
    const LoopFactorRow& factor = rows.loop_factor[pack.first_loop_factor + k];
    for (int j = 0; j < 6; ++j) {
      const V change = load(other.right[j] + lane);
#pragma GCC unroll 6
      for (int i = 0; i < 6; ++i)
        x[i] = hn::NegMulAdd(load(factor.values[6 * j + i] + lane), change, x[i]);
    }
  }
  solve_transposed(own.factors + FactorRow::coupling_size, lane, x);
}

}  // namespace HWY_NAMESPACE
}  // namespace pedicel::cosserat
HWY_AFTER_NAMESPACE();

#endif
