// Vectors, quaternions and 3x3 matrices of lanes. Included once an instruction set by
// lane_kernels.cpp, which is why it has no ordinary guard.
#if defined(PEDICEL_COSSERAT_LANE_MATH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEDICEL_COSSERAT_LANE_MATH_INL_H
#undef PEDICEL_COSSERAT_LANE_MATH_INL_H
#else
#define PEDICEL_COSSERAT_LANE_MATH_INL_H
#endif

#include <cmath>

#include "hwy/highway.h"
#include "plugins/cosserat/lanes/lanes.h"

HWY_BEFORE_NAMESPACE();
namespace pedicel::cosserat {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, lane_count>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;

HWY_INLINE V set(double x) {
  return hn::Set(D(), x);
}
HWY_INLINE V load(const double* p) {
  return hn::Load(D(), p);
}
HWY_INLINE void store(V x, double* p) {
  hn::Store(x, D(), p);
}

/// Numbers that are kept in single precision.
HWY_INLINE V load(const float* p) {
  return hn::PromoteTo(D(), hn::Load(hn::Rebind<float, D>(), p));
}
HWY_INLINE void store(V x, float* p) {
  const hn::Rebind<float, D> d;
  hn::Store(hn::DemoteTo(d, x), d, p);
}

struct V3 {
  V x, y, z;
};
struct Q {
  V x, y, z, w;
};
/// Columns.
struct M3 {
  V3 a, b, c;
};
/// Symmetric: lower triangle by rows.
struct S3 {
  V xx, yx, yy, zx, zy, zz;
};

HWY_INLINE V3 load3(const Lanes* p, int lane) {
  return {load(p[0] + lane), load(p[1] + lane), load(p[2] + lane)};
}
HWY_INLINE void store3(const V3& v, Lanes* p, int lane) {
  store(v.x, p[0] + lane);
  store(v.y, p[1] + lane);
  store(v.z, p[2] + lane);
}
HWY_INLINE Q load4(const Lanes* p, int lane) {
  return {load(p[0] + lane), load(p[1] + lane), load(p[2] + lane), load(p[3] + lane)};
}
HWY_INLINE void store4(const Q& q, Lanes* p, int lane) {
  store(q.x, p[0] + lane);
  store(q.y, p[1] + lane);
  store(q.z, p[2] + lane);
  store(q.w, p[3] + lane);
}

HWY_INLINE V3 operator+(const V3& a, const V3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
HWY_INLINE V3 operator-(const V3& a, const V3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
HWY_INLINE V3 operator*(V s, const V3& a) {
  return {s * a.x, s * a.y, s * a.z};
}
/// a + s b
HWY_INLINE V3 add_scaled(const V3& a, V s, const V3& b) {
  return {hn::MulAdd(s, b.x, a.x), hn::MulAdd(s, b.y, a.y), hn::MulAdd(s, b.z, a.z)};
}
/// a - s b
HWY_INLINE V3 less_scaled(const V3& a, V s, const V3& b) {
  return {hn::NegMulAdd(s, b.x, a.x), hn::NegMulAdd(s, b.y, a.y), hn::NegMulAdd(s, b.z, a.z)};
}
HWY_INLINE V3 times(const V3& a, const V3& b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}
HWY_INLINE V dot(const V3& a, const V3& b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, a.z * b.z));
}
HWY_INLINE V3 cross(const V3& a, const V3& b) {
  return {hn::NegMulAdd(a.z, b.y, a.y * b.z), hn::NegMulAdd(a.x, b.z, a.z * b.x),
          hn::NegMulAdd(a.y, b.x, a.x * b.y)};
}
HWY_INLINE V3 negative(const V3& a) {
  return {hn::Neg(a.x), hn::Neg(a.y), hn::Neg(a.z)};
}
HWY_INLINE V3 select(M mask, const V3& yes, const V3& no) {
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y),
          hn::IfThenElse(mask, yes.z, no.z)};
}

HWY_INLINE V3 operator*(const M3& m, const V3& v) {
  return add_scaled(add_scaled(v.x * m.a, v.y, m.b), v.z, m.c);
}
/// Transpose times vector.
HWY_INLINE V3 into(const M3& m, const V3& v) {
  return {dot(m.a, v), dot(m.b, v), dot(m.c, v)};
}
/// v v^T
HWY_INLINE S3 square(const V3& v) {
  return {v.x * v.x, v.y * v.x, v.y * v.y, v.z * v.x, v.z * v.y, v.z * v.z};
}
/// m diag(k) m^T
HWY_INLINE S3 sandwich(const M3& m, const V3& k) {
  const V3 a = k.x * m.a, b = k.y * m.b, c = k.z * m.c;
  return {hn::MulAdd(a.x, m.a.x, hn::MulAdd(b.x, m.b.x, c.x * m.c.x)),
          hn::MulAdd(a.y, m.a.x, hn::MulAdd(b.y, m.b.x, c.y * m.c.x)),
          hn::MulAdd(a.y, m.a.y, hn::MulAdd(b.y, m.b.y, c.y * m.c.y)),
          hn::MulAdd(a.z, m.a.x, hn::MulAdd(b.z, m.b.x, c.z * m.c.x)),
          hn::MulAdd(a.z, m.a.y, hn::MulAdd(b.z, m.b.y, c.z * m.c.y)),
          hn::MulAdd(a.z, m.a.z, hn::MulAdd(b.z, m.b.z, c.z * m.c.z))};
}

