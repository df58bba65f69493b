#include "engine/geometry/closest_point.h"

#include <algorithm>

namespace pedicel::geometry {

namespace {

void keep_closer(SegmentPair& best, double s, double t, const Vec3& first, const Vec3& second) {
  const double distance = (first - second).norm();
  if (distance < best.distance) best = {s, t, first, second, distance};
}

/// For a triangle without area, which has no barycentric coordinates.
TrianglePoint closest_on_edges(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3* corners[] = {&a, &b, &c};
  TrianglePoint best{a, TriangleFeature::vertex_a};
  for (int i = 0; i < 3; ++i) {
    const Vec3 &from = *corners[i], &to = *corners[(i + 1) % 3];
    const Vec3 point = from + closest_on_segment(p, from, to) * (to - from);
    if ((p - point).squaredNorm() < (p - best.point).squaredNorm())
      best = {point, static_cast<TriangleFeature>(static_cast<int>(TriangleFeature::edge_ab) + i)};
  }
  return best;
}

}  // namespace

double closest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double along = ab.dot(p - a), length2 = ab.squaredNorm();
  if (along <= 0.0) return 0.0;
  return along < length2 ? along / length2 : 1.0;
}

SegmentPair closest_on_segments(const Vec3& a0, const Vec3& a1, const Vec3& b0, const Vec3& b1) {
  const Vec3 da = a1 - a0, db = b1 - b0, r = a0 - b0;
  // Either both closest points are inside, or one of them is an end: four projections and at most
  // one crossing cover all cases, nearly parallel ones included.
  SegmentPair best{0.0, closest_on_segment(a0, b0, b1), a0, {}, 0.0};
  best.second = b0 + best.t * db;
  best.distance = (best.first - best.second).norm();
  const double t1 = closest_on_segment(a1, b0, b1);
  keep_closer(best, 1.0, t1, a1, b0 + t1 * db);
  const double s0 = closest_on_segment(b0, a0, a1), s1 = closest_on_segment(b1, a0, a1);
  keep_closer(best, s0, 0.0, a0 + s0 * da, b0);
  keep_closer(best, s1, 1.0, a0 + s1 * da, b1);

  const double aa = da.squaredNorm(), bb = db.squaredNorm(), ab = da.dot(db);
  const double determinant = aa * bb - ab * ab;
  if (determinant <= 0.0) return best;
  const double s = (ab * db.dot(r) - bb * da.dot(r)) / determinant;
  const double t = (aa * db.dot(r) - ab * da.dot(r)) / determinant;
  if (s > 0.0 && s < 1.0 && t > 0.0 && t < 1.0) keep_closer(best, s, t, a0 + s * da, b0 + t * db);
  return best;
}

TrianglePoint closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  // Voronoi regions of the corners, then of the edges (Ericson 5.1.5).
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0) return {a, TriangleFeature::vertex_a};
  const Vec3 bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3) return {b, TriangleFeature::vertex_b};
  const Vec3 cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6) return {c, TriangleFeature::vertex_c};

  const double wc = d1 * d4 - d3 * d2, wb = d5 * d2 - d1 * d6, wa = d3 * d6 - d5 * d4;
  // In a sliver the weights are rounding noise.
  if (ab.cross(ac).squaredNorm() <= 1e-12 * ab.squaredNorm() * ac.squaredNorm())
    return closest_on_edges(p, a, b, c);
  if (wc <= 0.0 && d1 >= 0.0 && d3 <= 0.0)
    return {a + d1 / (d1 - d3) * ab, TriangleFeature::edge_ab};
  if (wb <= 0.0 && d2 >= 0.0 && d6 <= 0.0)
    return {a + d2 / (d2 - d6) * ac, TriangleFeature::edge_ca};
  if (wa <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0)
    return {b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b), TriangleFeature::edge_bc};
  const double sum = wa + wb + wc;
  return {a + wb / sum * ab + wc / sum * ac, TriangleFeature::face};
}

}  // namespace pedicel::geometry
