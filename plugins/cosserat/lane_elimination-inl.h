// One step of the block elimination from the leaves to the root, for eight elements. Included once
// an instruction set by lane_kernels.cpp, which is why it has no ordinary guard.
#if defined(PEDICEL_COSSERAT_LANE_ELIMINATION_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEDICEL_COSSERAT_LANE_ELIMINATION_INL_H
#undef PEDICEL_COSSERAT_LANE_ELIMINATION_INL_H
#else
#define PEDICEL_COSSERAT_LANE_ELIMINATION_INL_H
#endif

#include "cosserat/lane_element-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pedicel::cosserat {
namespace HWY_NAMESPACE {

constexpr int width = static_cast<int>(hn::MaxLanes(D()));

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

}  // namespace HWY_NAMESPACE
}  // namespace pedicel::cosserat
HWY_AFTER_NAMESPACE();

#endif