/// Adds k (a b^T + b a^T), a and b being m's first two columns.
HWY_INLINE void add_mixed(const M3& m, V k, S3& s) {
  const V3 a = k * m.a, &b = m.b;
  s.xx = hn::MulAdd(a.x, b.x, hn::MulAdd(a.x, b.x, s.xx));
  s.yx = hn::MulAdd(a.y, b.x, hn::MulAdd(a.x, b.y, s.yx));
  s.yy = hn::MulAdd(a.y, b.y, hn::MulAdd(a.y, b.y, s.yy));
  s.zx = hn::MulAdd(a.z, b.x, hn::MulAdd(a.x, b.z, s.zx));
  s.zy = hn::MulAdd(a.z, b.y, hn::MulAdd(a.y, b.z, s.zy));
  s.zz = hn::MulAdd(a.z, b.z, hn::MulAdd(a.z, b.z, s.zz));
}

HWY_INLINE Q operator*(const Q& a, const Q& b) {
  return {hn::MulAdd(a.w, b.x, hn::MulAdd(a.x, b.w, hn::NegMulAdd(a.z, b.y, a.y * b.z))),
          hn::MulAdd(a.w, b.y, hn::MulAdd(a.y, b.w, hn::NegMulAdd(a.x, b.z, a.z * b.x))),
          hn::MulAdd(a.w, b.z, hn::MulAdd(a.z, b.w, hn::NegMulAdd(a.y, b.x, a.x * b.y))),
          hn::NegMulAdd(a.x, b.x, hn::NegMulAdd(a.y, b.y, hn::NegMulAdd(a.z, b.z, a.w * b.w)))};
}
/// conjugate(a) * b
HWY_INLINE Q times_conjugate(const Q& a, const Q& b) {
  return {hn::MulAdd(a.w, b.x, hn::NegMulAdd(a.x, b.w, hn::NegMulAdd(a.y, b.z, a.z * b.y))),
          hn::MulAdd(a.w, b.y, hn::NegMulAdd(a.y, b.w, hn::NegMulAdd(a.z, b.x, a.x * b.z))),
          hn::MulAdd(a.w, b.z, hn::NegMulAdd(a.z, b.w, hn::NegMulAdd(a.x, b.y, a.y * b.x))),
          hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::MulAdd(a.z, b.z, a.w * b.w)))};
}
HWY_INLINE Q select(M mask, const Q& yes, const Q& no) {
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y),
          hn::IfThenElse(mask, yes.z, no.z), hn::IfThenElse(mask, yes.w, no.w)};
}
HWY_INLINE Q normalized(const Q& q) {
  const V squared = hn::MulAdd(q.x, q.x, hn::MulAdd(q.y, q.y, hn::MulAdd(q.z, q.z, q.w * q.w)));
  const V scale = set(1.0) / hn::Sqrt(squared);
  return {scale * q.x, scale * q.y, scale * q.z, scale * q.w};
}
HWY_INLINE M3 matrix(const Q& q) {
  const V x2 = q.x + q.x, y2 = q.y + q.y, z2 = q.z + q.z;
  const V xx = q.x * x2, yy = q.y * y2, zz = q.z * z2, xy = q.x * y2, xz = q.x * z2, yz = q.y * z2;
  const V wx = q.w * x2, wy = q.w * y2, wz = q.w * z2, one = set(1.0);
  return {{one - yy - zz, xy + wz, xz - wy},
          {xy - wz, one - xx - zz, yz + wx},
          {xz + wy, yz - wx, one - xx - yy}};
}
/// The third column alone.
HWY_INLINE V3 axis3(const Q& q) {
  const V x2 = q.x + q.x, y2 = q.y + q.y;
  return {hn::MulAdd(q.z, x2, q.w * y2), hn::NegMulAdd(q.w, x2, q.z * y2),
          hn::NegMulAdd(q.x, x2, hn::NegMulAdd(q.y, y2, set(1.0)))};
}

/// Rotation vector phi = scale * vec(q) of a unit quaternion, the shorter way round.
struct Log {
  V3 phi;
  V scale;
  V cosine;  // |w| = cos(|phi|/2)
};

