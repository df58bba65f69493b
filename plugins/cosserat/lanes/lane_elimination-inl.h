// One step of the block elimination from the leaves to the root, for eight elements. Included once
// an instruction set by lane_kernels.cpp, which is why it has no ordinary guard.
//
// An element's rows of Newton's system, with p the change of its parent, are
//   A x + C p = g,   A = L D L^T.
// Once p is known, x = L^-T (y + W p) with y = D^-1 L^-1 g and W = -D^-1 L^-1 C. So L, W and y are
// all that is kept of an element. With V = D W its parent is left with
//   its own block - V^T W   and   its own right side + V^T y.
// Block::diagonal is A by rows, and Blocks holds -C, whose upper right quarter is zero. Loops are
// unrolled in full: blocks then stay in registers, and what is known to be zero is not computed.
#if defined(PEDICEL_COSSERAT_LANE_ELIMINATION_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEDICEL_COSSERAT_LANE_ELIMINATION_INL_H
#undef PEDICEL_COSSERAT_LANE_ELIMINATION_INL_H
#else
#define PEDICEL_COSSERAT_LANE_ELIMINATION_INL_H
#endif

#include "plugins/cosserat/lanes/lane_element-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pedicel::cosserat {
namespace HWY_NAMESPACE {

constexpr int width = static_cast<int>(hn::MaxLanes(D()));

HWY_INLINE void clear(Block& carry) {
  for (V& x : carry.diagonal) x = set(0.0);
  for (V& x : carry.right) x = set(0.0);
}

HWY_INLINE void add(const Block& block, Block& carry) {
#pragma GCC unroll 21
  for (int i = 0; i < triangle6; ++i) carry.diagonal[i] = carry.diagonal[i] + block.diagonal[i];
#pragma GCC unroll 6
  for (int i = 0; i < 6; ++i) carry.right[i] = carry.right[i] + block.right[i];
}

// Branches that start here, springs and contacts. Few rows have any, so this stays out of line.
HWY_NOINLINE void add_sources(const BlockSource* sources, int first, int lane, Block& block) {
  const V lanes = hn::Iota(D(), lane);
  for (int s = first; s >= 0; s = sources[s].next) {
    const BlockSource& source = sources[s];
    const M own = lanes == set(source.lane);
    const double* value = source.values;
    const auto add = [&](V& x) {
      x = x + hn::IfThenElseZero(own, set(*value));
      value += source.stride;
    };
    for (V& x : block.diagonal) add(x);
    for (V& x : block.right) add(x);
  }
}

constexpr int at(int i, int j) {  // in a lower triangle by rows
  return i * (i + 1) / 2 + j;
}

// L D L^T in place, L with ones on its diagonal, where D^-1 stands: one division a pivot and no
// root, which would make up half of the time from one row to the next. Returns the smallest pivot.
// There is no pivoting: A is positive definite, and what is not makes the plant unhealthy.
HWY_INLINE V factorise(V* a) {
  V smallest = set(1.0);
#pragma GCC unroll 6
  for (int j = 0; j < 6; ++j) {
    const V pivot = a[at(j, j)];
    // Written so that a NaN counts as a bad pivot.
    smallest = hn::IfThenElse(pivot > set(0.0), smallest, set(0.0));
    const V inverse = set(1.0) / pivot;
    a[at(j, j)] = inverse;
    V column[6];
#pragma GCC unroll 6
    for (int i = j + 1; i < 6; ++i) {
      column[i] = a[at(i, j)];
      a[at(i, j)] = column[i] * inverse;
    }
#pragma GCC unroll 6
    for (int k = j + 1; k < 6; ++k)
#pragma GCC unroll 6
      for (int i = k; i < 6; ++i) a[at(i, k)] = hn::NegMulAdd(a[at(i, j)], column[k], a[at(i, k)]);
  }
  return smallest;
}

// x <- L^-1 x, where the first `skip` entries are zero.
template <int skip>
HWY_INLINE void forward(const V* l, V* x) {
#pragma GCC unroll 6
  for (int k = skip; k < 6; ++k)
#pragma GCC unroll 6
    for (int i = k + 1; i < 6; ++i) x[i] = hn::NegMulAdd(l[at(i, k)], x[k], x[i]);
}

// The parent's own share of the element's energies.
HWY_INLINE void share_of_parent(const Blocks& b, Block& carry) {
  V* d = carry.diagonal;
  d[0] = b.stretch.xx;
  d[1] = b.stretch.yx;
  d[2] = b.stretch.yy;
  d[3] = b.stretch.zx;
  d[4] = b.stretch.zy;
  d[5] = b.stretch.zz;
  for (const int i : {6, 7, 8, 10, 11, 12, 15, 16, 17}) d[i] = set(0.0);
  d[9] = b.bend.xx;
  d[13] = b.bend.yx;
  d[14] = b.bend.yy;
  d[18] = b.bend.zx;
  d[19] = b.bend.zy;
  d[20] = b.bend.zz;
  V* g = carry.right;
  g[0] = b.force.x;
  g[1] = b.force.y;
  g[2] = b.force.z;
  g[3] = b.moment.x;
  g[4] = b.moment.y;
  g[5] = b.moment.z;
}

// What comes of the coupling, to whom an element is eliminated into: -V^T W and V^T y with V = D W.
HWY_INLINE void carry_on(const V (&v)[6][6], const V (&w)[6][6], const V* y, Block& carry) {
  V *d = carry.diagonal, *g = carry.right;
#pragma GCC unroll 6
  for (int j = 0; j < 6; ++j) {  // v[j] is column j
    const int first = j < 3 ? 0 : 3;
#pragma GCC unroll 6
    for (int i = j; i < 6; ++i) {
      const int start = i < 3 ? first : 3;
#pragma GCC unroll 6
      for (int k = start; k < 6; ++k) d[at(i, j)] = hn::NegMulAdd(v[i][k], w[j][k], d[at(i, j)]);
    }
#pragma GCC unroll 6
    for (int k = first; k < 6; ++k) g[j] = hn::MulAdd(v[j][k], y[k], g[j]);
  }
}

// Into the parent, which gets its share of the energies too; or, where `b` is turned(), into the
// child, whose own block has it.
enum class Into { parent, child };
template <Into into>
HWY_INLINE V eliminate(const Blocks& b, FactorRow& out, int lane, Block& carry) {
  V* l = carry.diagonal;  // so far: what the tips gave
  V* y = carry.right;
  const V smallest = factorise(l);
  V v[6][6], w[6][6];
  const V3(&lever)[3] = b.lever;
  const S3 &s = b.stretch, &t = b.bend;
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
    for (int i = 0; i < 6; ++i) v[j][i] = columns[j][i];
#pragma GCC unroll 3
  for (int j = 0; j < 3; ++j) forward<0>(l, v[j]);
#pragma GCC unroll 3
  for (int j = 3; j < 6; ++j) forward<3>(l, v[j]);
  forward<0>(l, y);
  // y stays in double precision, L and W go to single (FactorRow).
  V kept[6];
#pragma GCC unroll 6
  for (int i = 0; i < 6; ++i) {
    kept[i] = l[at(i, i)] * y[i];
    store(kept[i], out.right[i] + lane);
  }
  int place = 0;
#pragma GCC unroll 6
  for (int j = 0; j < 6; ++j)
#pragma GCC unroll 6
    for (int i = j < 3 ? 0 : 3; i < 6; ++i) {
      w[j][i] = l[at(i, i)] * v[j][i];
      store(w[j][i], out.factors[place++] + lane);
    }
#pragma GCC unroll 6
  for (int i = 1; i < 6; ++i)
#pragma GCC unroll 6
    for (int j = 0; j < i; ++j) store(l[at(i, j)], out.factors[place++] + lane);
  // From here on `carry` is what the next element gets.
  if constexpr (into == Into::parent)
    share_of_parent(b, carry);
  else
    clear(carry);
  carry_on(v, w, kept, carry);
  return smallest;
}

// With its unknowns in the order (q, x). The coupling of a child to its parent in that order has
// the zeros of one of a parent to its child in the order (x, q): so the same code does both.
HWY_INLINE Block turned(const Block& block) {
  Block out;
#pragma GCC unroll 6
  for (int i = 0; i < 6; ++i) {
    const int a = (i + 3) % 6;
#pragma GCC unroll 6
    for (int j = 0; j <= i; ++j) {
      const int b = (j + 3) % 6;
      out.diagonal[at(i, j)] = block.diagonal[a >= b ? at(a, b) : at(b, a)];
    }
    out.right[i] = block.right[a];
  }
  return out;
}

// The coupling from the parent's side, in that order.
HWY_INLINE Blocks turned(const Blocks& b) {
  Blocks out;
  out.stretch = b.bend;
  out.bend = b.stretch;
  const V3(&lever)[3] = b.lever;
  out.lever[0] = {lever[0].x, lever[1].x, lever[2].x};
  out.lever[1] = {lever[0].y, lever[1].y, lever[2].y};
  out.lever[2] = {lever[0].z, lever[1].z, lever[2].z};
  return out;
}

// x <- L^-T x, from the last unknown to the first.
template <class Stored>
HWY_INLINE void solve_transposed(const Stored* lower, int lane, V* x) {
#pragma GCC unroll 6
  for (int k = 5; k > 0; --k)
#pragma GCC unroll 6
    for (int i = 0; i < k; ++i)
      x[i] = hn::NegMulAdd(load(lower[k * (k - 1) / 2 + i] + lane), x[k], x[i]);
}

// From y to the solution, given that of whom the element was eliminated into.
HWY_INLINE void back_substitute(const FactorRow& factor, int lane, const V* other, V* x) {
  int place = 0;
#pragma GCC unroll 6
  for (int j = 0; j < 6; ++j)
#pragma GCC unroll 6
    for (int i = j < 3 ? 0 : 3; i < 6; ++i)
      x[i] = hn::MulAdd(load(factor.factors[place++] + lane), other[j], x[i]);
  solve_transposed(factor.factors + FactorRow::coupling_size, lane, x);
}

}  // namespace HWY_NAMESPACE
}  // namespace pedicel::cosserat
HWY_AFTER_NAMESPACE();

#endif