/// With t = vec/(1 + w) = tan(angle/4): phi = 4 atan(|t|)/|t| t, by the arctangent's series. Where
/// it would converge slowly (angles beyond 0.4 rad) the angle is halved three times first,
/// tan(x/2) = tan x / (1 + sqrt(1 + tan^2 x)).
HWY_INLINE Log log_map(const Q& q) {
  const V3 vec{q.x, q.y, q.z};
  const V cosine = hn::Abs(q.w);
  V scale = hn::CopySign(set(4.0), q.w) / (set(1.0) + cosine);
  const V sixteenth = set(0.0625);
  V z = dot(vec, vec) * scale * scale * sixteenth;
  const M large = z > set(0.01);
  if (HWY_UNLIKELY(!hn::AllFalse(D(), large))) {
    for (int i = 0; i < 3; ++i) {
      const V half = set(1.0) / (set(1.0) + hn::Sqrt(set(1.0) + z));
      scale = hn::IfThenElse(large, scale * (half + half), scale);
      z = hn::IfThenElse(large, z * half * half, z);
    }
  }
  V series = set(-1.0 / 15.0);
  series = hn::MulAdd(series, z, set(1.0 / 13.0));
  series = hn::MulAdd(series, z, set(-1.0 / 11.0));
  series = hn::MulAdd(series, z, set(1.0 / 9.0));
  series = hn::MulAdd(series, z, set(-1.0 / 7.0));
  series = hn::MulAdd(series, z, set(1.0 / 5.0));
  series = hn::MulAdd(series, z, set(-1.0 / 3.0));
  series = hn::MulAdd(series, z, set(1.0));
  scale = scale * series;
  return {scale * vec, scale, cosine};
}

/// c of the inverse right Jacobian I + [phi]/2 + c [phi]^2 (rotation.h).
HWY_INLINE V jacobian_coefficient(const Log& log) {
  const V angle2 = dot(log.phi, log.phi);
  V c = set(691.0 / 1307674368000.0);
  c = hn::MulAdd(c, angle2, set(1.0 / 47900160.0));
  c = hn::MulAdd(c, angle2, set(1.0 / 1209600.0));
  c = hn::MulAdd(c, angle2, set(1.0 / 30240.0));
  c = hn::MulAdd(c, angle2, set(1.0 / 720.0));
  c = hn::MulAdd(c, angle2, set(1.0 / 12.0));
  const M large = angle2 > set(0.16);
  if (HWY_UNLIKELY(!hn::AllFalse(D(), large))) {
    const V cotangent = set(0.5) * hn::Abs(log.scale) * log.cosine;  // |phi|/2 cot(|phi|/2)
    c = hn::IfThenElse(large, (set(1.0) - cotangent) / angle2, c);
  }
  return c;
}

/// The inverse right Jacobian's transpose, as columns.
HWY_INLINE M3 inverse_jacobian_transposed(const Log& log) {
  const V c = jacobian_coefficient(log);
  const V3& p = log.phi;
  const V half = set(0.5);
  const V diagonal = hn::NegMulAdd(c, dot(p, p), set(1.0));
  const V xy = c * p.x * p.y, xz = c * p.x * p.z, yz = c * p.y * p.z;
  const V hx = half * p.x, hy = half * p.y, hz = half * p.z;
  // J = (1 - c p^2) I + [p]/2 + c p p^T; its rows are these columns.
  return {{hn::MulAdd(c * p.x, p.x, diagonal), xy - hz, xz + hy},
          {xy + hz, hn::MulAdd(c * p.y, p.y, diagonal), yz - hx},
          {xz - hy, yz + hx, hn::MulAdd(c * p.z, p.z, diagonal)}};
}

/// Unit quaternion of a rotation vector: series below 1/4 rad, beyond it of the 2^n-th part, then
/// squared n times.
HWY_INLINE Q exp_map(const V3& phi) {
  constexpr double series_limit = 0.0625;  // rad^2
  V3 part = phi;
  V angle2 = dot(phi, phi);
  V halvings = set(0.0);
  int most = 0;
  for (; most < 60; ++most) {
    const M large = angle2 > set(series_limit);
    if (HWY_LIKELY(hn::AllFalse(D(), large))) break;
    const V factor = hn::IfThenElse(large, set(0.5), set(1.0));
    part = factor * part;
    angle2 = angle2 * factor * factor;
    halvings = hn::IfThenElse(large, halvings + set(1.0), halvings);
  }
  V s = set(1.0 / 185794560.0);
  s = hn::MulAdd(s, angle2, set(-1.0 / 645120.0));
  s = hn::MulAdd(s, angle2, set(1.0 / 3840.0));
  s = hn::MulAdd(s, angle2, set(-1.0 / 48.0));
  s = hn::MulAdd(s, angle2, set(0.5));
  V w = set(-1.0 / 3715891200.0);
  w = hn::MulAdd(w, angle2, set(1.0 / 10321920.0));
  w = hn::MulAdd(w, angle2, set(-1.0 / 46080.0));
  w = hn::MulAdd(w, angle2, set(1.0 / 384.0));
  w = hn::MulAdd(w, angle2, set(-0.125));
  w = hn::MulAdd(w, angle2, set(1.0));
  Q q{s * part.x, s * part.y, s * part.z, w};
  for (int i = most; i > 0; --i) q = select(halvings >= set(i), q * q, q);
  return q;
}

}  // namespace HWY_NAMESPACE
}  // namespace pedicel::cosserat
HWY_AFTER_NAMESPACE();

#endif
